#pragma once

#include <algorithm>
#include <cmath>

namespace stillwater {

/// How far a place is from a piece of a line, and where along it (0..1) the nearest point lies.
struct SegmentDistance {
  double distance, share;
};

inline SegmentDistance distance_to_segment(double x, double y, double from_x, double from_y, double to_x, double to_y) {
  const double along_x = to_x - from_x, along_y = to_y - from_y, square = along_x * along_x + along_y * along_y;
  const double away_x = x - from_x, away_y = y - from_y;
  const double share = square > 0 ? std::clamp((away_x * along_x + away_y * along_y) / square, 0.0, 1.0) : 0;
  const double rest_x = away_x - share * along_x, rest_y = away_y - share * along_y;
  return {std::sqrt(rest_x * rest_x + rest_y * rest_y), share};
}

}  // namespace stillwater
