#include "flow/radial_fill.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"

namespace stillwater {
namespace {

// Two grids, each finer by these; the last one is the pixels.
constexpr int coarse_cell = 2;  // nodes of the fine grid along a cell of the coarse one
constexpr int fine_cell = 8;    // pixels along a cell of the fine grid
constexpr int near = 3;         // cells: centres no further off are evaluated at each place
constexpr int taps = 4;

/// Values at nodes `pitch` px apart, channel by channel; node (0, 0) lies at (start, start).
struct Grid {
  int pitch, start, columns, rows;
  std::vector<double> values;

  Grid(int pitch_, int start_, cv::Size covered, int channels)
      : pitch(pitch_), start(start_), columns((covered.width - start + pitch - 1) / pitch + taps),
        rows((covered.height - start + pitch - 1) / pitch + taps),
        values(static_cast<std::size_t>(channels) * columns * rows) {}

  double* row(int channel, int y) { return &values[(static_cast<std::size_t>(channel) * rows + y) * columns]; }
  const double* row(int channel, int y) const { return const_cast<Grid*>(this)->row(channel, y); }
  int at(int node) const { return start + node * pitch; }
};

/// Lagrange's weights of the nodes at -1, 0, 1, 2 for places (i + offset) / count between 0 and 1.
template <int count>
std::array<std::array<float, taps>, count> lagrange_weights(double offset) {
  std::array<std::array<float, taps>, count> weights;
  for (int i = 0; i < count; ++i) {
    const double t = (i + offset) / count;
    weights[i] = {static_cast<float>(-t * (t - 1) * (t - 2) / 6), static_cast<float>((t + 1) * (t - 1) * (t - 2) / 2),
                  static_cast<float>(-(t + 1) * t * (t - 2) / 2), static_cast<float>((t + 1) * t * (t - 1) / 6)};
  }
  return weights;
}

void evaluate(const RadialInterpolation& interpolation, int channels, Grid& grid) {
  parallel_rows(grid.rows, 2, [&](int first, int last) {
    std::vector<float> apart(grid.columns);
    for (int y = first; y < last; ++y) {
      for (int c = 0; c < channels; ++c) std::fill_n(grid.row(c, y), grid.columns, interpolation.constant()[c]);
      for (std::size_t k = 0; k < interpolation.centres().size(); ++k) {
        const Point centre = interpolation.centres()[k];
        const auto left = static_cast<float>(grid.start - centre.x), dy = static_cast<float>(grid.at(y) - centre.y);
        const float square = dy * dy, pitch = static_cast<float>(grid.pitch);
        for (int x = 0; x < grid.columns; ++x) {
          const float dx = left + static_cast<float>(x) * pitch;
          apart[x] = std::sqrt(dx * dx + square);
        }
        for (int c = 0; c < channels; ++c) {
          const double weight = interpolation.weights()(k, c);
          double* out = grid.row(c, y);
          for (int x = 0; x < grid.columns; ++x) out[x] -= weight * apart[x];
        }
      }
    }
  });
}

/// Which centres lie in which cell of a grid.
class Bins {
 public:
  Bins(const std::vector<Point>& centres, const Grid& grid) : columns_(grid.columns), rows_(grid.rows), inside_(columns_ * rows_) {
    for (std::size_t k = 0; k < centres.size(); ++k) {
      const int x = static_cast<int>((centres[k].x - grid.start) / grid.pitch);
      const int y = static_cast<int>((centres[k].y - grid.start) / grid.pitch);
      inside_[y * columns_ + x].push_back(static_cast<int>(k));
    }
  }

  void around(int x, int y, std::vector<int>& found) const {
    found.clear();
    for (int v = std::max(0, y - near); v <= std::min(rows_ - 1, y + near); ++v)
      for (int u = std::max(0, x - near); u <= std::min(columns_ - 1, x + near); ++u) {
        const auto& some = inside_[v * columns_ + u];
        found.insert(found.end(), some.begin(), some.end());
      }
  }

 private:
  int columns_, rows_;
  std::vector<std::vector<int>> inside_;
};

/// One cell of a grid, with `count` x `count` places in it, (i + offset) * spacing from its corner.
template <int channels, int count>
class Cell {
 public:
  Cell(const Grid& grid, int x, int y) : left_(grid.at(x)), top_(grid.at(y)), pitch_(grid.pitch) {
    for (int c = 0; c < channels; ++c)
      for (int v = 0; v < taps; ++v)
        for (int u = 0; u < taps; ++u) nodes_[c][v][u] = static_cast<float>(grid.row(c, y - 1 + v)[x - 1 + u]);
  }

  /// Before interpolate().
  void leave_out(Point centre, const float* weights) {
    const auto x = static_cast<float>(left_ - centre.x), y = static_cast<float>(top_ - centre.y);
    for (int v = 0; v < taps; ++v) {
      const float dy = y + static_cast<float>((v - 1) * pitch_);
      float apart[taps];
      for (int u = 0; u < taps; ++u) {
        const float dx = x + static_cast<float>((u - 1) * pitch_);
        apart[u] = std::sqrt(dx * dx + dy * dy);
      }
      for (int c = 0; c < channels; ++c)
        for (int u = 0; u < taps; ++u) nodes_[c][v][u] += weights[c] * apart[u];
    }
  }

