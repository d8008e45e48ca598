#pragma once

#include <string>
#include <vector>

#include "bindings/arrays.h"
#include "example/half_frames.h"
#include "example/source_map.h"

namespace stillwater {

/// A view of the array's memory, which must outlive it. Throws BadInput where it is not float16, frames x height x width x 3.
HalfFrames as_half_frames(const py::array& array, const std::string& name);

/// From rows of target x, y, source x, y, turn.
std::vector<PlacedPatch> as_patches(const FloatArray& array);

}  // namespace stillwater
