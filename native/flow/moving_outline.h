#pragma once

#include "core/image.h"

namespace stillwater {

/// The next outline of fire or smoke (Okabe, Anjyo, Onai 2011, "moving outline"), carried by what is seen to move:
///
///     B_{i+1} = (tau W_i(B_i) + (1 - tau) alpha)^gamma        W_i(B)(x) = B(x - v_i(x))
///
/// with the one gamma that keeps the matte's area, sum B_{i+1} = sum alpha: what is covered and what is clear stays so, soft
/// places give way or fill up. B_1 = alpha. Where nothing moves the outline is the matte.
///
/// `outline`: B_i, 0..1; `matte`: alpha, 0..1; `motion`: v_i, px to the next frame, of the picture of frame i;
/// `persistence`: tau, 0..1. Throws BadInput where sizes differ or a number is out of range or not finite.
Plane moved_outline(const Plane& outline, const Plane& matte, const Field& motion, double persistence);

}  // namespace stillwater
