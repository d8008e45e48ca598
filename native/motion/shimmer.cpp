#include "motion/shimmer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cpu.h"
#include "core/random.h"
#include "motion/shimmer_avx2.h"
#include "motion/shimmer_kernel.h"

namespace stillwater {
namespace {

constexpr int side = shimmer_side;
constexpr double slowest = 2, fastest = 5;  // Hz
constexpr double half_wind = 2.5;           // m/s

struct Swing {
  float x, y;
};

// A value and its slopes along x and y, px / px.
struct SwingSlopes {
  Swing swing, along_x, along_y;
};

struct Weights {
  float w[3], slope[3];
};

Weights weights(float f) {
  Weights weights{{}, {f - 0.5f, -2 * f, f + 0.5f}};
  shimmer_weights(f, weights.w);
  return weights;
}

// As ShimmerKernel has them.
std::vector<float> continued(const std::vector<float>& x, const std::vector<float>& y) {
  std::vector<float> nodes;
  nodes.reserve(2 * (side + 2) * shimmer_stride);
  for (int row = 0; row < side + 2; ++row)
    for (int column = 0; column < shimmer_stride; ++column) {
      const int at = (row & (side - 1)) * side + (column & (side - 1));
      nodes.push_back(x[at]), nodes.push_back(y[at]);
    }
  return nodes;
}

class LeavesAtMoment : public Displacement {
 public:
  LeavesAtMoment(const Segment& armature, float cell, float longest, std::vector<float> nodes)
      : root_x_(static_cast<float>(armature.from.x)),
        root_y_(static_cast<float>(armature.from.y)),
        per_cell_(1 / cell),
        per_length_(static_cast<float>(
            1 / std::hypot(armature.to.x - armature.from.x, armature.to.y - armature.from.y))),
        longest_(longest),
        nodes_(std::move(nodes)) {}

  bool at_rest() const override { return longest_ == 0; }
  float reach() const override { return longest_; }

  void unmap(float* x, float* y, int count) const override {
    static const auto unmap_run = has_avx2() ? shimmer_unmap_avx2 : shimmer_unmap_run;
    const ShimmerKernel kernel{root_x_, root_y_, per_cell_, per_length_, nodes_.data()};
    for (int i = 0; i < count; i += shimmer_run) unmap_run(&kernel, x + i, y + i, std::min(shimmer_run, count - i));
  }

  // Solves q + swing(q) = p.
  void map(float* x, float* y, int count) const override {
    constexpr int rounds = 3;
    for (int i = 0; i < count; ++i) {
      const Swing first = at(x[i], y[i]).swing;
      float qx = x[i] - first.x, qy = y[i] - first.y;
      for (int round = 0; round < rounds; ++round) {
        const SwingSlopes here = at(qx, qy);
        const float error_x = qx + here.swing.x - x[i], error_y = qy + here.swing.y - y[i];
        const float xx = 1 + here.along_x.x, xy = here.along_y.x, yx = here.along_x.y, yy = 1 + here.along_y.y;
        const float determinant = xx * yy - xy * yx;
        qx -= (yy * error_x - xy * error_y) / determinant;
        qy -= (xx * error_y - yx * error_x) / determinant;
      }
      x[i] = qx;
      y[i] = qy;
    }
  }

 private:
  SwingSlopes at(float x, float y) const {
    const float dx = x - root_x_, dy = y - root_y_;
    const float cell_x = std::floor(dx * per_cell_ + 0.5f), cell_y = std::floor(dy * per_cell_ + 0.5f);
    const Weights wx = weights(dx * per_cell_ - cell_x), wy = weights(dy * per_cell_ - cell_y);
    const int column = static_cast<int>(cell_x), row = static_cast<int>(cell_y);
    Swing sum{0, 0}, slope_x{0, 0}, slope_y{0, 0};
    for (int j = 0; j < 3; ++j) {
      const int line = ((row + j - 1) & (side - 1)) * shimmer_stride;
      Swing value{0, 0}, slope{0, 0};
      for (int i = 0; i < 3; ++i) {
        const int at = line + ((column + i - 1) & (side - 1));
        const Swing node{nodes_[2 * at], nodes_[2 * at + 1]};
        value.x += wx.w[i] * node.x;
        value.y += wx.w[i] * node.y;
        slope.x += wx.slope[i] * node.x;
        slope.y += wx.slope[i] * node.y;
      }
      sum.x += wy.w[j] * value.x;
      sum.y += wy.w[j] * value.y;
      slope_x.x += wy.w[j] * slope.x;
      slope_x.y += wy.w[j] * slope.y;
      slope_y.x += wy.slope[j] * value.x;
      slope_y.y += wy.slope[j] * value.y;
    }
    const float u = std::min(std::sqrt(dx * dx + dy * dy) * per_length_, 1.0f);
    const float growth = u * u * (3 - 2 * u);
    const float steeper = 6 * (1 - u) * per_length_ * per_length_;  // slope of growth, over dx or dy
    const float cells = growth * per_cell_;
    return {{growth * sum.x, growth * sum.y},
            {cells * slope_x.x + steeper * dx * sum.x, cells * slope_x.y + steeper * dx * sum.y},
            {cells * slope_y.x + steeper * dy * sum.x, cells * slope_y.y + steeper * dy * sum.y}};
  }

  float root_x_, root_y_, per_cell_, per_length_, longest_;
  std::vector<float> nodes_;  // as ShimmerKernel has them
};

}  // namespace

Shimmer::Shimmer(const Segment& armature, std::uint64_t seed) : armature_(armature) {
  for (int i = 0; i < side * side; ++i) {
    frequency_.push_back(static_cast<float>(slowest + (fastest - slowest) * random_uniform(seed, {i, 0, 3})));
    phase_x_.push_back(static_cast<float>(random_uniform(seed, {i, 1, 3})));
    phase_y_.push_back(static_cast<float>(random_uniform(seed, {i, 2, 3})));
  }
}

std::unique_ptr<const Displacement> Shimmer::at(const Moment& moment, double shimmer, double local_speed) const {
  const double length = std::hypot(armature_.to.x - armature_.from.x, armature_.to.y - armature_.from.y);
  const double cell = std::max(cell_share * length, 1.0);
  const double longest = largest_swing * cell * shimmer * local_speed / (local_speed + half_wind);
  const double loop = moment.loop_frames / moment.fps;
  const float size = static_cast<float>(longest / std::numbers::sqrt2);
  static const auto swing = has_avx2() ? shimmer_swing_avx2 : shimmer_swing;
  const double time = moment.loop_frames == 0 ? moment.seconds() : frames_into_loop(moment) / moment.loop_frames;
  const auto swung = [&](const std::vector<float>& phase) {
    std::vector<float> nodes(phase.size());
    swing(frequency_.data(), loop, time, phase.data(), size, static_cast<int>(phase.size()), nodes.data());
    return nodes;
  };
  return std::make_unique<LeavesAtMoment>(armature_, static_cast<float>(cell), static_cast<float>(longest),
                                          continued(swung(phase_x_), swung(phase_y_)));
}

}  // namespace stillwater
