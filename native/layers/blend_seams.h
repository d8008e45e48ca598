#pragma once

#include <functional>

#include "layers/seam_cost.h"

namespace stillwater {

/// Spreads what differs along the seams of a shift map over the pieces. In the hole the result u minimises
///
///     sum over neighbours p, q of |u(q) - u(p) - g(p, q)|^2  +  screen * sum |u(p) - I(p + s_p)|^2
///
/// where g is how the picture changes from p to q, seen with p's shift and with q's (their mean), and known pixels stay.
/// Where both have one shift that is the picture's own gradient: so detail is kept, and only tone gives way.
///
/// Perez, Gangnet, Blake 2003, "Poisson image editing", equation 7, screened as in Bhat et al. 2008, "Fourier analysis of
/// the 2D screened Poisson equation". Solved by conjugate gradients.
///
/// `colour` holds the copies in the hole (copy_shifted()), and the result afterwards; its colours stay within 0 and
/// their alpha's allowance, alpha within 0..1. `at`: see patch_match().
void blend_seams(const ShiftMap& shifts, const Mask& hole, Rgba& colour, const std::function<void(double)>& at = {});

}  // namespace stillwater
