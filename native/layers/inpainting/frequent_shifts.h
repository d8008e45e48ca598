#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "layers/inpainting/inpaint_level.h"

namespace stillwater {

struct FrequentShiftsParameters {
  int patch = 9;
  std::uint64_t seed = 0;
  size_t most = 60;  ///< how many are wanted
};

/// The shifts at which a picture is like itself most often, around the hole, the most frequent first: along its lines,
/// and by the periods of what repeats in it. Each known patch is matched with the patch most like it that is not near
/// to it; peaks of the histogram of how far they lie apart are the answer.
///
/// He and Sun 2012, "Statistics of patch offsets for image completion", 3.1.
/// `at`: see patch_match().
std::vector<cv::Vec2s> frequent_shifts(const InpaintLevel& level, const FrequentShiftsParameters& parameters,
                                       const std::function<void(double)>& at = {});

}  // namespace stillwater
