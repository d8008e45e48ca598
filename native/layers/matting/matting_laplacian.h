#pragma once

#include <vector>

#include "layers/matting/sparse_grid.h"
#include "layers/matting/trimap.h"

namespace stillwater {

/// What is thought of alpha before the Laplacian is asked: pulls each unknown pixel to `alpha` with `weight`.
struct MattePrior {
  Plane alpha, weight;
};

/// The linear system for the unknown pixels' alphas: coefficients * alpha = right.
struct MattingSystem {
  SparseGrid grid;                   ///< the unknown pixels
  std::vector<double> coefficients;  ///< 25 a node: its 5 x 5 neighbours, row by row, 0 where they are known
  std::vector<double> right;         ///< an entry of the grid each
  std::vector<cv::Vec4f> colours;    ///< an entry of the grid each: (1, red, green, blue), 0 where known
};

/// The matting Laplacian over 3 x 3 windows (Levin, Lischinski and Weiss 2008, eq. 12),
///
///     L(i, j) = sum over windows k with i and j:  d(i, j) - (1 + (I_i - m_k)' (S_k + epsilon/9)^-1 (I_j - m_k)) / 9,
///
/// m_k and S_k the mean and the covariance of the window's colours. Only the rows of unknown pixels, and only windows
/// that hold one, are ever looked at; what is known goes to the right-hand side. Windows lie wholly in the picture,
/// which is at least 3 x 3.
MattingSystem matting_laplacian(const Rgba& picture, const Trimap& trimap, double epsilon);

/// Adds the prior to the system: weight on the diagonal, weight * alpha at the right.
void add_prior(MattingSystem& system, const MattePrior& prior);

}  // namespace stillwater
