#include "layers/sampling.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/cpu.h"
#include "layers/sampling_avx2.h"
#include "layers/sampling_kernel.h"

namespace stillwater {
namespace {

// Places that are passed by together where there is nothing around them.
constexpr int looked_at = 16;

void sample_plain(const float* origin, std::ptrdiff_t stride, const float* x, const float* y,
                  const unsigned char* needed, int count, float* out) {
  SamplingWeights w;
  catmull_rom_weights(x, count, w.column, w.x);
  catmull_rom_weights(y, count, w.row, w.y);
  for (int i = 0; i < count; ++i) {
    if (!needed[i]) continue;
    const float* pixel = origin + (w.row[i] - 1) * stride + std::ptrdiff_t{4} * (w.column[i] - 1);
    ask_for_rows_below(pixel, stride);
    stillwater_v4 sum = {0, 0, 0, 0};
    for (int row = 0; row < 4; ++row, pixel += stride) {
      const auto* neighbour = reinterpret_cast<const stillwater_v4u*>(pixel);
      sum += w.y[row][i] * (w.x[0][i] * neighbour[0] + w.x[1][i] * neighbour[1] + w.x[2][i] * neighbour[2] +
                            w.x[3][i] * neighbour[3]);
    }
    *reinterpret_cast<stillwater_v4u*>(out + 4 * i) = within_coverage(settled(sum));
  }
}

// Into [-1, size]. NaN becomes -1.
void hold(float* at, int count, int size) {
  const float last = static_cast<float>(size);
  for (int i = 0; i < count; ++i) {
    const float low = at[i] > -1.0f ? at[i] : -1.0f;
    at[i] = low < last ? low : last;
  }
}

void fold(float* at, int count, int size, bool low, bool high) {
  const float first = low ? -0.5f : -1e30f, last = high ? static_cast<float>(size) - 0.5f : 1e30f;
  const float twice_last = 2 * static_cast<float>(size) - 1;
  for (int i = 0; i < count; ++i) {
    const float folded = at[i] < first ? -1.0f - at[i] : at[i];
    at[i] = folded > last ? twice_last - folded : folded;
  }
}

void wrap(float* at, int count, int size) {
  const float period = static_cast<float>(size);
  for (int i = 0; i < count; ++i) at[i] -= period * std::floor(at[i] / period);
}

void range_plain(const float* at, int count, float* low, float* high) {
  constexpr int lanes = 4;
  stillwater_v4 smallest, largest, nothing;  // x - x is 0 for numbers only
  for (int k = 0; k < lanes; ++k) {
    const float number = at[std::min(k, count - 1)];
    smallest[k] = largest[k] = number;
    nothing[k] = number - number;
  }
  for (int i = std::min(lanes, count % lanes); i + lanes <= count; i += lanes) {
    const stillwater_v4 here = *reinterpret_cast<const stillwater_v4u*>(at + i);
    smallest = here < smallest ? here : smallest;
    largest = here > largest ? here : largest;
    nothing += here - here;
  }
  const float no_number = nothing[0] + nothing[1] + nothing[2] + nothing[3];
  *low = std::min({smallest[0], smallest[1], smallest[2], smallest[3]}) + no_number;
  *high = std::max({largest[0], largest[1], largest[2], largest[3]}) + no_number;
}

// Smallest and largest of at least one number; no numbers where one of them is none.
struct Range {
  float low, high;

  Range(const float* at, int count) {
    static const auto range = has_avx2() ? stillwater_range_avx2 : range_plain;
    (count < 8 ? range_plain : range)(at, count, &low, &high);
  }

