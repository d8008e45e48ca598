#include "appearance/cell_curves.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <type_traits>

namespace stillwater {
namespace {

constexpr int mantissa = 23;

/// Places of values between the bins' borders. The bits of a positive float, as a number, are its logarithm with straight
/// pieces between powers of two.
struct Ruler {
  float centre, floor, middle, scale;
  std::int32_t start, end;

  explicit Ruler(const Bins& bins)
      : centre(bins.centre),
        floor(bins.floor),
        middle(static_cast<float>(bins.count() / 2)),
        scale(1.0f / static_cast<float>(1 << (mantissa - bins.fine))),
        start(std::bit_cast<std::int32_t>(bins.floor)),
        end(bins.doublings << mantissa) {}

  float operator()(float x) const {
    const float away = x - centre;
    const std::int32_t steps = std::min(std::bit_cast<std::int32_t>(std::abs(away) + floor) - start, end);
    return middle + std::copysign(static_cast<float>(steps) * scale, away);
  }
};

/// A tile's share of the cells around it: 1 - distance of its middle to the cell's, in cells.
float tile_share(int tile, int cell) {
  constexpr float tiles = CellAxis::tiles_a_cell;
  const float away = std::abs((static_cast<float>(tile) + 0.5f) / tiles - (static_cast<float>(cell) + 0.5f));
  return std::max(0.0f, 1 - away);
}

/// Adds a row of tiles' counts to a row of cells.
template <class Number>
void gather(const std::vector<Number>& tiles, int cells, int count, std::vector<float>& row) {
  std::fill(row.begin(), row.end(), 0.0f);
  for (int cell = 0; cell < cells; ++cell)
    for (int tile = 0; tile < cells * CellAxis::tiles_a_cell; ++tile) {
      const float part = tile_share(tile, cell);
      if (part <= 0) continue;
      const Number* from = tiles.data() + static_cast<size_t>(tile) * count;
      float* to = row.data() + static_cast<size_t>(cell) * count;
      for (int bin = 0; bin < count; ++bin) to[bin] += part * static_cast<float>(from[bin]);
    }
}

/// Histograms of cells, row by row. Numbers: whole ones where all samples count fully, else floats.
template <class Number>
std::vector<float> cell_counts(const Samples& plane, const CellAxis& x, const CellAxis& y, const Bins& bins,
                               const Plane& weight) {
  const int count = bins.count();
  const Ruler place(bins);
  std::vector<Number> tiles(static_cast<size_t>(x.cells) * CellAxis::tiles_a_cell * count);
  std::vector<float> row(static_cast<size_t>(x.cells) * count), cells(row.size() * y.cells);
  std::vector<std::int32_t> bin(plane.width);
  for (int first = 0; first < y.inside;) {
    const int tile_row = y.tile[first];
    std::fill(tiles.begin(), tiles.end(), Number(0));
    for (; first < y.inside && y.tile[first] == tile_row; ++first) {
      const float* values = plane.data + first * plane.stride;
      for (int i = 0; i < x.inside; ++i) bin[i] = std::min(static_cast<std::int32_t>(place(values[i])), count - 1);
      if constexpr (std::is_integral_v<Number>) {
        for (int i = 0; i < x.inside; ++i) ++tiles[static_cast<size_t>(x.tile[i]) * count + bin[i]];
      } else {
        const float* counts = weight[std::min(first, weight.rows - 1)];
        for (int i = 0; i < x.inside; ++i)
          tiles[static_cast<size_t>(x.tile[i]) * count + bin[i]] += counts[std::min(i, weight.cols - 1)];
      }
    }
    gather(tiles, x.cells, count, row);
    for (int cell = 0; cell < y.cells; ++cell) {
      const float part = tile_share(tile_row, cell);
      if (part <= 0) continue;
      float* to = cells.data() + cell * row.size();
      for (size_t i = 0; i < row.size(); ++i) to[i] += part * row[i];
    }
  }
  return cells;
}

/// Adds to each cell as much as `few` samples of all cells together.
void add_a_few_of_all(std::vector<float>& counts, int count) {
  constexpr double few = 4;
  std::vector<double> whole(count);
  for (size_t i = 0; i < counts.size(); ++i) whole[i % count] += counts[i];
  const double all = std::accumulate(whole.begin(), whole.end(), 0.0);
  for (size_t i = 0; i < counts.size(); ++i)
    counts[i] += static_cast<float>(few * (all > 0 ? whole[i % count] / all : 1.0 / count));
}

/// Shares `from` of one cell, but `to` at a border where they differ by one sample between borders where they don't: there
/// rounding may have moved a sample over the border.
void settle(const float* from, const float* to, float sample, std::vector<float>& shares) {
  const float rounding = 0.1f * sample + 1e-6f;
  const int last = static_cast<int>(shares.size()) - 1;
  const auto apart = [&](int i) { return std::abs(from[i] - to[i]); };
  std::copy_n(from, last + 1, shares.begin());
  for (int i = 1; i < last; ++i)
    if (from[i] != to[i] && apart(i) <= sample + rounding && apart(i - 1) <= rounding && apart(i + 1) <= rounding) shares[i] = to[i];
}

/// Over bins in which nothing was counted the curve is straight.
void bridge(const std::vector<float>& border, const float* shares, float* curve) {
  const int count = static_cast<int>(border.size()) - 1;
  for (int first = 0, last; first < count; first = last) {
    for (last = first + 1; last < count && shares[last + 1] <= shares[first];) ++last;
    if (shares[last] > shares[first]) continue;
    const float slope = (curve[last] - curve[first]) / (border[last] - border[first]);
    for (int i = first + 1; i < last; ++i) curve[i] = curve[first] + slope * (border[i] - border[first]);
  }
}

/// Beyond the values that were counted (of samples beyond the side, of other frames) the curve goes on straight, as steep as it
/// is on the whole.
void go_on(const std::vector<float>& border, const float* shares, float* curve) {
  const int count = static_cast<int>(border.size()) - 1;
  int first = 0, last = count;
  while (first < count - 1 && shares[first + 1] <= 0) ++first;
  while (last > first + 1 && shares[last - 1] >= shares[count]) --last;
  const float slope = (curve[last] - curve[first]) / (border[last] - border[first]);
  for (int i = 0; i < first; ++i) curve[i] = curve[first] + slope * (border[i] - border[first]);
  for (int i = last + 1; i <= count; ++i) curve[i] = curve[last] + slope * (border[i] - border[last]);
}

}  // namespace

Bins Bins::of(float centre, float largest, bool even) {
  constexpr float smallest = 1e-6f;  // what is smaller is rounding
  const float unit = std::exp2(std::floor(std::log2(std::max(largest, smallest))));
  return even ? Bins{centre, unit / 4, 5, 5} : Bins{centre, unit / 256, 3, 12};
}

float Bins::value(float position) const {
  const float away = position - static_cast<float>(count() / 2);
  const auto steps = static_cast<std::int32_t>(std::abs(away) * static_cast<float>(1 << (mantissa - fine)));
  return centre + std::copysign(std::bit_cast<float>(std::bit_cast<std::int32_t>(floor) + steps) - floor, away);
}

CellAxis::CellAxis(int side, int cell_count, int samples, double step) : cells(cell_count) {
  inside = std::min(samples, static_cast<int>(std::ceil(side / step)));
  for (int i = 0; i < samples; ++i) {
    const double at = i < inside ? std::min(i * step + 0.5, side - 0.5) : i * step < (side + samples * step) / 2 ? side : 0;
    if (i < inside) tile.push_back(std::min(static_cast<int>(at * cells * tiles_a_cell / side), cells * tiles_a_cell - 1));
    const double among = std::clamp(at * cells / side - 0.5, 0.0, cells - 1.0);
    cell.push_back(std::clamp(static_cast<int>(among), 0, std::max(0, cells - 2)));
    share.push_back(static_cast<float>(among - cell.back()));
  }
}

CellShares cell_shares(const Samples& plane, const CellAxis& x, const CellAxis& y, const Bins& bins, const Plane& weight) {
  std::vector<float> counts = weight.empty() ? cell_counts<std::uint32_t>(plane, x, y, bins, weight)
                                             : cell_counts<float>(plane, x, y, bins, weight);
  const int count = bins.count();
  if (!weight.empty()) add_a_few_of_all(counts, count);
  CellShares shares;
  shares.below.reserve(counts.size() + counts.size() / count);
  for (size_t cell = 0; cell < counts.size(); cell += count) {
    double all = 0, below = 0;
    for (int bin = 0; bin < count; ++bin) all += counts[cell + bin];
    shares.samples.push_back(static_cast<float>(all));
    shares.below.push_back(0);
    for (int bin = 0; bin < count; ++bin) {
      below += counts[cell + bin];
      shares.below.push_back(static_cast<float>(below / all));
    }
  }
  return shares;
}

CellCurves cell_curves(const CellShares& from, const CellShares& to, const Bins& bins) {
  const int count = bins.count();
  std::vector<float> border(count + 1);
  for (int i = 0; i <= count; ++i) border[i] = bins.value(static_cast<float>(i));
  CellCurves curves(from.below.size());
  std::vector<float> settled(count + 1);
  for (size_t cell = 0; cell < from.below.size(); cell += count + 1) {
    const float* below = to.below.data() + cell;
    settle(from.below.data() + cell, below, 1 / from.samples[cell / (count + 1)], settled);
    const float* wanted = settled.data();
    const auto value_in = [&](int bin, float share) {
      const float width = below[bin + 1] - below[bin];
      const float part = width > 0 ? std::clamp((share - below[bin]) / width, 0.0f, 1.0f) : 0.0f;
      return border[bin] + part * (border[bin + 1] - border[bin]);
    };
    int lowest = 0;
    while (lowest < count - 1 && below[lowest + 1] <= 0) ++lowest;
    for (int i = 0; i <= count; ++i) {
      while (lowest < count - 1 && below[lowest + 1] < wanted[i]) ++lowest;
      // Where `to` has empty bins a whole range of values has this share. What lies left of the border needs its lower end,
      // what lies right of it the upper.
      const bool left = i > 0 && wanted[i] > wanted[i - 1], right = i < count && wanted[i + 1] > wanted[i];
      float value = value_in(lowest, wanted[i]);
      if (right) {
        int highest = lowest;
        while (highest < count - 1 && below[highest + 1] <= wanted[i]) ++highest;
        const float upper = value_in(highest, wanted[i]);
        value = left ? 0.5f * (value + upper) : upper;
      }
      curves[cell + i] = value;
    }
    bridge(border, wanted, curves.data() + cell);
    go_on(border, wanted, curves.data() + cell);
  }
  return curves;
}

void apply(const CellCurves& curves, const CellAxis& x, const CellAxis& y, const Bins& bins, const Samples& plane) {
  const int count = bins.count(), numbers = count + 1;
  const Ruler place(bins);
  const size_t row_size = static_cast<size_t>(x.cells) * numbers;
  std::vector<float> row(row_size), places(plane.width);
  const int next = x.cells > 1 ? numbers : 0;
  for (int j = 0; j < plane.height; ++j) {
    const float* above = curves.data() + y.cell[j] * row_size;
    const float* below = y.cells > 1 ? above + row_size : above;
    const float lower = y.share[j];
    for (size_t i = 0; i < row_size; ++i) row[i] = above[i] + lower * (below[i] - above[i]);
    float* values = plane.data + j * plane.stride;
    for (int i = 0; i < plane.width; ++i) places[i] = place(values[i]);
    for (int i = 0; i < plane.width; ++i) {
      const int bin = std::min(static_cast<int>(places[i]), count - 1);
      const float part = places[i] - static_cast<float>(bin);
      const float* left = row.data() + x.cell[i] * numbers + bin;
      const float* right = left + next;
      const float a = left[0] + part * (left[1] - left[0]), b = right[0] + part * (right[1] - right[0]);
      values[i] = a + x.share[i] * (b - a);
    }
  }
}

}  // namespace stillwater
