#include "layers/matting/foreground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int grain = 16;
constexpr int colours = 3;
using Colours = std::array<Plane, colours>;

// One level of the pyramid: what is known of it, and the colours looked for.
struct Level {
  Colours picture;
  Plane alpha;
  Colours front, back;
};

int nearest(int place, int size, int other_size) {
  return static_cast<int>(static_cast<long long>(place) * other_size / size);
}

Plane resized(const Plane& plane, const cv::Size& size) {
  if (plane.size() == size) return plane;
  Plane result(size);
  std::vector<int> columns(static_cast<size_t>(size.width));
  for (int x = 0; x < size.width; ++x) columns[x] = nearest(x, size.width, plane.cols);
  parallel_rows(size.height, grain, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      const float* from = plane[nearest(y, size.height, plane.rows)];
      for (int x = 0; x < size.width; ++x) result(y, x) = from[columns[x]];
    }
  });
  return result;
}

Colours resized(const Colours& planes, const cv::Size& size) {
  return {resized(planes[0], size), resized(planes[1], size), resized(planes[2], size)};
}

Colours split(const Rgba& picture) {
  Colours planes;
  for (Plane& plane : planes) plane.create(picture.size());
  parallel_rows(picture.rows, grain, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < picture.cols; ++x)
        for (int c = 0; c < colours; ++c) planes[c](y, x) = picture(y, x)[c];
  });
  return planes;
}

Rgba merged(const Colours& planes) {
  Rgba picture(planes[0].size());
  parallel_rows(picture.rows, grain, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < picture.cols; ++x) picture(y, x) = {planes[0](y, x), planes[1](y, x), planes[2](y, x), 1};
  });
  return picture;
}

// The mean colour of what is nearly all foreground, or background; of every so many pixels, which is enough to start.
Colours mean_where(const Level& level, bool front) {
  const int step = std::max(1, std::max(level.alpha.rows, level.alpha.cols) / 256);
  std::array<double, colours> sum{};
  double count = 0;
  for (int y = 0; y < level.alpha.rows; y += step)
    for (int x = 0; x < level.alpha.cols; x += step) {
      if (front ? level.alpha(y, x) <= 0.9f : level.alpha(y, x) >= 0.1f) continue;
      for (int c = 0; c < colours; ++c) sum[c] += level.picture[c](y, x);
      ++count;
    }
  Colours mean;
  for (int c = 0; c < colours; ++c) mean[c] = Plane(1, 1, static_cast<float>(count > 0 ? sum[c] / count : 0));
  return mean;
}

// A row of numbers that no other row overlaps.
using Numbers = float* __restrict;
using Given = const float* __restrict;

// Eq. 4 at each pixel of one row: how much its four neighbours count, and the inverse of its 2 x 2 system.
class RowSystem {
 public:
  explicit RowSystem(int width) : stride_(static_cast<size_t>(width)), buffer_(7 * stride_) {}

  void find(const Plane& alpha, int y, float flat, float steep) {
    const int width = alpha.cols;
    Given same = alpha[y], over = alpha[std::max(0, y - 1)], under = alpha[std::min(alpha.rows - 1, y + 1)];
    Numbers up = row(0), down = row(1), left = row(2), right = row(3), front = row(4), back = row(5), cross = row(6);
    left[0] = right[width - 1] = flat;
    for (int x = 1; x < width; ++x) left[x] = flat + steep * std::abs(same[x] - same[x - 1]);
    for (int x = 0; x < width - 1; ++x) right[x] = flat + steep * std::abs(same[x] - same[x + 1]);
    for (int x = 0; x < width; ++x) {
      const float a = same[x], b = 1 - a;
      up[x] = flat + steep * std::abs(a - over[x]);
      down[x] = flat + steep * std::abs(a - under[x]);
      const float sum = (up[x] + down[x]) + (left[x] + right[x]);
      const float first = a * a + sum, last = b * b + sum, both = a * b, scale = 1 / (first * last - both * both);
      front[x] = last * scale;
      back[x] = first * scale;
      cross[x] = both * scale;
    }
  }

  float* row(int i) { return &buffer_[static_cast<size_t>(i) * stride_]; }

 private:
  size_t stride_;
  std::vector<float> buffer_;
};

// Solves one colour of a row, its neighbours being what they are.
class RowSolver {
 public:
  RowSolver(const ForegroundOptions& options, float highest, int width)
      : flat_(static_cast<float>(options.regularization)), steep_(static_cast<float>(options.gradient_weight)),
        highest_(highest), system_(width), sums_(2 * static_cast<size_t>(width)) {}

