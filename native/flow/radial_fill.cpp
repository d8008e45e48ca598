#include "flow/radial_fill.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int pitch = 8;  // px, between the grid's nodes
constexpr int near = 2;   // cells: centres no further off are evaluated at each pixel
constexpr int taps = 4;

using Weights = std::array<std::array<float, taps>, pitch>;

/// Of the nodes at -1, 0, 1, 2 for the pixels of the cell between 0 and 1.
Weights lagrange_weights() {
  Weights weights;
  for (int i = 0; i < pitch; ++i) {
    const double t = (i + 0.5) / pitch;
    weights[i] = {static_cast<float>(-t * (t - 1) * (t - 2) / 6), static_cast<float>((t + 1) * (t - 1) * (t - 2) / 2),
                  static_cast<float>(-(t + 1) * t * (t - 2) / 2), static_cast<float>((t + 1) * t * (t - 1) / 6)};
  }
  return weights;
}

/// The nodes' values: channel by channel, row by row; node (0, 0) lies one pitch outside of the picture's corner.
struct Nodes {
  int columns, rows;
  std::vector<double> values;

  double* row(int channel, int y) { return &values[(static_cast<std::size_t>(channel) * rows + y) * columns]; }
  const double* row(int channel, int y) const { return const_cast<Nodes*>(this)->row(channel, y); }
};

Nodes evaluate_nodes(const RadialInterpolation& interpolation, cv::Size cells) {
  const int channels = static_cast<int>(interpolation.weights().cols());
  Nodes nodes{cells.width + taps - 1, cells.height + taps - 1, {}};
  nodes.values.resize(static_cast<std::size_t>(channels) * nodes.columns * nodes.rows);
  parallel_rows(nodes.rows, 4, [&](int first, int last) {
    std::vector<double> apart(nodes.columns);
    for (int y = first; y < last; ++y) {
      for (int c = 0; c < channels; ++c) std::fill_n(nodes.row(c, y), nodes.columns, interpolation.constant()[c]);
      for (std::size_t k = 0; k < interpolation.centres().size(); ++k) {
        const Point centre = interpolation.centres()[k];
        const double dy = (y - 1) * pitch - centre.y, square = dy * dy;
        for (int x = 0; x < nodes.columns; ++x) {
          const double dx = (x - 1) * pitch - centre.x;
          apart[x] = std::sqrt(dx * dx + square);
        }
        for (int c = 0; c < channels; ++c) {
          const double weight = interpolation.weights()(k, c);
          double* out = nodes.row(c, y);
          for (int x = 0; x < nodes.columns; ++x) out[x] -= weight * apart[x];
        }
      }
    }
  });
  return nodes;
}

/// Which centres lie in which cell.
class Bins {
 public:
  Bins(const std::vector<Point>& centres, cv::Size cells) : cells_(cells), inside_(cells.area()) {
    for (std::size_t k = 0; k < centres.size(); ++k) {
      const int x = static_cast<int>(centres[k].x) / pitch, y = static_cast<int>(centres[k].y) / pitch;
      inside_[y * cells.width + x].push_back(static_cast<int>(k));
    }
  }

  void around(int x, int y, std::vector<int>& found) const {
    found.clear();
    for (int v = std::max(0, y - near); v <= std::min(cells_.height - 1, y + near); ++v)
      for (int u = std::max(0, x - near); u <= std::min(cells_.width - 1, x + near); ++u) {
        const auto& some = inside_[v * cells_.width + u];
        found.insert(found.end(), some.begin(), some.end());
      }
  }

 private:
  cv::Size cells_;
  std::vector<std::vector<int>> inside_;
};

/// One cell of one picture.
template <int channels>
class Cell {
 public:
  Cell(const Nodes& nodes, int x, int y) : left_(x * pitch), top_(y * pitch) {
    for (int c = 0; c < channels; ++c)
      for (int v = 0; v < taps; ++v)
        for (int u = 0; u < taps; ++u) nodes_[c][v][u] = static_cast<float>(nodes.row(c, y + v)[x + u]);
  }

