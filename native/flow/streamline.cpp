#include "flow/streamline.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {
namespace {

constexpr double longest_turn = 0.1;
// A way is cut into no more pieces than this, whatever the flow does.
constexpr double most_steps = 1 << 20;

double length(const cv::Vec2d& v) { return std::sqrt(v.dot(v)); }

}  // namespace

/// The four pixels around a place, and where it lies between them.
struct SteadyFlow::Cell {
  cv::Vec2d a, b, c, d;  // upper left and right, lower left and right
  double x, y;

  cv::Vec2d value() const {
    const cv::Vec2d upper = a + x * (b - a), lower = c + x * (d - c);
    return upper + y * (lower - upper);
  }

  // How fast the velocity changes along its steepest way, at most; 1 / frame.
  double steepness() const {
    const cv::Vec2d across = (1 - y) * (b - a) + y * (d - c), down = (1 - x) * (c - a) + x * (d - b);
    return std::sqrt(across.dot(across) + down.dot(down));
  }
};

SteadyFlow::SteadyFlow(const Field& velocity) : velocity_(velocity) {
  check::not_empty("velocity", velocity);
  if (!cv::checkRange(velocity)) throw BadInput("velocity: not finite everywhere is not a velocity (px/frame)");
}

SteadyFlow::Cell SteadyFlow::cell(double x, double y) const {
  const double held_x = std::clamp(x, 0.0, velocity_.cols - 1.0), held_y = std::clamp(y, 0.0, velocity_.rows - 1.0);
  const int left = std::min(static_cast<int>(held_x), std::max(0, velocity_.cols - 2));
  const int top = std::min(static_cast<int>(held_y), std::max(0, velocity_.rows - 2));
  const int right = std::min(left + 1, velocity_.cols - 1), bottom = std::min(top + 1, velocity_.rows - 1);
  const cv::Vec2f *upper = velocity_[top], *lower = velocity_[bottom];
  return {upper[left], upper[right], lower[left], lower[right], held_x - left, held_y - top};
}

cv::Vec2d SteadyFlow::at(double x, double y) const { return cell(x, y).value(); }

cv::Vec2d SteadyFlow::carried(cv::Vec2d place, double frames, double longest_step) const {
  const auto velocity = [this](const cv::Vec2d& p) { return at(p[0], p[1]); };
  const double shortest = std::abs(frames) / most_steps;
  for (double left = frames; left != 0;) {
    const Cell here = cell(place[0], place[1]);
    const cv::Vec2d first = here.value();
    const double speed = length(first);
    if (speed == 0) return place;  // a steady flow never leaves such a place
    const double step_frames = std::min({std::abs(left), longest_step / speed, longest_turn / here.steepness()});
    const double step = std::copysign(std::max(step_frames, std::min(shortest, std::abs(left))), left);
    const cv::Vec2d second = velocity(place + (step / 2) * first), third = velocity(place + (step / 2) * second);
    const cv::Vec2d fourth = velocity(place + step * third);
    place += (step / 6) * (first + 2 * second + 2 * third + fourth);
    left -= step;
  }
  return place;
}

}  // namespace stillwater
