#include "layers/matting/matting_laplacian.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int grain = 16;
constexpr int side = 3, area = 9;

// For the window around (x, y): q(i) . q(j) = 1 + (I_i - m)' (S + epsilon/9)^-1 (I_j - m), by a Cholesky factor of S.
std::array<std::array<double, 4>, area> window(const Rgba& picture, int y, int x, double epsilon) {
  std::array<std::array<double, 4>, area> q;
  double mean[3] = {0, 0, 0};
  for (int i = 0; i < area; ++i) {
    const cv::Vec4f& colour = picture(y - 1 + i / side, x - 1 + i % side);
    for (int c = 0; c < 3; ++c) mean[c] += q[i][c] = colour[c];
    q[i][3] = 1;
  }
  for (double& m : mean) m /= area;
  double s00 = 0, s01 = 0, s02 = 0, s11 = 0, s12 = 0, s22 = 0;
  for (auto& d : q) {
    for (int c = 0; c < 3; ++c) d[c] -= mean[c];
    s00 += d[0] * d[0], s01 += d[0] * d[1], s02 += d[0] * d[2];
    s11 += d[1] * d[1], s12 += d[1] * d[2], s22 += d[2] * d[2];
  }
  const double a = std::sqrt((s00 + epsilon) / area), b = s01 / area / a, c = s02 / area / a;
  const double d = std::sqrt(std::max((s11 + epsilon) / area - b * b, epsilon / area * 1e-3));
  const double e = (s12 / area - b * c) / d;
  const double f = std::sqrt(std::max((s22 + epsilon) / area - c * c - e * e, epsilon / area * 1e-3));
  const double over_a = 1 / a, over_d = 1 / d, over_f = 1 / f;
  for (auto& v : q) {
    v[0] *= over_a;
    v[1] = (v[1] - b * v[0]) * over_d;
    v[2] = (v[2] - c * v[0] - e * v[1]) * over_f;
  }
  return q;
}

// Adds one window's part to the rows of those of its pixels that are unknown and lie in rows first .. last - 1.
// `nodes`: the nodes of the window's three rows.
void add_window(const std::array<std::array<double, 4>, area>& q, const std::array<const int*, 3>& nodes, int x,
                std::vector<double>& coefficients) {
  for (int i = 0; i < area; ++i) {
    const int iy = i / side, ix = i % side;
    const int node = nodes[iy] ? nodes[iy][x - 1 + ix] : -1;
    if (node < 0) continue;
    // The entry of the window's first pixel in the 5 x 5 neighbourhood of pixel i.
    double* first = &coefficients[static_cast<size_t>(node) * 25 + (2 - iy) * 5 + 2 - ix];
    for (int j = 0; j < area; ++j)
      first[j / side * 5 + j % side] -=
          (q[i][0] * q[j][0] + q[i][1] * q[j][1] + (q[i][2] * q[j][2] + q[i][3] * q[j][3])) * (1.0 / area);
    first[iy * 5 + ix] += 1;
  }
}

// The node of each pixel of a row, -1 where there is none.
void nodes_of_row(const SparseGrid& grid, int y, int* nodes) {
  std::fill(nodes, nodes + grid.width, -1);
  for (int node = grid.row[y]; node < grid.row[y + 1]; ++node) nodes[grid.column[node]] = node;
}

void add_windows(const Rgba& picture, double epsilon, int first, int last, MattingSystem& system) {
  const SparseGrid& grid = system.grid;
  if (grid.row[first] == grid.row[last]) return;
  const int width = picture.cols;
  std::vector<int> nodes(static_cast<size_t>(width) * (last - first));
  for (int y = first; y < last; ++y) nodes_of_row(grid, y, &nodes[static_cast<size_t>(y - first) * width]);
  for (int y = std::max(1, first - 1); y < std::min(picture.rows - 1, last + 1); ++y) {
    std::array<const int*, 3> rows{};
    for (int dy = 0; dy < 3; ++dy)
      if (const int at = y - 1 + dy; at >= first && at < last)
        rows[dy] = &nodes[static_cast<size_t>(at - first) * width];
    const auto unknown_in_column = [&](int x) {
      return std::any_of(rows.begin(), rows.end(), [x](const int* row) { return row && row[x] >= 0; });
    };
    bool left = unknown_in_column(0), middle = unknown_in_column(1);
    for (int x = 1; x < width - 1; ++x) {
      const bool right = unknown_in_column(x + 1);
      if (left || middle || right) add_window(window(picture, y, x, epsilon), rows, x, system.coefficients);
      left = middle, middle = right;
    }
  }
}

// What is known goes to the right.
void split_known(const Trimap& trimap, int first, int last, MattingSystem& system) {
  const SparseGrid& grid = system.grid;
  for (int y = first; y < last; ++y)
    for (int node = grid.row[y]; node < grid.row[y + 1]; ++node) {
      double* row = &system.coefficients[static_cast<size_t>(node) * 25];
      double right = 0;
      for (int k = 0; k < 25; ++k) {
        const int ny = y + k / 5 - 2, nx = grid.column[node] + k % 5 - 2;
        if (ny < 0 || nx < 0 || ny >= trimap.rows || nx >= trimap.cols) continue;
        const unsigned char label = trimap(ny, nx);
        if (label == known::unknown) continue;
        if (label == known::foreground) right -= row[k];
        row[k] = 0;
      }
      system.right[grid.entry(node)] = right;
    }
}

}  // namespace

MattingSystem matting_laplacian(const Rgba& picture, const Trimap& trimap, double epsilon) {
  MattingSystem system;
  system.grid = make_sparse_grid(cv::Mat_<unsigned char>(trimap == known::unknown));
  const SparseGrid& grid = system.grid;
  system.coefficients.assign(static_cast<size_t>(grid.nodes()) * 25, 0);
  system.right.assign(static_cast<size_t>(grid.entries()), 0);
  system.colours.assign(static_cast<size_t>(grid.entries()), cv::Vec4f());
  parallel_rows(picture.rows, grain, [&](int first, int last) {
    add_windows(picture, epsilon, first, last, system);
    split_known(trimap, first, last, system);
    for (int y = first; y < last; ++y)
      for (int node = grid.row[y]; node < grid.row[y + 1]; ++node) {
        const cv::Vec4f& colour = picture(y, grid.column[node]);
        system.colours[grid.entry(node)] = {1, colour[0], colour[1], colour[2]};
      }
  });
  return system;
}

void add_prior(MattingSystem& system, const MattePrior& prior) {
  const SparseGrid& grid = system.grid;
  for (int y = 0; y < grid.height; ++y)
    for (int node = grid.row[y]; node < grid.row[y + 1]; ++node) {
      const double weight = prior.weight(y, grid.column[node]);
      system.coefficients[static_cast<size_t>(node) * 25 + 12] += weight;
      system.right[grid.entry(node)] += weight * prior.alpha(y, grid.column[node]);
    }
}

}  // namespace stillwater
