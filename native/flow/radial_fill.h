#pragma once

#include "flow/radial_interpolation.h"

namespace stillwater {

/// An interpolation (of one column for a Plane, two for a Field) at all pixel centres of a picture. Centres that are far off
/// make a smooth field: it is evaluated on a grid of 16 px, from there interpolated to one of 8 px, and from that to the pixels,
/// with cubics (Lagrange, 4 x 4 nodes). On each way down the centres within three cells are left out of the nodes, and evaluated
/// at each place. Within 1/100 of the largest difference of the values everywhere, and within 1/1500 of it in the mean.
template <class Pixel>
cv::Mat_<Pixel> radial_fill(const RadialInterpolation& interpolation, cv::Size picture);

extern template Plane radial_fill<float>(const RadialInterpolation&, cv::Size);
extern template Field radial_fill<cv::Vec2f>(const RadialInterpolation&, cv::Size);

}  // namespace stillwater
