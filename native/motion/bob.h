#pragma once

#include <memory>
#include <vector>

#include "core/image.h"
#include "layers/displacement.h"

/// Boats: heave and roll with the water under the waterline (Chuang et al. 2005, 3.4).
///
/// Points of the waterline go where the water takes them. A line fitted to them by linear regression, at rest and
/// displaced, gives a heave (of its middle, across the line) and a roll (about its middle): a rigid motion of the
/// layer.
namespace stillwater {

/// The recipe's `bob`, with its animated numbers resolved.
struct Bob {
  std::vector<Point> waterline;  ///< picture pixels, two points or more
  double amount = 1;
};

/// The line at rest: it ends where the waterline's first and last point fall on it. A reflection is mirrored about
/// it. Throws BadInput where the waterline has fewer than two points or no length.
Segment fitted_waterline(const Bob& bob);

/// The boat's motion on this moment's water. Throws BadInput.
std::shared_ptr<const Displacement> bob(const Bob& bob, const Displacement& water);

}  // namespace stillwater
