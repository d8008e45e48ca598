#pragma once

#include <functional>

#include "layers/matting/trimap.h"

namespace stillwater {

struct CoarseToFineOptions {
  int at_once = 400000;           ///< unknown pixels that are solved without a smaller picture first
  int at_once_scribbled = 60000;  ///< the same where more than three quarters of the picture are unknown
  int finest = 1;                 ///< 1, 2, 4, ...: solved on a picture so many times smaller, and enlarged
  double decided = 0.02;          ///< alpha; what comes as near to 0 or 1 as this from the smaller picture is decided
};

/// Solves one level: a picture, what is known of it, and a matte that is near (empty on the first level). Gives alpha
/// 0..1, 0 and 1 where the trimap knows.
using SolveLevel = std::function<Plane(const Rgba& picture, const Trimap& trimap, const Plane& start)>;

/// A matte from coarse to fine (Levin, Lischinski and Weiss 2008, 4.1): where more is unknown than can be solved at
/// once, half the picture is solved first, the same way. Its matte is enlarged as an affine function of colour
/// (enlarge_matte); what it leaves no doubt about is known from then on, and the rest is solved again.
///
/// Scribbles leave large areas open, of which half the picture decides most; a trimap's unknown band holds what only
/// all of the picture's detail can decide.
///
/// `trimap` has foreground and background.
Plane coarse_to_fine(const Rgba& picture, const Trimap& trimap, const CoarseToFineOptions& options,
                     const SolveLevel& solve);

/// A matte of half the picture as one of the whole: around each of its pixels, within 3 x 3, alpha is an affine
/// function of colour, a . I + b (with a ridge, as in He, Sun and Tang 2010, "Guided image filtering", eq. 5 and 6); a
/// and b are interpolated between pixels. 0..1.
Plane enlarge_matte(const Plane& matte, const Rgba& half, const Rgba& picture);

/// Half the size, rounded up: means of 2 x 2 pixels.
Rgba half_of(const Rgba& picture);

/// Half the size, rounded up: a pixel is known where any of its four is, and none is known to be the other.
Trimap half_of(const Trimap& trimap);

}  // namespace stillwater
