#pragma once

#include <limits>

#include "patches/patch_image.h"

namespace stillwater {

/// For the patches of one image, by their centres, the most alike patch of another image (or of the same).
/// Source: Barnes et al. 2009, "PatchMatch", 3 (nearest-neighbour field).
struct MatchField {
  static constexpr int unmatched = std::numeric_limits<int>::max();

  cv::Rect area;               ///< of the target image; what follows is of its size
  Mask wanted;                 ///< patches that are matched (not 0)
  cv::Mat_<cv::Vec2s> offset;  ///< source centre minus target centre, (x, y) pixels
  cv::Mat_<int> distance;      ///< sum of squared differences, or `unmatched`

  /// All patches that `centres` (of the image's size) asks for, unmatched. The area is the least that holds them.
  static MatchField of(const Mask& centres);

  bool has(const cv::Point& centre) const { return area.contains(centre) && wanted(centre - area.tl()); }
};

/// The field of an image twice as large: each patch begins where the one that covers it pointed to. `centres`: the
/// patches of the larger image that are matched. All are unmatched: their distances have to be measured.
MatchField twice_as_large(const MatchField& field, const Mask& centres);

}  // namespace stillwater
