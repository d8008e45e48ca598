#pragma once

#include "flow/stroke_track.h"

namespace stillwater {

/// A stroke's own layer in local mode (Okabe et al. 2009, 5.1): what it says around it, and a matte of its size and alpha.
struct LocalLayer {
  cv::Rect box;   ///< the part of the picture that the layer covers; may be empty
  Plane matte;    ///< of the box: alpha under the stroke, falling smoothly to 0 at twice its half width
  Field tangent;  ///< of the box: unit vectors, of the nearest place on the stroke
};

LocalLayer local_layer(const StrokeTrack& track, double alpha, cv::Size picture);

}  // namespace stillwater
