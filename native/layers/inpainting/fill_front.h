#pragma once

#include <cstdint>
#include <functional>

#include "layers/inpainting/inpaint_level.h"
#include "layers/inpainting/seam_cost.h"

namespace stillwater {

struct FillFrontParameters {
  int patch = 9;
  std::uint64_t seed = 0;
  /// What a coarser level thinks the hole holds: compared too, but counts less than what is known. Or null.
  const PatchImage* guidance = nullptr;
  /// And the shifts it found (of the level's size). Or null.
  const ShiftMap* hints = nullptr;
};

/// Fills the hole of a level, patch by patch, in the order of
///
///     P(p) = C(p) D(p),   C(p) = sum of C over what is known of the patch / its area,   D(p) = |isophote . n| / alpha
///
/// so that lines that run into the hole are drawn on before the plain parts between them grow together. Each patch
/// takes its unknown pixels from the patch most like its known ones. That one is searched among the shifts of its
/// neighbours, the hints, and random places ever closer to it and to the best so far; everywhere, where that takes no
/// longer.
///
/// Changes `level.bytes` and `level.colour` inside the hole. Answers the shifts, of the level's size.
/// Criminisi, Perez, Toyama 2003, equations 1 - 3. `at`: see patch_match().
ShiftMap fill_front(InpaintLevel& level, const FillFrontParameters& parameters, const std::function<void(double)>& at);

}  // namespace stillwater
