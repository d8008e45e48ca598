#pragma once

#include <vector>

#include "core/image.h"

namespace stillwater {

/// Differences of ever smoother and smaller pictures, the finest first; the last is the smallest picture itself. Level k
/// has ceil(side / 2^k) pixels a side. Source: Burt and Adelson 1983, "The Laplacian pyramid as a compact image code"
/// (5 x 5 binomial kernel; beyond its sides the picture goes on mirrored).
/// `scales`: halvings, 1 .. 12, the shorter side is longer than 2^scales pixels. Throws BadInput.
std::vector<Plane> laplacian_pyramid(const Plane& image, int scales);

/// The picture that has this pyramid: exact, as it adds what was taken away. Throws BadInput where there is no level, or
/// levels have sizes that do not follow each other.
Plane collapse(const std::vector<Plane>& laplacian);

}  // namespace stillwater
