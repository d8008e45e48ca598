#pragma once

#include <functional>

#include "patches/match_field.h"

namespace stillwater {

/// Each pixel of `region` (of the target's size) becomes the weighted mean of what the patches over it say.
/// `weight` (of the field's area's size): of each patch. Pixels that no matched patch covers stay.
/// Source: Wexler, Shechtman, Irani 2007, "Space-time completion of video", 3.1; Barnes et al. 2009, 4.
/// `at`: see patch_match().
void vote(const MatchField& field, int patch, const Plane& weight, const Rgba& source, const Mask& region, Rgba& target,
          const std::function<void(double)>& at = {});

}  // namespace stillwater
