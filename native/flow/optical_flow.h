#pragma once

#include <string>

#include "core/image.h"

namespace stillwater {

/// How carefully flow is found. Noise that moves evenly by up to 7 px: off by 0.12, 0.05 and 0.02 px at most in the mean.
/// Milliseconds of one core at 640x360: about 9, 28 and 160.
enum class FlowQuality {
  fast,    ///< patches of 8 px, 4 px apart, on a quarter of the size
  medium,  ///< 3 px apart, on half of it
  best     ///< on the whole size, with more turns of the variational refinement
};

/// "fast", "medium", "best". Throws BadInput for another name.
FlowQuality flow_quality_named(const std::string& name);

/// Where what is seen at each pixel of `a` is in `b`, minus here, px: dense inverse search (Kroeger, Timofte, Dai, Van Gool
/// 2016, "Fast optical flow using dense inverse search"), refined variationally (Brox et al. 2004), both OpenCV's.
///
/// Any range of numbers, also signed ones: what both planes hold together, without the outermost thousandth at each end, is
/// taken as 8-bit grey. Planes that hold one value there do not move.
/// Throws BadInput where the sizes differ, a side is below 16 px, or a number is not finite.
Field optical_flow(const Plane& a, const Plane& b, FlowQuality quality = FlowQuality::medium);

/// Rec. 709 luma of display-referred red, green, blue.
Plane luma(const cv::Mat_<cv::Vec3f>& colours);

}  // namespace stillwater
