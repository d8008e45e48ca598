#include "motion/ripmap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cpu.h"
#include "core/parallel.h"
#include "motion/ripmap_avx2.h"
#include "motion/ripmap_kernel.h"

namespace stillwater {
namespace {

// A block's samples: 63 of the widest steps, the spline's reach and the smoothing's.
static_assert(Ripmap::block == ripmap_block);
constexpr double widest_step = 3.6;
constexpr int longest_run = 256;  // whole vectors
constexpr double spline_variance = 1.0 / 3;
constexpr double widest = 7;  // square of the stretch at which the next level takes over: 3 + 4 * 1

constexpr int rows_at_once = 64;

/// Samples by which the two shears of a block may differ and not be blended, at the footprint's standard deviation.
constexpr double unseen_lean = 0.05;

/// The level for a wanted variance, and the square of the stretch that is left to its kernel.
struct Choice {
  int level;
  double stretch_square;
};

Choice choose(double variance, int top) {
  int level = 0;
  double left = variance / spline_variance;
  while (left > widest && level < top) left = (left - 3) / 4, ++level;
  return {level, std::min(left, widest)};
}

float cubic(double x) {
  x = std::abs(x);
  if (x >= 2) return 0;
  const double f = 2 - x;
  return static_cast<float>(x < 1 ? (4 - 3 * x * x * f) / 6 : f * f * f / 6);
}

double remainder_of(double place, int period) { return place - std::floor(place / period) * period; }

/// Of a power of two.
int wrapped(int place, int period) { return place & (period - 1); }

float halved(float a, float b, float c, float d, float e) { return (a + e + 4 * (b + d) + 6 * c) * (1.0f / 16); }

// `from` goes on behind its width.
void halve_row(const float* from, int width, float* to) {
  to[0] = halved(from[width - 2], from[width - 1], from[0], from[1], from[2]);
  for (int x = 1; x < width / 2; ++x) {
    const float* at = from + 2 * x;
    to[x] = halved(at[-2], at[-1], at[0], at[1], at[2]);
  }
}

void continue_row(float* row, int width, int stride) {
  for (int x = width; x < stride; x += width) std::copy_n(row, std::min(width, stride - x), row + x);
}

// Of a whole number of fours.
float largest_size(const float* numbers, int count) {
  std::array<float, 4> largest{};
  for (int i = 0; i < count; i += 4)
    for (int k = 0; k < 4; ++k) largest[k] = std::max(largest[k], std::abs(numbers[i + k]));
  return *std::max_element(largest.begin(), largest.end());
}

}  // namespace

Ripmap::Ripmap(const InverseFft2& spline) : size_(spline.size()), top_(0) {
  while (size_ >> (top_ + 1) >= 4) ++top_;
  lay_out_levels();
  copy(spline);
  for (int y = 1; y <= top_; ++y) halve(y);
}

void Ripmap::lay_out_levels() {
  size_t total = 0;
  std::vector<size_t> starts;
  for (int y = 0; y <= top_; ++y)
    for (int x = 0; x <= y; ++x) {
      const int width = size_ >> x, height = size_ >> y, stride = width + longest_run + 8;
      levels_.push_back({width, height, stride, nullptr});
      starts.push_back(total);
      total += static_cast<size_t>(height) * stride;
    }
  samples_ = std::make_unique_for_overwrite<float[]>(total);
  for (size_t i = 0; i < starts.size(); ++i) levels_[i].samples = samples_.get() + starts[i];
}

void Ripmap::copy(const InverseFft2& spline) {
  const Level& first = level(0, 0);
  std::vector<float> bounds(size_);
  parallel_rows(size_, rows_at_once, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      float* row = first.row(y);
      std::copy_n(spline.tile_row(y), size_, row);
      continue_row(row, size_, first.stride);
      bounds[y] = largest_size(row, size_);
    }
  });
  bound_ = *std::max_element(bounds.begin(), bounds.end());
}

