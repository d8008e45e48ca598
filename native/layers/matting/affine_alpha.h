#pragma once

#include "core/image.h"

namespace stillwater {

/// Alpha around a pixel as an affine function of colour: alpha = slope . colour + offset.
struct AffineAlpha {
  cv::Vec3d slope;
  double offset = 0;
  double rest = 0;  ///< alpha's variance that it does not explain
};

/// Fits it to the pixels within `radius` of (y, x), by least squares with a `ridge` (colour squared) that keeps the
/// slope small where colours hardly change (He, Sun and Tang 2010, "Guided image filtering", eq. 5 and 6).
AffineAlpha fit_affine_alpha(const Rgba& picture, const Plane& alpha, const cv::Point& pixel, int radius, double ridge);

}  // namespace stillwater
