#pragma once

#include "flow/radial_interpolation.h"

namespace stillwater {

/// An interpolation (of one column for a Plane, two for a Field) at all pixel centres of a picture. Far centres make a smooth
/// field: it is evaluated on a grid of 8 px and interpolated with cubics (Lagrange, 4 x 4 nodes); a centre within two cells of
/// the grid is evaluated at each pixel. Within 1/200 of the largest difference of the values everywhere, and within 1/1000 of
/// it in the mean.
template <class Pixel>
cv::Mat_<Pixel> radial_fill(const RadialInterpolation& interpolation, cv::Size picture);

extern template Plane radial_fill<float>(const RadialInterpolation&, cv::Size);
extern template Field radial_fill<cv::Vec2f>(const RadialInterpolation&, cv::Size);

}  // namespace stillwater
