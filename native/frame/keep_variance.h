#pragma once

#include <cmath>

#include "core/image.h"

/// The one rule by which copies of a layer are mixed so that contrast does not sink where they differ: what differs from
/// the mean M is multiplied by one over the standard deviation that the mix has left.
///
///     colour = M + (w1 (S1 - M1) + w2 (S2 - M2) + ...) / sqrt(sum of wi wj rho_ij),   M = w1 M1 + w2 M2 + ...
///
/// rho_ij is how alike the layer is to itself at the distance of copies i and j; the weights add up to 1.
namespace stillwater {

/// One over that root, for two copies; `other` and 1 - `other` are their weights.
inline double variance_gain(double other, double rho) {
  const double one = 1 - other;
  return 1 / std::sqrt(one * one + other * other + 2 * one * other * rho);
}

/// The mix with its differences from the mean multiplied.
inline cv::Vec4f with_gain(const cv::Vec4f& mix, const cv::Vec4f& mean, float gain) { return mean + gain * (mix - mean); }

}  // namespace stillwater