  void solve(Level& level, int y) {
    system_.find(level.alpha, y, flat_, steep_);
    for (int c = 0; c < colours; ++c) {
      const int width = level.alpha.cols;
      Numbers front = &sums_[0], back = &sums_[static_cast<size_t>(width)];
      sum_neighbours(level.front[c], y, front);
      sum_neighbours(level.back[c], y, back);
      mix(level.alpha[y], level.picture[c][y], front, back, level.front[c][y], level.back[c][y], width);
    }
  }

 private:
  void sum_neighbours(const Plane& plane, int y, Numbers sum) {
    const int width = plane.cols;
    Given over = plane[std::max(0, y - 1)], same = plane[y], under = plane[std::min(plane.rows - 1, y + 1)];
    Given up = system_.row(0), down = system_.row(1), left = system_.row(2), right = system_.row(3);
    for (int x = 1; x < width - 1; ++x)
      sum[x] = (up[x] * over[x] + down[x] * under[x]) + (left[x] * same[x - 1] + right[x] * same[x + 1]);
    for (const int x : {0, width - 1})
      sum[x] = (up[x] * over[x] + down[x] * under[x]) +
               (left[x] * same[std::max(0, x - 1)] + right[x] * same[std::min(width - 1, x + 1)]);
  }

  void mix(Given alpha, Given picture, Given front_sum, Given back_sum, Numbers front, Numbers back, int width) {
    Given own_front = system_.row(4), own_back = system_.row(5), cross = system_.row(6);
    for (int x = 0; x < width; ++x) {
      const float f = alpha[x] * picture[x] + front_sum[x], b = (1 - alpha[x]) * picture[x] + back_sum[x];
      const float new_front = own_front[x] * f - cross[x] * b, new_back = own_back[x] * b - cross[x] * f;
      front[x] = std::min(highest_, std::max(0.0f, new_front));
      back[x] = std::min(highest_, std::max(0.0f, new_back));
    }
  }

  float flat_, steep_, highest_;
  RowSystem system_;
  std::vector<float> sums_;
};

// Even rows, then odd ones: within a row from what the row was before.
void improve(Level& level, const ForegroundOptions& options, float highest) {
  const int rows = level.alpha.rows;
  for (const int parity : {0, 1})
    parallel_rows((rows + 1 - parity) / 2, grain, [&](int first, int last) {
      RowSolver solver(options, highest, level.alpha.cols);
      for (int i = first; i < last; ++i) solver.solve(level, 2 * i + parity);
    });
}

void check_arguments(const Rgba& picture, const Plane& alpha, const ForegroundOptions& options) {
  check::not_empty("picture", picture);
  check::same_size("alpha", alpha, "the picture", picture);
  check::finite_colours("picture", picture);
  check::each_in_range("alpha", alpha, 0, 1);
  check::positive("regularization", options.regularization);
  check::positive("gradient_weight", options.gradient_weight);
  check::in_range("small_iterations", options.small_iterations, 1, 1000);
  check::in_range("big_iterations", options.big_iterations, 1, 1000);
  check::in_range("small_size", options.small_size, 1, largest_side);
}

}  // namespace

ForegroundAndBackground foreground_and_background(const Rgba& picture, const Plane& alpha,
                                                  const ForegroundOptions& options, Progress progress) {
  check_arguments(picture, alpha, options);
  progress.phase("finding the colours", 1);
  Level whole{split(picture), alpha, {}, {}};
  double highest;
  cv::minMaxLoc(cv::Mat(picture).reshape(1), nullptr, &highest);
  Level level{{}, {}, mean_where(whole, true), mean_where(whole, false)};
  const int levels = static_cast<int>(std::ceil(std::log2(std::max({2, picture.cols, picture.rows}))));
  for (int i = 0; i <= levels; ++i) {
    const double share = static_cast<double>(i) / levels;
    const cv::Size size(static_cast<int>(std::lround(std::pow(picture.cols, share))),
                        static_cast<int>(std::lround(std::pow(picture.rows, share))));
    level = {resized(whole.picture, size), resized(whole.alpha, size), resized(level.front, size),
             resized(level.back, size)};
    const bool small = size.width <= options.small_size && size.height <= options.small_size;
    const int iterations = small ? options.small_iterations : options.big_iterations;
    for (int k = 0; k < iterations; ++k) improve(level, options, static_cast<float>(std::max(1.0, highest)));
    progress.at(std::pow(4, i - levels));
  }
  return {merged(level.front), merged(level.back)};
}

}  // namespace stillwater
