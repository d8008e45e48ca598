#pragma once

#include <cmath>
#include <vector>

#include "core/image.h"

namespace stillwater {

/// What makes a film's differences as strong and as coloured as the picture's own (Okabe et al. 2009, 4: statistics matched),
/// not once for the whole picture but place by place, so that a calm pool beside a fall stays calm:
///
///     D''= slope held(luma D') + mean,    slope = (sigma_C / sigma_D') (cov(C, luma C) / sigma_C^2),    C = picture - A'
///
/// sigma_C, cov, mean: of C around each place (sigmas of luma), sigma_D': of D' around it in several moments of the film: the
/// same for all frames. The clip's own colours are left out: on another picture they are specks. sigma_C / sigma_D' is at
/// most 3 times the whole picture's. held(t) = h tanh(t / h), h = 2.5 sigma_D': what is further off than anything in the picture
/// has no colour there (fire turns green).
struct LocalContrast {
  Rgb slope;
  Rgb mean;
  Plane hold;  ///< h
};

/// base + slope held(t).
inline cv::Vec3f with_contrast(const cv::Vec3f& base, const cv::Vec3f& slope, float hold, float t) {
  return hold > 0 ? cv::Vec3f(base + hold * std::tanh(t / hold) * slope) : base;
}

/// `difference`: C; `moments`: D' at some moments of the film, at least one, of the same size; `weight`: 0..1, which pixels
/// count; `around`: sigma in px, above 0. Throws BadInput where a size or number is not so.
LocalContrast local_contrast(const Rgb& difference, const std::vector<Rgb>& moments, const Plane& weight, double around);

}  // namespace stillwater
