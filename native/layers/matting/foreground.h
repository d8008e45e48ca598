#pragma once

#include "core/progress.h"
#include "core/image.h"

namespace stillwater {

struct ForegroundOptions {
  double regularization = 1e-5;  ///< how smooth colours are where alpha is flat
  double gradient_weight = 1;    ///< how much freer they are where it changes
  int small_iterations = 10;     ///< on levels of at most small_size pixels a side
  int big_iterations = 2;        ///< on larger ones
  int small_size = 32;           ///< px
};

struct ForegroundAndBackground {
  Rgba foreground, background;  ///< opaque colours, picture's size
};

/// The colours that a picture is mixed from, P = alpha F + (1 - alpha) B, by the multilevel method: both are smooth,
/// and at each level of a pyramid, small to large, a 2 x 2 system is solved at each pixel from its four neighbours, a
/// few times (Germer, Uelwer, Conrad and Harmeling 2020, "Fast multi-level foreground estimation", eq. 4 and algorithm
/// 1). Even rows come first, then odd ones, each row at once: so that the order of threads does not matter.
///
/// `picture` counts as opaque; `alpha` 0..1 is of its size. Throws BadInput for other sizes and numbers, and options
/// that are not above 0; Cancelled.
ForegroundAndBackground foreground_and_background(const Rgba& picture, const Plane& alpha,
                                                  const ForegroundOptions& options = {}, Progress progress = {});

}  // namespace stillwater
