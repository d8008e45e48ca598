#pragma once

#include <functional>
#include <optional>

#include "layers/matting/matting_laplacian.h"

namespace stillwater {

struct ClosedFormOptions {
  double epsilon = 1e-7;             ///< regularises the windows' covariances (squared colour; eq. 12)
  double tolerance = 1e-6;           ///< alpha
  std::optional<MattePrior> prior = {};   ///< what is thought of alpha before
  std::optional<Plane> start = {};        ///< a matte that is near, of the picture's size
  int spacing = 8;                   ///< pixels between the nodes of the multigrid's first coarse grid
};

struct ClosedFormMatte {
  Plane alpha;         ///< unclipped; what is known is 0 or 1
  int iterations = 0;  ///< of conjugate gradients
};

/// Closed-form matting (Levin, Lischinski and Weiss 2008, eq. 12 and 13): alpha minimises alpha' L alpha, what is known
/// being known exactly (so their lambda is infinite). Solved for the unknown pixels only, by conjugate gradients with a
/// multigrid preconditioner.
///
/// `picture` and `trimap` are of one size; no unknown pixels is fine. Throws BadInput where foreground or background is
/// missing, NotConverged, Cancelled.
ClosedFormMatte closed_form_matte(const Rgba& picture, const Trimap& trimap, const ClosedFormOptions& options = {},
                                  const std::function<void(double)>& done = [](double) {});

}  // namespace stillwater
