#include "motion/ripmap.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cpu.h"
#include "motion/ripple_avx2.h"
#include "motion/ripple_kernel.h"

namespace stillwater {
namespace {

// A block's samples: 63 of the widest steps, the spline's reach and the smoothing's.
constexpr double widest_step = 3.6;
constexpr int longest_run = 248;
constexpr int most_taps = 12;
constexpr double spline_variance = 1.0 / 3;
constexpr double widest = 7;  // square of the stretch at which the next level takes over: 3 + 4 * 1

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

int wrapped(double place, int period) { return std::min(static_cast<int>(remainder_of(place, period)), period - 1); }

void halve_columns(const std::vector<float>& from, int height, int stride, std::vector<float>& to) {
  for (int y = 0; y < height / 2; ++y) {
    const auto row = [&](int dy) { return from.data() + static_cast<size_t>((2 * y + dy + height) % height) * stride; };
    const float *a = row(-2), *b = row(-1), *c = row(0), *d = row(1), *e = row(2);
    float* out = to.data() + static_cast<size_t>(y) * stride;
    for (int x = 0; x < stride; ++x) out[x] = (a[x] + e[x] + 4 * (b[x] + d[x]) + 6 * c[x]) * (1.0f / 16);
  }
}

// `from` goes on behind its width.
void halve_row(const float* from, int width, float* to) {
  const auto halved = [](float a, float b, float c, float d, float e) {
    return (a + e + 4 * (b + d) + 6 * c) * (1.0f / 16);
  };
  to[0] = halved(from[width - 2], from[width - 1], from[0], from[1], from[2]);
  for (int x = 1; x < width / 2; ++x) {
    const float* at = from + 2 * x;
    to[x] = halved(at[-2], at[-1], at[0], at[1], at[2]);
  }
}

void continue_row(float* row, int width, int stride) {
  for (int x = width; x < stride; x += width) std::copy_n(row, std::min(width, stride - x), row + x);
}

}  // namespace

Ripmap::Ripmap(const InverseFft2& spline) : size_(spline.size()), top_(0) {
  while (size_ >> (top_ + 1) >= 4) ++top_;
  const auto new_level = [&](int x, int y) -> Level& {
    const int width = size_ >> x, height = size_ >> y, stride = width + longest_run + 8;
    return levels_.emplace_back(Level{width, height, stride, std::vector<float>(static_cast<size_t>(height) * stride)});
  };
  levels_.reserve((top_ + 1) * (top_ + 2) / 2);
  Level& first = new_level(0, 0);
  for (int y = 0; y < size_; ++y) {
    float* row = first.samples.data() + static_cast<size_t>(y) * first.stride;
    std::copy_n(spline.tile_row(y), size_, row);
    for (int x = 0; x < size_; ++x) bound_ = std::max(bound_, std::abs(row[x]));
    continue_row(row, size_, first.stride);
  }
  for (int y = 1; y <= top_; ++y) {
    const Level& above = level(0, y - 1);
    halve_columns(above.samples, above.height, above.stride, new_level(0, y).samples);
    for (int x = 1; x <= y; ++x) {
      const Level& wide = level(x - 1, y);
      Level& narrow = new_level(x, y);
      for (int r = 0; r < narrow.height; ++r) {
        float* row = narrow.samples.data() + static_cast<size_t>(r) * narrow.stride;
        halve_row(wide.samples.data() + static_cast<size_t>(r) * wide.stride, wide.width, row);
        continue_row(row, narrow.width, narrow.stride);
      }
    }
  }
}

void Ripmap::filtered(const FootprintRow& row, float* values) const {
  // Along a block the shear changes: two shears blended, where the difference can be seen.
  const double shear_last = row.shear_first + row.shear_step * block;
  filtered_with_shear(row, row.shear_first, values);
  if (std::abs(shear_last - row.shear_first) * row.along < 0.02) return;
  std::array<float, block> other;
  filtered_with_shear(row, shear_last, other.data());
  for (int i = 0; i < block; ++i) {
    const float share = static_cast<float>(i) / block;
    values[i] += share * (other[i] - values[i]);
  }
}

void Ripmap::filtered_with_shear(const FootprintRow& row, double shear, float* values) const {
  const double along = row.along * row.along, across = row.across * row.across;
  const Choice y = choose(spline_variance + along, top_);
  Choice x = choose(spline_variance + across, y.level);
  const Level& level = this->level(x.level, y.level);
  const double scale_x = std::ldexp(1, -x.level), scale_y = std::ldexp(1, -y.level);
  const double step = row.step * scale_x;
  if (step > widest_step) {  // the whole tile within a pixel
    std::fill_n(values, block, 0.0f);
    return;
  }
  const double start = remainder_of(row.x, size_) * scale_x, centre = remainder_of(row.y, size_) * scale_y;

  // Each smoothing pass below adds up to 1/2 to the variance of the spline.
  const double missing = (x.stretch_square - 1) * spline_variance;
  const int passes = static_cast<int>(std::ceil(missing * 2));
  const double first = std::floor(start) - 1 - passes;
  const int run = std::min(static_cast<int>(start - first + step * (block - 1)) + 3 + passes, longest_run);

  // The long axis leans; what is interpolation (1/3 of a sample squared) stays upright.
  const double lean = shear * along / (along + spline_variance) * scale_x / scale_y;
  const double stretch = std::sqrt(y.stretch_square);
  const int lowest = static_cast<int>(std::ceil(centre - 2 * stretch));
  std::array<const float*, most_taps> rows;
  std::array<float, most_taps> weights, near, far;
  int taps = 0;
  float total = 0;
  for (int j = lowest; j < centre + 2 * stretch && taps < most_taps; ++j, ++taps) {
    const double place = first + lean * (j - centre);
    const double whole = std::floor(place);
    rows[taps] = level.samples.data() + static_cast<size_t>(wrapped(j, level.height)) * level.stride +
                 wrapped(whole, level.width);
    weights[taps] = cubic((j - centre) / stretch);
    far[taps] = static_cast<float>(place - whole);
    total += weights[taps];
  }
  for (int t = 0; t < taps; ++t) {
    const float weight = weights[t] / total;
    far[t] *= weight;
    near[t] = weight - far[t];
  }

  std::array<float, longest_run> line;
  (has_avx2() ? weighted_rows_avx2 : weighted_rows)(rows.data(), near.data(), far.data(), taps, run, line.data());
  for (int p = 0; p < passes; ++p) {
    const float side = static_cast<float>(missing / passes / 2);
    float before = line[0];
    for (int i = 1; i + 1 < run; ++i) {
      const float here = line[i];
      line[i] = here + side * (before + line[i + 1] - 2 * here);
      before = here;
    }
  }
  (has_avx2() ? spline_at_avx2 : spline_at)(line.data(), static_cast<float>(start - first), static_cast<float>(step),
                                            block, values);
}

}  // namespace stillwater