  /// Before interpolate().
  void leave_out(Point centre, const float* weights) {
    for (int v = 0; v < taps; ++v)
      for (int u = 0; u < taps; ++u) {
        const auto dx = static_cast<float>(left_ + (u - 1) * pitch - centre.x);
        const auto dy = static_cast<float>(top_ + (v - 1) * pitch - centre.y);
        const float apart = std::sqrt(dx * dx + dy * dy);
        for (int c = 0; c < channels; ++c) nodes_[c][v][u] += weights[c] * apart;
      }
  }

  void interpolate(const Weights& weights) {
    for (int c = 0; c < channels; ++c)
      for (int j = 0; j < pitch; ++j) {
        const auto& down = weights[j];
        float line[taps];
        for (int u = 0; u < taps; ++u)
          line[u] = down[0] * nodes_[c][0][u] + down[1] * nodes_[c][1][u] + down[2] * nodes_[c][2][u] + down[3] * nodes_[c][3][u];
        for (int i = 0; i < pitch; ++i) {
          const auto& across = weights[i];
          values[c][j][i] = across[0] * line[0] + across[1] * line[1] + across[2] * line[2] + across[3] * line[3];
        }
      }
  }

  void put_in(Point centre, const float* weights) {
    for (int j = 0; j < pitch; ++j) {
      const auto dy = static_cast<float>(top_ + j + 0.5 - centre.y);
      const auto start = static_cast<float>(left_ + 0.5 - centre.x);
      float apart[pitch];
      for (int i = 0; i < pitch; ++i) {
        const float dx = start + static_cast<float>(i);
        apart[i] = std::sqrt(dx * dx + dy * dy);
      }
      for (int c = 0; c < channels; ++c)
        for (int i = 0; i < pitch; ++i) values[c][j][i] -= weights[c] * apart[i];
    }
  }

  float values[channels][pitch][pitch];

 private:
  int left_, top_;
  float nodes_[channels][taps][taps];
};

}  // namespace

template <class Pixel>
cv::Mat_<Pixel> radial_fill(const RadialInterpolation& interpolation, cv::Size picture) {
  constexpr int channels = cv::DataType<Pixel>::channels;
  static const Weights weights = lagrange_weights();
  const cv::Size cells((picture.width + pitch - 1) / pitch, (picture.height + pitch - 1) / pitch);
  const Nodes nodes = evaluate_nodes(interpolation, cells);
  const Bins bins(interpolation.centres(), cells);
  std::vector<std::array<float, channels>> strengths(interpolation.centres().size());
  for (std::size_t k = 0; k < strengths.size(); ++k)
    for (int c = 0; c < channels; ++c) strengths[k][c] = static_cast<float>(interpolation.weights()(k, c));

  cv::Mat_<Pixel> filled(picture);
  parallel_rows(cells.height, 2, [&](int first, int last) {
    std::vector<int> around;
    for (int y = first; y < last; ++y)
      for (int x = 0; x < cells.width; ++x) {
        Cell<channels> cell(nodes, x, y);
        bins.around(x, y, around);
        for (const int k : around) cell.leave_out(interpolation.centres()[k], strengths[k].data());
        cell.interpolate(weights);
        for (const int k : around) cell.put_in(interpolation.centres()[k], strengths[k].data());
        const int rows = std::min(pitch, picture.height - y * pitch), columns = std::min(pitch, picture.width - x * pitch);
        for (int j = 0; j < rows; ++j) {
          float* out = reinterpret_cast<float*>(filled[y * pitch + j] + x * pitch);
          for (int i = 0; i < columns; ++i)
            for (int c = 0; c < channels; ++c) out[i * channels + c] = cell.values[c][j][i];
        }
      }
  });
  return filled;
}

template Plane radial_fill<float>(const RadialInterpolation&, cv::Size);
template Field radial_fill<cv::Vec2f>(const RadialInterpolation&, cv::Size);

}  // namespace stillwater
