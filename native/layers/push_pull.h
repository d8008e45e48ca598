#pragma once

#include "core/image.h"

namespace stillwater {

/// Fills what is transparent from what is not, smoothly: colours are averaged into ever smaller pictures, and each
/// picture is laid over the next smaller one, enlarged. Pixels with coverage 1 come back as they are.
/// (Gortler et al. 1996, "The lumigraph", 3.4: push-pull; here coverage is premultiplied alpha, and pull is `over`.)
///
/// `known` is premultiplied: coverage says how far a pixel is known. The result has coverage 1 everywhere. Throws
/// BadInput where nothing at all is known.
Rgba push_pull(const Rgba& known);

/// The same in place, of colours or of one quantity (premultiplied, with its coverage).
void fill_by_push_pull(Rgba& known);
void fill_by_push_pull(cv::Mat_<cv::Vec2f>& known);

/// The box of what is above 0, grown so that a filling finds what surrounds it; empty where nothing is.
cv::Rect surroundings(const Plane& region);

/// How far to trust a pixel of which the share `other` belongs to something else: falls off quickly.
inline float purity(float other) {
  const float pure = 1 - other, square = pure * pure, fourth = square * square;
  return fourth * fourth;
}

}  // namespace stillwater
