#pragma once

#include "core/image.h"
#include "layers/sampling.h"

/// Differences of colours, below and above 0, are carried by what carries pictures: as colours that cover everything.
namespace stillwater {

Rgba as_covering(const Rgb& differences);
Rgb without_coverage(const Rgba& covering);

/// The differences where a map says: out(p) = in(p + map(p)), Catmull-Rom; beyond their sides they go on mirrored.
Rgb sample_differences(const Rgb& differences, const Field& map);

}  // namespace stillwater
