#include "motion/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {
namespace {

/// The horizon's direction, with the water at its right hand (y runs down).
Point rightwards(const Segment& horizon) {
  double x = horizon.to.x - horizon.from.x, y = horizon.to.y - horizon.from.y;
  const double length = std::hypot(x, y);
  x /= length, y /= length;
  constexpr double upright = 1e-12;
  const bool turn = std::abs(x) > upright ? x < 0 : y > 0;
  return turn ? Point{-x, -y} : Point{x, y};
}

const Segment& checked_horizon(const View& view) {
  if (!view.horizon) throw BadInput("view.horizon: none is not a line, which water needs");
  check::segment("view.horizon", *view.horizon);
  return *view.horizon;
}

}  // namespace

bool View::any_water(cv::Rect box) const {
  const Segment& line = checked_horizon(*this);
  const Point along = rightwards(line);
  const auto below = [&](double x, double y) {
    return along.x * (y - line.from.y) - along.y * (x - line.from.x) > 0;
  };
  const double left = box.x, right = box.x + box.width, top = box.y, bottom = box.y + box.height;
  return below(left, top) || below(right, top) || below(left, bottom) || below(right, bottom);
}

WaterPlane::WaterPlane(const View& view, cv::Size picture) {
  const Segment& line = checked_horizon(view);
  check::in_range("view.fov", view.fov, 5, 150, "degrees");
  check::positive("view.height", view.height, "m");
  check::size("size", picture.width, picture.height);
  centre_ = {picture.width / 2.0, picture.height / 2.0};
  along_ = rightwards(line);
  focal_ = picture.width / 2.0 / std::tan(view.fov * std::numbers::pi / 360);
  height_ = view.height;
  horizon_ = level(line.from).y;
  cosine_ = focal_ / std::hypot(focal_, horizon_);
  up_z_ = cosine_ * horizon_ / focal_;
}

Point WaterPlane::level(Point p) const {
  const double x = p.x - centre_.x, y = p.y - centre_.y;
  return {x * along_.x + y * along_.y, y * along_.x - x * along_.y};
}

Point WaterPlane::picture(Point p) const {
  return {centre_.x + p.x * along_.x - p.y * along_.y, centre_.y + p.x * along_.y + p.y * along_.x};
}

Point WaterPlane::ground(Point p) const {
  const Point q = level(p);
  const double s = slant(q.y);
  if (s <= 0) throw BadInput("point: a place on or above the horizon is not on the water");
  const double lambda = height_ / s;
  return {lambda * q.x / focal_, lambda * (cosine_ + up_z_ * q.y / focal_)};
}

Point WaterPlane::seen(Point ground, double rise) const {
  // Camera coordinates of ground.x e1 + ground.y e2 + (rise - height) n.
  const double up = rise - height_;
  const double y = ground.y * up_z_ - up * cosine_;
  const double z = ground.y * cosine_ + up * up_z_;
  if (z <= 0) throw BadInput("ground: a place behind the camera is not seen");
  return picture({focal_ * ground.x / z, focal_ * y / z});
}

}  // namespace stillwater
