#pragma once

#include "layers/sampling.h"

namespace stillwater {

/// The image sampled where a displacement map says: out(p) = image(p + map(p)), Catmull-Rom. `map` has the size of the
/// result; index (0, 0) of both is the same place. Throws BadInput for empty images.
Rgba displace(const Rgba& image, const Field& map, Beyond beyond = {});

/// The same of an image made ready before, laid over `back` (of the map's size) in one pass.
void displace_over(const Source& image, const Field& map, Rgba& back);

}  // namespace stillwater
