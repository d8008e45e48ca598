#pragma once

#include <functional>
#include <vector>

#include "layers/inpainting/seam_cost.h"

namespace stillwater {

struct ExpansionParameters {
  int sweeps = 2;  ///< how often a shift is tried: again where it took pixels over the last time
  int reach = 0;   ///< how far a piece may grow at once, pixels; 0 = over the whole hole, wherever it was before
};

/// The shift map with the least visible seams (SeamCost) that can be made of some shifts, found by expanding one after
/// the other as far as that lowers the sum: minimum cuts, so that large pieces move at once.
///
/// Boykov, Veksler, Zabih 2001, "Fast approximate energy minimization via graph cuts", 3; for shifts: Pritch et al.
/// 2009, 4, and He and Sun 2012, "Statistics of patch offsets for image completion", 3.2. Where a cut can't say what
/// two neighbours cost (the cost is no metric) it is told less, and undone if the sum did not fall.
///
/// `shifts`: of the level's size, a valid one everywhere in the hole; improved. `candidates`: tried in this order.
void expand_shifts(const SeamCost& cost, const Mask& hole, const std::vector<cv::Vec2s>& candidates,
                   const ExpansionParameters& parameters, ShiftMap& shifts, const std::function<void(double)>& at = {});

}  // namespace stillwater
