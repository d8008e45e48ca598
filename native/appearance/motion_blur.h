#pragma once

#include "core/image.h"

namespace stillwater {

struct MotionBlurParameters {
  double shutter = 0.2;      ///< s, 0 .. 10
  double fps = 24;           ///< frames per second of `velocity`
  double average_blur = 8;   ///< sigma of the Gaussian that follows, px, 0 .. 1000
};

/// What the fluid looks like on average: each pixel is the mean, over the time that the shutter is open, of the colours that
/// flow through it, half of the time before and half after; then a Gaussian. The path follows the streamline (midpoint rule, a
/// pixel or less a step). Beyond the sides the nearest pixel holds.
/// Source: Okabe et al. 2009, 4 (approximated average A').
/// `velocity`: px per frame. Throws BadInput where sizes differ, values are not finite, or the longest path is above 4096 px.
Rgba motion_blur(const Rgba& picture, const Field& velocity, const MotionBlurParameters& parameters = {});

}  // namespace stillwater
