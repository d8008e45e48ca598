#include "layers/matting/grid_coarsening.h"

#include <algorithm>

#include "layers/matting/grid_operator.h"

namespace stillwater {
namespace {

// Stripes of fine rows, this many rows of the coarse grid high.
constexpr int coarse_rows = 4;

// A place on one axis between two coarse nodes.
struct Between {
  int node;
  double weight, next;  // of the node, and of the one after it
};

Between between(int place, int spacing) {
  const double share = static_cast<double>(place % spacing) / spacing;
  return {place / spacing, 1 - share, share};
}

template <class Work>
void each_node(const SparseGrid& grid, int top, int bottom, const Work& work) {
  for (int y = top; y < bottom; ++y)
    for (int node = grid.row[y]; node < grid.row[y + 1]; ++node) work(node, grid.column[node], y);
}

// The four coarse entries around a fine node and their weights.
struct Corners {
  std::array<size_t, 4> entries;
  std::array<double, 4> weights;
};

Corners corners(const GridCoarsening& way, int node, int x, int y) {
  const Between across = between(x, way.spacing), down = between(y, way.spacing);
  const size_t top = static_cast<size_t>(way.parents[node][0]), bottom = static_cast<size_t>(way.parents[node][1]);
  return {{top, top + 1, bottom, bottom + 1},
          {down.weight * across.weight, down.weight * across.next, down.next * across.weight, down.next * across.next}};
}

// One fine node's row of A P: for each coarse node near it a block of B x 4.
template <int B>
struct RowTimesP {
  double block[4][4][4][B];  // coarse node down, across, its number, the fine node's number
};

template <int B>
void row_times_p(const SparseGrid& fine, const Basis* basis, const double* blocks, int node, int x, int y, int spacing,
                 RowTimesP<B>& sum) {
  std::fill_n(&sum.block[0][0][0][0], 4 * 4 * 4 * B, 0.0);
  const int left = x / spacing - 1, top = y / spacing - 1;
  for (int k = 0; k < 25; ++k, blocks += B * B) {
    const int nx = x + k % 5 - 2, ny = y + k / 5 - 2;
    if (nx < 0 || ny < 0 || nx >= fine.width || ny >= fine.height) continue;
    const Between across = between(nx, spacing), down = between(ny, spacing);
    double part[4][B];
    if constexpr (B == 1) {
      if (blocks[0] == 0) continue;
      const auto& values = (*basis)[static_cast<size_t>(fine.around[node][k / 5] + k % 5)];
      for (int j = 0; j < 4; ++j) part[j][0] = blocks[0] * values[j];
    } else {
      std::copy_n(blocks, 16, &part[0][0]);
    }
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const double weight = (j ? down.next : down.weight) * (i ? across.next : across.weight);
        if (weight == 0) continue;
        double* target = &sum.block[down.node + j - top][across.node + i - left][0][0];
        for (int n = 0; n < 4 * B; ++n) target[n] += weight * (&part[0][0])[n];
      }
  }
}

// P' of one fine node times its row of A P, added to the blocks of its (up to four) coarse nodes.
template <int B>
void add_to_coarse(const std::vector<int>& node_of_entry, const Corners& corner,
                   const std::array<double, 4>& values, const RowTimesP<B>& row, double* coarse) {
  for (int corner_index = 0; corner_index < 4; ++corner_index) {
    const double weight = corner.weights[corner_index];
    if (weight == 0) continue;
    const int down = 1 + corner_index / 2, across = 1 + corner_index % 2;
    double* blocks = coarse + static_cast<size_t>(node_of_entry[corner.entries[corner_index]]) * 400;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        double* block = blocks + ((j - down + 2) * 5 + i - across + 2) * 16;
        for (int b = 0; b < 4; ++b)
          for (int a = 0; a < 4; ++a) {
            if constexpr (B == 1) block[b * 4 + a] += weight * values[a] * row.block[j][i][b][0];
            else block[b * 4 + a] += weight * row.block[j][i][b][a];
          }
      }
  }
}

}  // namespace

