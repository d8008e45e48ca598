#pragma once

#include <array>
#include <vector>

#include "layers/matting/sparse_grid.h"

namespace stillwater {

/// A coarse grid, `spacing` nodes of a fine one apart, with four numbers a node, and the way between the two: bilinear
/// between coarse nodes, and then, where a fine node holds one number only, the product with its basis.
struct GridCoarsening {
  SparseGrid grid;                          ///< the coarse nodes that any fine node lies between
  int spacing = 2;
  std::vector<std::array<int, 2>> parents;  ///< of each fine node: the coarse entries of its top and bottom left
};

GridCoarsening coarsened(const SparseGrid& fine, int spacing);

/// What a fine node's number is made of: (1, red, green, blue) at each entry of the fine grid.
using Basis = std::vector<std::array<double, 4>>;

/// coarse += P' fine, and fine += P coarse. `basis` of a grid with one number a node; nullptr where it holds four.
void restrict_to(const GridCoarsening& way, const SparseGrid& fine_grid, const Basis* basis,
                 const std::vector<double>& fine, std::vector<double>& coarse);
void interpolate_from(const GridCoarsening& way, const SparseGrid& fine_grid, const Basis* basis,
                      const std::vector<double>& coarse, std::vector<double>& fine);

/// P' A P: 25 blocks of 4 x 4 (column by column) a coarse node, from 25 blocks of B x B a fine node.
template <int B>
std::vector<double> galerkin(const GridCoarsening& way, const SparseGrid& fine_grid, const Basis* basis,
                             const double* coefficients);

extern template std::vector<double> galerkin<1>(const GridCoarsening&, const SparseGrid&, const Basis*, const double*);
extern template std::vector<double> galerkin<4>(const GridCoarsening&, const SparseGrid&, const Basis*, const double*);

}  // namespace stillwater
