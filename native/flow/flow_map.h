#pragma once

#include "core/image.h"

/// Where a steady flow carries things: maps made along streamlines, so that a picture carried for k frames is sampled
/// once, not k times (Okabe et al. 2009, 3: W^k; here W^k is one map).
namespace stillwater {

/// Where the fluid takes each pixel's centre in `frames` frames, minus where it was, px. `velocity`: px per frame;
/// beyond its sides the nearest pixel's holds. Negative `frames`: where it came from. Classical Runge-Kutta along the
/// streamline (SteadyFlow::carried()): flow_map(v, a), then flow_map(v, b), is flow_map(v, a + b).
/// Throws BadInput where the velocity is empty or not finite, or `frames` is not within -10,000 .. 10,000.
Field flow_map(const Field& velocity, double frames);

/// The same with a time of its own for each pixel. `frames`: of the velocity's size.
Field flow_map(const Field& velocity, const Plane& frames);

/// The image after `frames` frames: sampled (Catmull-Rom) where the fluid was then. Beyond its sides it goes on
/// mirrored. Throws BadInput as flow_map(), and where the sizes differ.
Rgba advect(const Rgba& image, const Field& velocity, double frames);

}  // namespace stillwater