GridCoarsening coarsened(const SparseGrid& fine, int spacing) {
  GridCoarsening way;
  way.spacing = spacing;
  cv::Mat_<unsigned char> nodes =
      cv::Mat_<unsigned char>::zeros((fine.height - 1) / spacing + 2, (fine.width - 1) / spacing + 2);
  each_node(fine, 0, fine.height, [&](int, int x, int y) {
    const int cx = x / spacing, cy = y / spacing, wide = x % spacing != 0, high = y % spacing != 0;
    for (int j = 0; j <= high; ++j)
      for (int i = 0; i <= wide; ++i) nodes(cy + j, cx + i) = 1;
  });
  way.grid = make_sparse_grid(nodes);
  way.parents.resize(static_cast<size_t>(fine.nodes()));
  const EntryRows rows(nodes);
  std::vector<int> top, bottom;
  for (int y = 0; y < fine.height; ++y) {
    const int cy = y / spacing;
    if (fine.row[y] == fine.row[y + 1]) continue;
    rows.find(cy, way.grid.entry_row[cy + 2], top);
    rows.find(cy + 1, way.grid.entry_row[cy + 3], bottom);
    for (int node = fine.row[y]; node < fine.row[y + 1]; ++node) {
      const int at = fine.column[node] / spacing + 2;
      way.parents[node] = {top[at], bottom[at]};
    }
  }
  return way;
}

void restrict_to(const GridCoarsening& way, const SparseGrid& fine_grid, const Basis* basis,
                 const std::vector<double>& fine, std::vector<double>& coarse) {
  in_alternate_stripes(fine_grid, coarse_rows * way.spacing, fine_grid.nodes(), false, [&](int top, int bottom) {
    each_node(fine_grid, top, bottom, [&](int node, int x, int y) {
      const size_t entry = static_cast<size_t>(fine_grid.entry(node));
      std::array<double, 4> values;
      for (int b = 0; b < 4; ++b) values[b] = basis ? fine[entry] * (*basis)[entry][b] : fine[entry * 4 + b];
      const Corners corner = corners(way, node, x, y);
      for (int k = 0; k < 4; ++k) {
        if (corner.weights[k] == 0) continue;
        for (int b = 0; b < 4; ++b) coarse[corner.entries[k] * 4 + b] += corner.weights[k] * values[b];
      }
    });
  });
}

void interpolate_from(const GridCoarsening& way, const SparseGrid& fine_grid, const Basis* basis,
                      const std::vector<double>& coarse, std::vector<double>& fine) {
  in_stripes(fine_grid, 16, fine_grid.nodes(), [&](int top, int bottom) {
    each_node(fine_grid, top, bottom, [&](int node, int x, int y) {
      const size_t entry = static_cast<size_t>(fine_grid.entry(node));
      const Corners corner = corners(way, node, x, y);
      std::array<double, 4> values{};
      for (int k = 0; k < 4; ++k)
        for (int b = 0; b < 4; ++b) values[b] += corner.weights[k] * coarse[corner.entries[k] * 4 + b];
      if (!basis)
        for (int b = 0; b < 4; ++b) fine[entry * 4 + b] += values[b];
      else
        for (int b = 0; b < 4; ++b) fine[entry] += values[b] * (*basis)[entry][b];
    });
  });
}

template <int B>
std::vector<double> galerkin(const GridCoarsening& way, const SparseGrid& fine_grid, const Basis* basis,
                             const double* coefficients) {
  std::vector<double> coarse(static_cast<size_t>(way.grid.nodes()) * 400, 0.0);
  std::vector<int> node_of_entry(static_cast<size_t>(way.grid.entries()), -1);
  for (int node = 0; node < way.grid.nodes(); ++node) node_of_entry[way.grid.entry(node)] = node;
  const int numbers = fine_grid.nodes() * 16;
  in_alternate_stripes(fine_grid, coarse_rows * way.spacing, numbers, false, [&](int top, int bottom) {
    RowTimesP<B> row;
    each_node(fine_grid, top, bottom, [&](int node, int x, int y) {
      row_times_p<B>(fine_grid, basis, coefficients + static_cast<size_t>(node) * 25 * B * B, node, x, y, way.spacing,
                     row);
      const std::array<double, 4> values =
          basis ? (*basis)[static_cast<size_t>(fine_grid.entry(node))] : std::array<double, 4>{};
      add_to_coarse<B>(node_of_entry, corners(way, node, x, y), values, row, coarse.data());
    });
  });
  return coarse;
}

template std::vector<double> galerkin<1>(const GridCoarsening&, const SparseGrid&, const Basis*, const double*);
template std::vector<double> galerkin<4>(const GridCoarsening&, const SparseGrid&, const Basis*, const double*);

}  // namespace stillwater
