#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "layers/inpainting/seam_cost.h"

namespace stillwater {

struct CoarseToFineParameters {
  int patch = 9;  ///< odd, pixels a side
  std::uint64_t seed = 0;
};

/// The shift map that fills the hole of the finest of some levels (inpaint_levels()).
///
/// - Coarsest level: structure first (fill_front()).
/// - On each level down to the finest on which the hole has at most 14000 pixels: rounds of search and vote.
/// - There all is cut anew (expand_shifts()) of the shifts that were found, of those of a structure-first filling of
/// that level,
///   and of those frequent in the picture (frequent_shifts()): pieces become large and sharp.
/// - On finer levels a round of search and vote adapts pieces to each other; on the finest seams are settled once more.
///
/// The fillings of all levels are left in `levels`. `at`: see patch_match().
ShiftMap fill_coarse_to_fine(std::vector<InpaintLevel>& levels, const CoarseToFineParameters& parameters,
                             const std::function<void(double)>& at);

}  // namespace stillwater
