#include "layers/foreground.h"

#include <algorithm>
#include <array>
#include <cmath>
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

Colours mean_where(const Level& level, bool front) {
  Colours mean;
  for (int c = 0; c < colours; ++c) {
    double sum = 0, weight = 0;
    for (int y = 0; y < level.alpha.rows; ++y)
      for (int x = 0; x < level.alpha.cols; ++x)
        if (front ? level.alpha(y, x) > 0.9f : level.alpha(y, x) < 0.1f) sum += level.picture[c](y, x), ++weight;
    mean[c] = Plane(1, 1, static_cast<float>(weight > 0 ? sum / weight : 0));
  }
  return mean;
}

// Solves eq. 4 at each pixel of a row, its neighbours being what they are.
class RowSolver {
 public:
  RowSolver(const ForegroundOptions& options, float highest, int width)
      : flat_(static_cast<float>(options.regularization)), steep_(static_cast<float>(options.gradient_weight)),
        highest_(highest) {
    for (auto* buffer : {&up_, &down_, &left_, &right_, &same_front_, &same_back_, &cross_, &new_front_, &new_back_})
      buffer->resize(static_cast<size_t>(width));
  }

  void solve(Level& level, int y) {
    const int width = level.alpha.cols, above = std::max(0, y - 1), below = std::min(level.alpha.rows - 1, y + 1);
    find_weights(level.alpha, y, above, below, width);
    for (int c = 0; c < colours; ++c) {
      const Plane& front = level.front[c];
      const Plane& back = level.back[c];
      solve_colour({front[above], front[y], front[below]}, {back[above], back[y], back[below]}, level.picture[c][y],
                   level.alpha[y], width);
      std::copy_n(new_front_.data(), width, level.front[c][y]);
      std::copy_n(new_back_.data(), width, level.back[c][y]);
    }
  }

 private:
  using Rows = std::array<const float*, 3>;  // above, same, below

  void find_weights(const Plane& alpha, int y, int above, int below, int width) {
    const float *same = alpha[y], *over = alpha[above], *under = alpha[below];
    for (int x = 0; x < width; ++x) {
      const float a = same[x], before = same[std::max(0, x - 1)], after = same[std::min(width - 1, x + 1)];
      up_[x] = flat_ + steep_ * std::abs(a - over[x]);
      down_[x] = flat_ + steep_ * std::abs(a - under[x]);
      left_[x] = flat_ + steep_ * std::abs(a - before);
      right_[x] = flat_ + steep_ * std::abs(a - after);
      const float sum = (up_[x] + down_[x]) + (left_[x] + right_[x]), rest = 1 - a;
      const float front = a * a + sum, back = rest * rest + sum, both = a * rest;
      const float scale = 1 / (front * back - both * both);
      same_front_[x] = back * scale;
      same_back_[x] = front * scale;
      cross_[x] = both * scale;
    }
  }

  void solve_colour(const Rows& front, const Rows& back, const float* picture, const float* alpha, int width) {
    const auto solve_at = [&](int x, int before, int after) {
      const float f = alpha[x] * picture[x] + ((up_[x] * front[0][x] + down_[x] * front[2][x]) +
                                               (left_[x] * front[1][before] + right_[x] * front[1][after]));
      const float b = (1 - alpha[x]) * picture[x] + ((up_[x] * back[0][x] + down_[x] * back[2][x]) +
                                                     (left_[x] * back[1][before] + right_[x] * back[1][after]));
      new_front_[x] = std::min(highest_, std::max(0.0f, same_front_[x] * f - cross_[x] * b));
      new_back_[x] = std::min(highest_, std::max(0.0f, same_back_[x] * b - cross_[x] * f));
    };
    solve_at(0, 0, std::min(1, width - 1));
    for (int x = 1; x < width - 1; ++x) solve_at(x, x - 1, x + 1);
    if (width > 1) solve_at(width - 1, width - 2, width - 1);
  }

  float flat_, steep_, highest_;
  std::vector<float> up_, down_, left_, right_, same_front_, same_back_, cross_, new_front_, new_back_;
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
  double top = 1;
  for (const Plane& plane : whole.picture) {
    double highest;
    cv::minMaxLoc(plane, nullptr, &highest);
    top = std::max(top, highest);
  }
  Level level{{}, {}, mean_where(whole, true), mean_where(whole, false)};
  const int levels = static_cast<int>(std::ceil(std::log2(std::max({2, picture.cols, picture.rows}))));
  for (int i = 0; i <= levels; ++i) {
    const double share = static_cast<double>(i) / levels;
    const cv::Size size(static_cast<int>(std::lround(std::pow(picture.cols, share))),
                        static_cast<int>(std::lround(std::pow(picture.rows, share))));
    level = {resized(whole.picture, size), resized(whole.alpha, size), resized(level.front, size), resized(level.back, size)};
    const bool small = size.width <= options.small_size && size.height <= options.small_size;
    const int iterations = small ? options.small_iterations : options.big_iterations;
    for (int k = 0; k < iterations; ++k) improve(level, options, static_cast<float>(top));
    progress.at(std::pow(4, i - levels));
  }
  return {merged(level.front), merged(level.back)};
}

}  // namespace stillwater