  bool within(int size) const { return low >= 0 && high <= static_cast<float>(size - 1); }
};

// Places brought inside, and where they lie then.
Range bring_inside(float* at, int count, int size, const Beyond& beyond) {
  const Range given(at, count);
  if (given.within(size)) return given;
  if (beyond.wraps) wrap(at, count, size);
  else fold(at, count, size, beyond.mirror_low, beyond.mirror_high);
  hold(at, count, size);
  return Range(at, count);
}

}  // namespace

Source::Source(const Rgba& image, Beyond across, Beyond down)
    : across_(across), down_(down), width_(image.cols), height_(image.rows) {
  if (empty()) return;
  padded_.create(height_ + 2 * frame, width_ + 2 * frame);
  const auto inside = [](int at, int size, const Beyond& beyond) {
    return cv::borderInterpolate(at, size, beyond.wraps ? cv::BORDER_WRAP : cv::BORDER_REFLECT);
  };
  for (int y = -frame; y < height_ + frame; ++y) {
    const cv::Vec4f* row = image[inside(y, height_, down)];
    cv::Vec4f* out = padded_[y + frame] + frame;
    std::copy_n(row, width_, out);
    for (int x = 1; x <= frame; ++x) {
      out[-x] = row[inside(-x, width_, across)];
      out[width_ - 1 + x] = row[inside(width_ - 1 + x, width_, across)];
    }
  }
  map_coverage();
}

void Source::map_coverage() {
  const int columns = (padded_.cols + block - 1) / block, rows = (padded_.rows + block - 1) / block;
  cv::Mat_<unsigned char> covered(rows, columns, static_cast<unsigned char>(0));
  for (int y = 0; y < padded_.rows; ++y)
    for (int x = 0; x < padded_.cols; ++x)
      if (padded_(y, x)[3] != 0) covered(y / block, x / block) = 1;
  cv::integral(covered, covered_blocks_, CV_32S);
}

bool Source::is_clear(const cv::Rect& area) const {
  if (empty()) return true;
  if (across_.wraps || down_.wraps) return false;
  return covered_inside(area) == Covered::nowhere;
}

// For areas that do not reach over a side that wraps.
Source::Covered Source::covered_inside(const cv::Rect& area) const {
  const auto held = [](int at, int size) { return std::clamp(at + frame, 0, size - 1) / block; };
  const int left = held(area.x - 2, padded_.cols), right = held(area.x + area.width + 2, padded_.cols) + 1;
  const int top = held(area.y - 2, padded_.rows), bottom = held(area.y + area.height + 2, padded_.rows) + 1;
  const auto& sum = covered_blocks_;
  const int covered = sum(bottom, right) - sum(top, right) - sum(bottom, left) + sum(top, left);
  if (covered == 0) return Covered::nowhere;
  return covered == (bottom - top) * (right - left) ? Covered::everywhere : Covered::somewhere;
}

const cv::Vec4f* Source::run_at(int x, int y, int count) const {
  if (empty() || covered_inside(cv::Rect(x, y, count, 1)) == Covered::nowhere) return nullptr;
  const cv::Vec4f *pixels = at(x, y), *below = at(x, std::min(y + 2, height_));
  for (int i = 0; i < count; i += 4) __builtin_prefetch(below + i);  // as ask_for_rows_below() does
  return pixels;
}

bool Source::sample(float* x, float* y, const unsigned char* needed, int count, cv::Vec4f* out) const {
  if (empty()) return false;
  const auto covered = [this](const Range& across, const Range& down) {
    return covered_inside({cv::Point(static_cast<int>(across.low) - 1, static_cast<int>(down.low) - 1),
                           cv::Point(static_cast<int>(across.high) + 1, static_cast<int>(down.high) + 1)});
  };
  const Range across = bring_inside(x, count, width_, across_), down = bring_inside(y, count, height_, down_);
  const Covered all = covered(across, down);
  if (all == Covered::nowhere) return false;
  static const auto kernel = has_avx2() ? stillwater_sample_avx2 : sample_plain;
  const float* origin = at(0, 0)->val;
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(padded_.step1());
  const int step = all == Covered::everywhere ? sampling_run : looked_at;
  for (int i = 0; i < count; i += step) {
    const int some = std::min(step, count - i);
    if (all == Covered::somewhere && covered(Range(x + i, some), Range(y + i, some)) == Covered::nowhere)
      std::fill_n(out + i, some, cv::Vec4f());
    else
      kernel(origin, stride, x + i, y + i, needed + i, some, out[i].val);
  }
  return true;
}

}  // namespace stillwater
