#pragma once

#include <vector>

#include "core/image.h"

namespace stillwater {

/// Takes places along one line to places along another, turning and moving what is around as rigidly as the lines allow
/// (Schaefer, McPhail, Warren 2006, "Image deformation using moving least squares", 2.3; in place of the mesh of
/// Igarashi, Moscovich, Hughes 2005, "As-rigid-as-possible shape manipulation").
class RigidDeformation {
 public:
  /// Both lines are cut into as many pieces of equal length each. A line of one point moves without turning.
  RigidDeformation(const std::vector<Point>& from, const std::vector<Point>& to, double scale);

  /// `scale`: how much longer things are at `to`.
  Point at(Point place) const;

  const std::vector<Point>& from() const { return from_; }

 private:
  std::vector<Point> from_, to_;
  double scale_;
};

/// `count` places along a line, evenly, both ends among them.
std::vector<Point> evenly_along(const std::vector<Point>& line, int count);

}  // namespace stillwater
