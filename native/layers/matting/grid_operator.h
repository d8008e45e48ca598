#pragma once

#include <functional>
#include <type_traits>
#include <vector>

#include "layers/matting/sparse_grid.h"

namespace stillwater {

/// A linear operator over a sparse grid whose nodes hold B numbers each, and which ties a node to its 5 x 5 neighbours:
/// what a multigrid needs of one of its levels. Vectors hold B numbers an entry of the grid.
template <int B>
struct GridOperator {
  /// The many numbers of the finest level are half as long: what takes time is to read them.
  using Coefficient = std::conditional_t<B == 1, float, double>;

  const SparseGrid* grid = nullptr;
  const Coefficient* coefficients = nullptr;  ///< 25 blocks of B x B a node, those of no nodes are 0
  const double* inverses = nullptr;           ///< of each node's own block, B x B

  /// One sweep of Gauss-Seidel, in place: stripes of rows, first the even, then the odd ones, or all of it backwards.
  void relax(const std::vector<double>& right, std::vector<double>& solution, bool backwards) const;

  /// residual = right - operator * solution.
  void find_residual(const std::vector<double>& right, const std::vector<double>& solution,
                     std::vector<double>& residual) const;
};

extern template struct GridOperator<1>;
extern template struct GridOperator<4>;

/// Calls `work(first_row, last_row)` for stripes of `height` rows of a grid. Where there is little to do, by the count
/// of numbers, one thread does it all: to wake another takes longer.
void in_stripes(const SparseGrid& grid, int height, int numbers, const std::function<void(int first, int last)>& work);

/// The same, the even stripes at once, then the odd ones, or the other way round: a stripe may touch the nearest rows
/// of its neighbours.
void in_alternate_stripes(const SparseGrid& grid, int height, int numbers, bool backwards,
                          const std::function<void(int first, int last)>& work);

}  // namespace stillwater
