#include "motion/rigid.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace stillwater {

Translation::Translation(Point offset) : x_(static_cast<float>(offset.x)), y_(static_cast<float>(offset.y)) {
  check::finite("offset", offset.x);
  check::finite("offset", offset.y);
}

bool Translation::at_rest() const { return x_ == 0 && y_ == 0; }

float Translation::reach() const { return std::hypot(x_, y_); }

void Translation::map(float* x, float* y, int count) const {
  for (int i = 0; i < count; ++i) {
    x[i] += x_;
    y[i] += y_;
  }
}

void Translation::unmap(float* x, float* y, int count) const {
  for (int i = 0; i < count; ++i) {
    x[i] -= x_;
    y[i] -= y_;
  }
}

RigidMotion::RigidMotion(Point pivot, double angle, Point shift, cv::Size picture)
    : pivot_(pivot), shift_(shift), sine_(static_cast<float>(std::sin(angle))) {
  for (const double number : {pivot.x, pivot.y, angle, shift.x, shift.y}) check::finite("rigid motion", number);
  check::size("picture", picture.width, picture.height);
  const double half = std::sin(angle / 2);
  versine_ = static_cast<float>(-2 * half * half);
  const double furthest = std::hypot(std::max(std::abs(pivot.x), std::abs(picture.width - pivot.x)),
                                     std::max(std::abs(pivot.y), std::abs(picture.height - pivot.y)));
  const double moved = std::hypot(shift.x, shift.y);
  reach_ = static_cast<float>(moved + 2 * std::abs(half) * (furthest + moved));
}

bool RigidMotion::at_rest() const { return sine_ == 0 && versine_ == 0 && shift_.x == 0 && shift_.y == 0; }

float RigidMotion::reach() const { return reach_; }

void RigidMotion::map(float* x, float* y, int count) const {
  const float pivot_x = static_cast<float>(pivot_.x), pivot_y = static_cast<float>(pivot_.y);
  const float shift_x = static_cast<float>(shift_.x), shift_y = static_cast<float>(shift_.y);
  for (int i = 0; i < count; ++i) {
    const float dx = x[i] - pivot_x, dy = y[i] - pivot_y;
    x[i] += shift_x + (versine_ * dx - sine_ * dy);
    y[i] += shift_y + (sine_ * dx + versine_ * dy);
  }
}

void RigidMotion::unmap(float* x, float* y, int count) const {
  const float pivot_x = static_cast<float>(pivot_.x), pivot_y = static_cast<float>(pivot_.y);
  const float shift_x = static_cast<float>(shift_.x), shift_y = static_cast<float>(shift_.y);
  for (int i = 0; i < count; ++i) {
    const float at_x = x[i] - shift_x, at_y = y[i] - shift_y;
    const float dx = at_x - pivot_x, dy = at_y - pivot_y;
    x[i] = at_x + (versine_ * dx + sine_ * dy);
    y[i] = at_y + (versine_ * dy - sine_ * dx);
  }
}

}  // namespace stillwater
