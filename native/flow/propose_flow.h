#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "flow/paint_flow.h"

namespace stillwater {

/// What flows, as an artist calls it. It says which way streaks run where they could run either way, and how fast.
enum class FluidKind { water, falls, fire, smoke, sky };

/// "water", "falls", "fire", "smoke", "sky". Throws BadInput for another name.
FluidKind fluid_kind_named(const std::string& name);

/// A field from the picture's own structure: fluids show the way they run as streaks.
///
/// - Direction: the eigenvector of the smoothed structure tensor along which colours change least (Bigun and Granlund 1987;
///   over all colours, Di Zenzo 1986), as a mean of doubled angles. Each gradient counts by its size, not by its square: a
///   fluid's faint streaks against hard edges.
/// - The kind's direction joins that mean, and holds where nothing is seen: falls down, fire and smoke up, sky to the right,
///   water to the right and a little towards the viewer.
/// - Sign: the one that agrees with the kind's direction, and with the neighbourhood where the two stand across each other.
/// - Speed: the kind's, in parts of the picture's diagonal a frame (water 0.0015, falls 0.004, fire 0.003, smoke 0.0015, sky
///   0.0006), less where the fluid runs across its kind's direction.
///
/// Strokes correct it (their alpha and local as in paint_flow.h; there may be none): the painted orientation takes the place
/// of the kind's direction everywhere, and of the picture's near the strokes; a painted speed that of the kind's speed.
///
/// `picture`: premultiplied. `bound`, `freeze`: as paint_flow.h; only what lies in `bound` is looked at. Throws BadInput for a
/// picture without pixels or with a colour that is not finite, and what paint_flow throws.
PaintedFlow propose_flow(const Rgba& picture, FluidKind kind, const std::vector<FlowStroke>& strokes = {},
                         const Plane& bound = {}, const Plane& freeze = {});

}  // namespace stillwater
