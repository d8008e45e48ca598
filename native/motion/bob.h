#pragma once

#include <memory>
#include <vector>

#include "core/image.h"
#include "layers/displacement.h"
#include "motion/rigid.h"

/// Boats: heave and roll with the water under the waterline (Chuang et al. 2005, 3.4).
///
/// Points along the waterline go where the water takes them. By a line fitted to them, at rest and
/// displaced (linear regression of the offsets across the rest line on the places along it), the layer moves as a
/// whole: with the line's middle (heave), and turned about it by the change of the line's angle (roll).
namespace stillwater {

/// The recipe's `bob`, with its animated numbers resolved.
struct Bob {
  std::vector<Point> waterline;  ///< picture pixels, two points or more
  double amount = 1;
};

/// The line at rest: it ends where the waterline's first and last point fall on it. A reflection is mirrored about
/// it. Throws BadInput where the waterline has fewer than two points or no length.
Segment fitted_waterline(const Bob& bob);

/// The points of the waterline that are asked where they go: the middles of 64 pieces of equal length. Throws BadInput.
std::vector<Point> waterline_samples(const Bob& bob);

/// The motion that takes waterline_samples(bob) to `moved`, as near as a rigid motion does. Throws BadInput.
std::shared_ptr<const RigidMotion> fitted_motion(const Bob& bob, const std::vector<Point>& moved, cv::Size picture);

/// The boat's motion on this moment's water, in a picture of this size. Throws BadInput.
std::shared_ptr<const RigidMotion> bob(const Bob& bob, const Displacement& water, cv::Size picture);

}  // namespace stillwater
