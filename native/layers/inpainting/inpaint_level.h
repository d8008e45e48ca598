#pragma once

#include <functional>
#include <vector>

#include "patches/patch_image.h"

namespace stillwater {

/// A picture with a hole at one size: what inpaint() works on.
struct InpaintLevel {
  Rgba colour;        ///< known pixels, and the filling so far
  PatchImage bytes;   ///< the same, as patches are compared
  Mask hole;          ///< to be filled (not 0)
  Mask allowed;       ///< what may be copied (not 0)
  Mask centres;       ///< where a patch that is copied from may have its centre (not 0)
  double radius = 0;  ///< how far from a patch; 0 = anywhere
};

/// The levels, finest first, each half as large as the one before: as many as the hole needs to become no wider than a
/// patch, and as leave the picture a few patches large with something to copy from (within the radius of each patch).
/// `allowed`: where patches may come from (not 0). `still_wanted` is called after each; what it throws ends the work.
std::vector<InpaintLevel> inpaint_levels(const Rgba& picture, const Mask& hole, const Mask& allowed, int patch,
                                         double radius, const std::function<void()>& still_wanted);

/// The largest distance, pixels, of a patch that touches the hole from the nearest one that it could be copied from,
/// and where that patch is.
struct Remoteness {
  double distance;
  cv::Point centre;
};
Remoteness most_remote(const InpaintLevel& level, int patch);

}  // namespace stillwater
