#pragma once

#include <vector>

#include "core/image.h"

namespace stillwater {

/// Which values a plane has, and how many: rising values, and for each its rank 0 .. 1, the middle of the ranks of its
/// equals. Straight between them.
struct Histogram {
  std::vector<float> values, ranks;
};

/// `points`: the most values kept, 2 .. 65536, evenly spaced in rank, the extremes among them; 0 keeps all. 4096 leave an error of rank
/// of 1 / 4096. Throws BadInput where the plane is empty or a pixel is not finite.
Histogram histogram(const Plane& plane, int points = 4096);

/// The plane with the reference's histogram: each value becomes that of the same rank. Monotone; equal pixels stay equal (they
/// take their middle rank); a plane of the same size without equal pixels gets exactly the reference's values.
/// Throws BadInput as histogram(), or where the reference has no values or does not rise.
Plane match_histogram(const Plane& plane, const Histogram& reference);

/// By all of the reference's values. The planes' sizes may differ.
Plane match_histogram(const Plane& plane, const Plane& reference);

}  // namespace stillwater
