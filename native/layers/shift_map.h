#pragma once

#include <functional>

#include "layers/inpaint_level.h"
#include "patches/match_field.h"

namespace stillwater {

/// Shifts, (x, y) pixels, of an image's size: each pixel of a hole is the copy of the one so far away. 0 elsewhere.
using ShiftMap = cv::Mat_<cv::Vec2s>;

/// For each pixel of the hole the shift that most of the patches over it agree on, by their `weight`.
ShiftMap agreed_shifts(const MatchField& field, const Plane& weight, int patch, const Mask& hole);

/// Moves the borders between pieces of one shift to where they are seen least: a pixel takes a neighbour's shift where
/// that lowers
///
///     E = sum over neighbours p, q of unlike shifts  |I(p + s_p) - I(p + s_q)|^2 + |I(q + s_p) - I(q + s_q)|^2,
///
/// a known q having the shift 0. Pritch, Kav-Venaki, Peleg 2009, "Shift-map image editing", equation 4. Pixels of the two
/// colours of a chessboard take turns, so that the result is the same for any number of threads. A shift is taken only
/// where it leads to a pixel of `allowed` (not 0). `level.bytes`: only known pixels are read.
void settle_seams(const InpaintLevel& level, const Mask& allowed, int rounds, ShiftMap& shifts, const std::function<void(double)>& at = {});

/// Fills the hole with what the shifts say.
void copy_shifted(const ShiftMap& shifts, const Mask& hole, Rgba& colour);

}  // namespace stillwater