  void interpolate(const std::array<std::array<float, taps>, count>& weights) {
    for (int c = 0; c < channels; ++c)
      for (int j = 0; j < count; ++j) {
        const auto& down = weights[j];
        float line[taps];
        for (int u = 0; u < taps; ++u)
          line[u] = down[0] * nodes_[c][0][u] + down[1] * nodes_[c][1][u] + down[2] * nodes_[c][2][u] + down[3] * nodes_[c][3][u];
        for (int i = 0; i < count; ++i) {
          const auto& across = weights[i];
          values[c][j][i] = across[0] * line[0] + across[1] * line[1] + across[2] * line[2] + across[3] * line[3];
        }
      }
  }

  void put_in(Point centre, const float* weights, double offset) {
    const float spacing = static_cast<float>(pitch_) / count, first = static_cast<float>(offset) * spacing;
    const auto x = static_cast<float>(left_ - centre.x) + first, y = static_cast<float>(top_ - centre.y) + first;
    for (int j = 0; j < count; ++j) {
      const float dy = y + static_cast<float>(j) * spacing;
      float apart[count];
      for (int i = 0; i < count; ++i) {
        const float dx = x + static_cast<float>(i) * spacing;
        apart[i] = std::sqrt(dx * dx + dy * dy);
      }
      for (int c = 0; c < channels; ++c)
        for (int i = 0; i < count; ++i) values[c][j][i] -= weights[c] * apart[i];
    }
  }

  float values[channels][count][count];

 private:
  int left_, top_, pitch_;
  float nodes_[channels][taps][taps];
};

/// Calls `put(x, y, cell)` for every cell (x, y) of a grid that has a node on each side of it.
template <int channels, int count, class Put>
void fill_cells(const RadialInterpolation& interpolation, const Grid& grid, double offset, const Put& put) {
  const auto weights = lagrange_weights<count>(offset);
  const Bins bins(interpolation.centres(), grid);
  std::vector<std::array<float, channels>> strengths(interpolation.centres().size());
  for (std::size_t k = 0; k < strengths.size(); ++k)
    for (int c = 0; c < channels; ++c) strengths[k][c] = static_cast<float>(interpolation.weights()(k, c));
  parallel_rows(grid.rows - taps + 1, 2, [&](int first, int last) {
    std::vector<int> around;
    for (int y = first + 1; y < last + 1; ++y)
      for (int x = 1; x < grid.columns - taps + 2; ++x) {
        Cell<channels, count> cell(grid, x, y);
        bins.around(x, y, around);
        for (const int k : around) cell.leave_out(interpolation.centres()[k], strengths[k].data());
        cell.interpolate(weights);
        for (const int k : around) cell.put_in(interpolation.centres()[k], strengths[k].data(), offset);
        put(x, y, cell);
      }
  });
}

}  // namespace

template <class Pixel>
cv::Mat_<Pixel> radial_fill(const RadialInterpolation& interpolation, cv::Size picture) {
  constexpr int channels = cv::DataType<Pixel>::channels;
  constexpr int coarse_pitch = coarse_cell * fine_cell;
  Grid fine(fine_cell, -fine_cell, picture, channels);
  const cv::Size reached(fine.at(fine.columns), fine.at(fine.rows));
  Grid coarse(coarse_pitch, -2 * coarse_pitch, reached, channels);
  evaluate(interpolation, channels, coarse);

  fill_cells<channels, coarse_cell>(interpolation, coarse, 0, [&](int x, int y, const auto& cell) {
    const int left = (coarse.at(x) - fine.start) / fine_cell, top = (coarse.at(y) - fine.start) / fine_cell;
    for (int j = std::max(0, -top); j < std::min(coarse_cell, fine.rows - top); ++j)
      for (int c = 0; c < channels; ++c)
        for (int i = std::max(0, -left); i < std::min(coarse_cell, fine.columns - left); ++i)
          fine.row(c, top + j)[left + i] = cell.values[c][j][i];
  });

  cv::Mat_<Pixel> filled(picture);
  fill_cells<channels, fine_cell>(interpolation, fine, 0.5, [&](int x, int y, const auto& cell) {
    const int left = fine.at(x), top = fine.at(y);
    const int rows = std::min(fine_cell, picture.height - top), columns = std::min(fine_cell, picture.width - left);
    for (int j = 0; j < rows; ++j) {
      float* out = columns > 0 ? reinterpret_cast<float*>(filled[top + j] + left) : nullptr;
      for (int i = 0; i < columns; ++i)
        for (int c = 0; c < channels; ++c) out[i * channels + c] = cell.values[c][j][i];
    }
  });
  return filled;
}

template Plane radial_fill<float>(const RadialInterpolation&, cv::Size);
template Field radial_fill<cv::Vec2f>(const RadialInterpolation&, cv::Size);

}  // namespace stillwater
