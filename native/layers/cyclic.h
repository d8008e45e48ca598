#pragma once

#include "core/image.h"

namespace stillwater {

/// Makes an image endless: it is kept as it is and continued, along the axes asked for, by a strip in which its end
/// turns into its beginning. The result is one period.
///
///     |picture| strip |picture| strip ...
///
/// The strip is a quarter of the side wide: a piece of the picture itself, the one whose ends fit best, its tone drawn
/// linearly to what it must meet. Over a quarter of the strip at its ends it is blended with the picture mirrored
/// there; the eye would find more of a mirror image.
Rgba make_cyclic(const Rgba& image, bool along_x, bool along_y);

/// Length of one period of make_cyclic() for a side of this many pixels.
int cyclic_period(int side);

}  // namespace stillwater
