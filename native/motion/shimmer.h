#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "layers/displacement.h"
#include "motion/wind.h"

/// Leaves: small motion within a swaying layer, each its own, growing from the root outwards. Our own law; Chuang et
/// al. 2005 have none.
///
/// A square lattice of cells of cell_share of the armature's length (at least 1 px) lies over the still picture. Each
/// of its nodes swings at a frequency of its own, 2 to 5 Hz (in a loop whole turns), by a vector no longer than
///
///     a = largest_swing cell shimmer w / (w + 2.5 m/s),    w = local wind speed
///
/// Between the nodes the swing is their quadratic B-spline, times 3 u^2 - 2 u^3 (u = distance from the root over the
/// armature's length, at most 1). Its slope stays below 2 sqrt(2) a / cell = 0.57 (and 0.006 for the growth), so it
/// never folds. The lattice repeats after 64 cells.
///
/// unmap() adds the swing, exactly. map() solves for that by three rounds of Newton: within 3e-6 cells.
namespace stillwater {

class Shimmer {
 public:
  static constexpr double cell_share = 0.02;
  static constexpr double largest_swing = 0.2;

  Shimmer(const Segment& armature, std::uint64_t seed);

  /// `shimmer`: 0 .. 1. `local_speed`: of the wind at the layer, gusts included, m/s.
  std::unique_ptr<const Displacement> at(const Moment& moment, double shimmer, double local_speed) const;

 private:
  Segment armature_;
  std::vector<float> frequency_, phase_x_, phase_y_;  ///< of each node, Hz and turns
};

}  // namespace stillwater
