#include "motion/bob.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {
namespace {

constexpr int samples = 64;

double length_of(const std::vector<Point>& line) {
  double length = 0;
  for (size_t i = 1; i < line.size(); ++i) length += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
  return length;
}

/// The middles of pieces of equal length, so that the regression weighs water, not clicks.
std::vector<Point> resampled(const std::vector<Point>& line) {
  const double step = length_of(line) / samples;
  std::vector<Point> points;
  double gone = 0;
  for (size_t i = 1; i < line.size(); ++i) {
    const Point a = line[i - 1], b = line[i];
    const double piece = std::hypot(b.x - a.x, b.y - a.y);
    for (double place; points.size() < samples && (place = (points.size() + 0.5) * step) <= gone + piece;) {
      const double share = (place - gone) / piece;
      points.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
    }
    gone += piece;
  }
  points.resize(samples, line.back());
  return points;
}

Point mean(const std::vector<Point>& points) {
  Point sum;
  for (const Point& p : points) sum.x += p.x, sum.y += p.y;
  return {sum.x / static_cast<double>(points.size()), sum.y / static_cast<double>(points.size())};
}

/// The waterline at rest: middle, and the unit vector along the line of least squared distances.
struct Axis {
  Point middle, along;

  double position(Point p) const { return (p.x - middle.x) * along.x + (p.y - middle.y) * along.y; }
  double across(Point p) const { return (p.y - middle.y) * along.x - (p.x - middle.x) * along.y; }
  Point at(double position) const { return {middle.x + position * along.x, middle.y + position * along.y}; }
};

Axis fitted(const std::vector<Point>& points) {
  const Point middle = mean(points);
  double xx = 0, xy = 0, yy = 0;
  for (const Point& p : points) {
    const double x = p.x - middle.x, y = p.y - middle.y;
    xx += x * x, xy += x * y, yy += y * y;
  }
  const double angle = std::atan2(2 * xy, xx - yy) / 2;
  return {middle, {std::cos(angle), std::sin(angle)}};
}

const Bob& checked(const Bob& bob) {
  if (bob.waterline.size() < 2)
    throw BadInput("waterline: " + std::to_string(bob.waterline.size()) + " point is not two points or more");
  for (const Point& p : bob.waterline) check::finite("waterline", p.x), check::finite("waterline", p.y);
  if (length_of(bob.waterline) <= 1e-6) throw BadInput("waterline: one place is not a line with two different ends");
  check::in_range("amount", bob.amount, 0, 1000);
  return bob;
}

/// The slope of `across` over `position` among displaced points.
double slope(const Axis& axis, const std::vector<Point>& points) {
  const Point middle = mean(points);
  double covariance = 0, variance = 0;
  for (const Point& p : points) {
    const double u = axis.position(p) - axis.position(middle);
    covariance += u * (axis.across(p) - axis.across(middle));
    variance += u * u;
  }
  return variance > 0 ? covariance / variance : 0;
}

}  // namespace

std::vector<Point> waterline_samples(const Bob& bob) { return resampled(checked(bob).waterline); }

Segment fitted_waterline(const Bob& bob) {
  const Axis axis = fitted(waterline_samples(bob));
  return {axis.at(axis.position(bob.waterline.front())), axis.at(axis.position(bob.waterline.back()))};
}

std::shared_ptr<const RigidMotion> fitted_motion(const Bob& bob, const std::vector<Point>& moved, cv::Size picture) {
  const std::vector<Point> rest = waterline_samples(bob);
  if (moved.size() != rest.size())
    throw BadInput("moved: " + std::to_string(moved.size()) + " points is not " + std::to_string(rest.size()));
  const Axis axis = fitted(rest);
  const Point from = axis.middle, to = mean(moved);
  const double roll = std::atan(slope(axis, moved)) - std::atan(slope(axis, rest));
  return std::make_shared<RigidMotion>(from, bob.amount * roll,
                                       Point{bob.amount * (to.x - from.x), bob.amount * (to.y - from.y)}, picture);
}

std::shared_ptr<const RigidMotion> bob(const Bob& bob, const Displacement& water, cv::Size picture) {
  std::vector<Point> points = waterline_samples(bob);
  std::vector<float> x, y;
  for (const Point& p : points) x.push_back(static_cast<float>(p.x)), y.push_back(static_cast<float>(p.y));
  std::vector<float> to_x = x, to_y = y;
  water.map(to_x.data(), to_y.data(), samples);
  // What the water adds, so that the coordinates' rounding doesn't move a boat on a flat sea.
  for (int i = 0; i < samples; ++i) points[i].x += to_x[i] - x[i], points[i].y += to_y[i] - y[i];
  return fitted_motion(bob, points, picture);
}

}  // namespace stillwater
