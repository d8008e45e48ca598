#pragma once

#include <memory>
#include <vector>

#include "layers/matting/matting_laplacian.h"

namespace stillwater {

struct MultigridOptions {
  int spacing = 8;    ///< pixels between the nodes of the first coarse grid, 2 or more; each further one doubles it
  int coarsest = 40;  ///< nodes that are solved directly
};

/// A preconditioner for the matting Laplacian: one V-cycle of a multigrid made for it. What the Laplacian hardly sees
/// are alphas that are locally an affine function of colour, alpha = a . I + b (Levin, Lischinski and Weiss 2008, 3.1).
/// So a node of a coarse grid has the four unknowns (b, a), and between nodes (b, a) is bilinear. The coarse systems
/// are P' L P (Galerkin); all levels are smoothed by Gauss-Seidel, forward before the correction, backward after it.
///
/// Symmetric and positive definite; the same bytes for any number of threads.
class MattingMultigrid {
 public:
  /// `system` must outlive it.
  explicit MattingMultigrid(const MattingSystem& system, const MultigridOptions& options = {});
  ~MattingMultigrid();

  /// `solution` is about coefficients^-1 * right; both are vectors of the system's grid. For one thread at a time.
  void solve_roughly(const std::vector<double>& right, std::vector<double>& solution);

 private:
  struct Levels;
  std::unique_ptr<Levels> levels_;
};

/// product = coefficients * vector. Entries of known pixels stay 0.
void multiply(const MattingSystem& system, const std::vector<double>& vector, std::vector<double>& product);

}  // namespace stillwater
