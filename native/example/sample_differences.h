#pragma once

#include "core/image.h"
#include "layers/sampling.h"

/// Differences of colours, below and above 0, are carried by what carries pictures: as colours that cover everything.
namespace stillwater {

Rgba as_covering(const Rgb& differences);
Rgb without_coverage(const Rgba& covering);

/// The differences where a map says: out(p) = in(p + map(p)), Catmull-Rom.
Rgb sample_differences(const Rgb& differences, const Field& map, Beyond beyond = {});

/// Beyond the sides the last pixel repeats: what comes from outside stays the same however often it is carried, so that maps
/// of single steps and their composition agree.
inline constexpr Beyond repeated{.wraps = false, .mirror_low = false, .mirror_high = false};

}  // namespace stillwater