/// All levels of this height, from the one twice as high.
void Ripmap::halve(int along_y) {
  const Level &above = level(0, along_y - 1), &wide = level(0, along_y);
  parallel_rows(wide.height, rows_at_once, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const auto from = [&](int dy) { return above.row(wrapped(2 * y + dy, above.height)); };
      const float *a = from(-2), *b = from(-1), *c = from(0), *d = from(1), *e = from(2);
      float* out = wide.row(y);
      for (int x = 0; x < wide.stride; ++x) out[x] = halved(a[x], b[x], c[x], d[x], e[x]);
      for (int x = 1; x <= along_y; ++x) {
        const Level &before = level(x - 1, along_y), &narrow = level(x, along_y);
        halve_row(before.row(y), before.width, narrow.row(y));
        continue_row(narrow.row(y), narrow.width, narrow.stride);
      }
    }
  });
}

Ripmap::Line::Line(const Ripmap& map, const FootprintLine& line) : size_(map.size_) {
  const double along = line.along * line.along, across = line.across * line.across;
  const Choice y = choose(spline_variance + along, map.top_);
  const Choice x = choose(spline_variance + across, y.level);
  scale_x_ = std::ldexp(1, -x.level);
  step_ = line.step * scale_x_;
  if (step_ > widest_step) return;
  level_ = &map.level(x.level, y.level);
  shear_change_ = line.shear_step * block;
  blends_ = std::abs(shear_change_) * line.along >= unseen_lean;

  // Each pass of smoothing adds up to 1/2 to the variance of the spline.
  const double missing = (x.stretch_square - 1) * spline_variance;
  passes_ = static_cast<int>(std::ceil(missing * 2));
  side_ = passes_ > 0 ? static_cast<float>(missing / passes_ / 2) : 0.0f;

  // The long axis leans; what is interpolation (1/3 of a sample squared) stays upright.
  const double scale_y = std::ldexp(1, -y.level);
  lean_ = along / (along + spline_variance) * scale_x_ / scale_y;
  const double centre = remainder_of(line.y, size_) * scale_y, stretch = std::sqrt(y.stretch_square);
  const int lowest = static_cast<int>(std::ceil(centre - 2 * stretch));
  float total = 0;
  for (int j = lowest; j < centre + 2 * stretch && taps_ < most_taps; ++j, ++taps_) {
    rows_[taps_] = level_->row(wrapped(j, level_->height));
    beside_[taps_] = j - centre;
    weights_[taps_] = cubic((j - centre) / stretch);
    total += weights_[taps_];
  }
  for (int t = 0; t < taps_; ++t) weights_[t] /= total;
}

void Ripmap::Line::filtered(double x, double shear, float* values) const {
  if (!level_) {
    std::fill_n(values, block, 0.0f);
    return;
  }
  if (!blends_) {
    filtered_with_shear(x, shear + shear_change_ / 2, values);
    return;
  }
  std::array<float, block> other;
  filtered_with_shear(x, shear, values);
  filtered_with_shear(x, shear + shear_change_, other.data());
  for (int i = 0; i < block; ++i) {
    const float share = static_cast<float>(i) / block;
    values[i] += share * (other[i] - values[i]);
  }
}

void Ripmap::Line::filtered_with_shear(double x, double shear, float* values) const {
  const double start = remainder_of(x, size_) * scale_x_;
  const double first = std::floor(start) - 1 - passes_;
  const int run = static_cast<int>(start - first + step_ * (block - 1)) + 3 + passes_;

  std::array<const float*, most_taps> rows;
  std::array<float, most_taps> near, far;
  for (int t = 0; t < taps_; ++t) {
    const double place = first + shear * lean_ * beside_[t], whole = std::floor(place);
    rows[t] = rows_[t] + wrapped(static_cast<int>(whole), level_->width);
    far[t] = static_cast<float>(place - whole) * weights_[t];
    near[t] = weights_[t] - far[t];
  }
  static const auto weigh = has_avx2() ? weighted_rows_avx2 : weighted_rows;
  static const auto smooth = has_avx2() ? smoothed_line_avx2 : smoothed_line;
  static const auto interpolate = has_avx2() ? spline_at_avx2 : spline_at;
  float lines[2][longest_run];
  float *line = lines[0], *other = lines[1];
  weigh(rows.data(), near.data(), far.data(), taps_, run, line);
  for (int pass = 0; pass < passes_; ++pass) {
    smooth(line, side_, run, other);
    std::swap(line, other);
  }
  interpolate(line, static_cast<float>(start - first), static_cast<float>(step_), values);
}

}  // namespace stillwater
