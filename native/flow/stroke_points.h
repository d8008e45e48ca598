#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "flow/stroke_track.h"

/// What the global strokes say, as scattered points: the ends of an interpolation.
namespace stillwater {

/// One pixel under a stroke.
struct StrokePixel {
  cv::Point index;    ///< column and row of the pixel
  cv::Vec2d value;    ///< a unit vector, or (speed, 0)
  double strength;    ///< 0..1; 1 = the field takes on `value`
};

/// A stroke that paints `value` (or, without one, its own direction).
struct PaintedTrack {
  const StrokeTrack* track;
  double strength;  ///< above 0, at most 1
  bool directed;    ///< paints its tangent, else `speed`
  double speed;
};

/// The pixels that stand for what lies under the strokes: on the centre line and on both sides, half a width (at least 1 px)
/// apart, no two the same, in the strokes' order; pixels outside the picture are left out. A stroke paints over those before
/// it: at its strength where it lies. Where two opposite directions cancel (below a tenth of their size) nothing is said, and
/// that pixel is left out.
std::vector<StrokePixel> stroke_pixels(const std::vector<PaintedTrack>& tracks, cv::Size picture);

}  // namespace stillwater
