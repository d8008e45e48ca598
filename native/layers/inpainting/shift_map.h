#pragma once

#include <functional>
#include <vector>

#include "layers/inpainting/seam_cost.h"
#include "patches/match_field.h"

namespace stillwater {

/// For each pixel of the hole the shift that most of the patches over it agree on, by their `weight`.
ShiftMap agreed_shifts(const MatchField& field, const Plane& weight, int patch, const Mask& hole,
                       const std::function<void(double)>& at = {});

/// The shifts that most pixels of the hole have, most first.
std::vector<cv::Vec2s> most_used(const ShiftMap& shifts, const Mask& hole, size_t most);

/// Moves the borders between pieces of one shift to where they are seen least: a pixel takes a neighbour's shift where
/// that lowers the sum of SeamCost over all neighbours. Pixels of the two colours of a chessboard take turns, so that
/// the result is the same for any number of threads.
void settle_seams(const SeamCost& cost, const Mask& hole, int rounds, ShiftMap& shifts,
                  const std::function<void(double)>& at = {});

/// Fills the hole with what the shifts say.
void copy_shifted(const ShiftMap& shifts, const Mask& hole, Rgba& colour);

}  // namespace stillwater
