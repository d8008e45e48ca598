#pragma once

#include <cstdint>
#include <optional>

#include "core/image.h"
#include "core/progress.h"

namespace stillwater {

struct CyclicParameters {
  bool along_x = true, along_y = false;
  /// 0..1, of the image's size: what is below one half is filled too; none = all is known.
  std::optional<Plane> known = std::nullopt;
  int patch = 9;               ///< see InpaintParameters
  std::uint64_t seed = 0;
};

/// Makes an image endless, as make_cyclic() does, of the same size (cyclic_period()), but the strip that leads from its
/// end to its beginning is filled by inpaint(): made of pieces of the image, with no seam at either end, and without
/// ghosts. Takes seconds for a large picture.
///
/// Known pixels are kept as they are. A side shorter than a patch is continued by make_cyclic()'s blend.
///
/// Throws BadInput where `known` has another size, nothing is known, a number is not finite, or the patch is out of its
/// range; Cancelled where `progress` says so. Chuang et al. 2005, 3 (clouds): "a cyclic texture".
Rgba make_cyclic_by_exemplars(const Rgba& image, const CyclicParameters& parameters, Progress progress = {});

}  // namespace stillwater
