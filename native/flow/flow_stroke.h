#pragma once

#include <vector>

#include "core/image.h"

namespace stillwater {

/// What a stroke of the flow brushes says (Okabe et al. 2009, 5.1; the recipe's "orientation", "speed", "both").
enum class FlowStrokeKind { orientation, speed, both };

/// A stroke of the flow brushes, in picture pixels; the recipe's flow stroke.
struct FlowStroke {
  std::vector<cv::Vec3f> points;  ///< x, y, and pressure 0..1, which scales the width; the fluid runs from first to last
  double width = 10;              ///< px, full width at pressure 1, above 0
  FlowStrokeKind kind = FlowStrokeKind::both;
  double speed = 2;    ///< px per frame, 0..1000; of kinds speed and both
  bool local = false;  ///< only the stroke's neighbourhood follows it
  double alpha = 1;    ///< 0..1, how strongly it counts
};

}  // namespace stillwater
