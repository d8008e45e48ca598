#pragma once

#include <vector>

#include "frame/displaced_layer.h"

/// What is given for the pixels of a layer's box at the picture's scale, as it is in the pixels of its plate.
namespace stillwater {

/// Throws BadInput where a field is not the box's size, or not finite.
std::vector<Field> scaled_fields(const std::vector<Field>& velocities, const Plate& plate);

/// An empty plane stays empty.
Plane scaled_plane(const Plane& plane, const Plate& plate);

/// Where the plate's first pixel lies in the box, in the plate's pixels.
Point offset_in_box(const Plate& plate);

}  // namespace stillwater
