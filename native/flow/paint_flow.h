#pragma once

#include <vector>

#include "core/image.h"
#include "flow/flow_stroke.h"

namespace stillwater {

/// The two components of a flow field, painted apart (Phi_o and Phi_s of Okabe et al. 2009, 5.1).
struct PaintedFlow {
  Field orientation;  ///< unit vectors
  Plane speed;        ///< px per frame, 0 or more
  Field wall;         ///< what the flow slides along (obstacles.h); empty without a bound
};

/// Paints a flow over a picture with two brushes: the orientation brush says the direction in which the stroke was drawn, the
/// speed brush a number. Okabe et al. 2009, 5.1; METHODS.md 2, "Flow painting".
///
/// - Both are interpolated over the picture by the radial basis function phi(r) = r (radial_interpolation.h), x and y of the
///   orientation apart and then normalised; speeds below 0 become 0. What lies under the strokes is met within 0.03 (1.7
///   degrees), speeds within 2 % of the largest one, as long as 600 centres (12 a stroke, at most 2000) do for that: against
///   the solution on all of the strokes' pixels, 30 strokes that partly cross are 0.5 degrees off in the mean, 3 in 99 % of the
///   picture. Where x and y both vanish, the direction is to the right.
/// - A later stroke paints over an earlier one where they cross. Two that run against each other side by side both hold, and
///   the flow turns between them; the middle of a whirl has no direction of its own.
/// - `alpha` of a stroke, over the largest one of its kind: how far the field under it goes from what the others say to what
///   it says. 0 says nothing.
/// - A local stroke changes only its neighbourhood (local_stroke.h), over all global ones and in the strokes' order. Where all
///   strokes are local, their orientation holds everywhere and the speed away from them is 0.
/// - Where no global stroke says a speed, it is FlowStroke's usual one.
/// - `bound`: the layer's matte, 0..1, or empty: nothing runs through its outline; what comes near slides along it (obstacles.h).
/// - `freeze`: 0..1, or empty: 1 is held still, and the speed falls to that smoothly over a short way around.
///
/// Throws BadInput: no stroke; none that says an orientation touches the picture, or of those that say a speed none; a
/// stroke that is not what stroke_track.h allows; a bound or freeze of another size than the picture or outside of 0..1.
PaintedFlow paint_flow(const std::vector<FlowStroke>& strokes, cv::Size picture, const Plane& bound = {},
                       const Plane& freeze = {});

/// Its parts: the unit vectors, the speeds, and what bound and freeze do to a flow.
Field paint_orientation(const std::vector<FlowStroke>& strokes, cv::Size picture);
Plane paint_speed(const std::vector<FlowStroke>& strokes, cv::Size picture);
void bound_flow(PaintedFlow& flow, const Plane& bound, const Plane& freeze);

}  // namespace stillwater
