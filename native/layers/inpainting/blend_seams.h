#pragma once

#include <functional>
#include <limits>

#include "layers/inpainting/seam_cost.h"

namespace stillwater {

struct BlendParameters {
  /// How much the copies themselves count: tone gives way within some 1 / sqrt(screen) pixels of a seam.
  float screen = 0.01f;
  /// Square of a difference of colours at a seam that is as much an edge as a step of tone: beyond it the edge is kept.
  float step_of_tone = 0.001f;
  /// How much more the change from a known pixel into the hole counts than others.
  float border = 1;
  /// The largest such change, in each channel.
  float steepest = std::numeric_limits<float>::max();
};

/// Spreads what differs along the seams of a shift map over the pieces. In the hole the result u minimises
///
///     sum over neighbours p, q of w(p, q) |u(q) - u(p) - g(p, q)|^2  +  screen * sum |u(p) - I(p + s_p)|^2
///
/// where g is how the picture changes from p to q, seen with p's shift and with q's (their mean), and known pixels
/// stay. The weight w falls with how unlike both views are, so that unlike things don't run into each other. Where both
/// have one shift that is the picture's own gradient: so detail is kept, and only tone gives way.
///
/// Perez, Gangnet, Blake 2003, "Poisson image editing", equation 7, screened as in Bhat et al. 2008, "Fourier analysis
/// of the 2D screened Poisson equation". Solved by conjugate gradients.
///
/// `colour` holds the copies in the hole (copy_shifted()), and the result afterwards; alpha stays within 0..1, colours
/// stay within 0 and alpha, or the copy where that is beyond. `at`: see patch_match().
void blend_seams(const ShiftMap& shifts, const Mask& hole, Rgba& colour, const BlendParameters& parameters = {},
                 const std::function<void(double)>& at = {});

}  // namespace stillwater
