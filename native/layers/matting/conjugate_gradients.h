#pragma once

#include <functional>

#include "layers/matting/matting_multigrid.h"

namespace stillwater {

struct ConjugateGradientsOptions {
  double tolerance = 1e-6;  ///< alpha; the largest correction that still counts
  int iterations = 1000;    ///< at most
};

/// Preconditioned conjugate gradients (Hestenes and Stiefel 1952): improves `solution` until no pixel would change by
/// more than the tolerance, as far as the preconditioner can tell. Gives the number of iterations. `done`, called after
/// each, is told how far it is, 0..1. Throws NotConverged where that many iterations are not enough.
int solve_by_conjugate_gradients(const MattingSystem& system, MattingMultigrid& preconditioner,
                                 std::vector<double>& solution, const ConjugateGradientsOptions& options,
                                 const std::function<void(double)>& done);

}  // namespace stillwater
