#include "example/rigid_deformation.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace stillwater {
namespace {

constexpr int pieces = 24;
constexpr double nearest = 1e-6;  // px^2

cv::Vec2d vec(Point p) { return {p.x, p.y}; }
cv::Vec2d across(const cv::Vec2d& v) { return {-v[1], v[0]}; }

}  // namespace

std::vector<Point> evenly_along(const std::vector<Point>& line, int count) {
  std::vector<double> way{0};
  for (size_t i = 1; i < line.size(); ++i) way.push_back(way.back() + cv::norm(vec(line[i]) - vec(line[i - 1])));
  std::vector<Point> places;
  size_t piece = 1;
  for (int k = 0; k < count; ++k) {
    const double at = count > 1 ? way.back() * k / (count - 1) : way.back() / 2;
    while (piece + 1 < line.size() && way[piece] < at) ++piece;
    if (line.size() == 1) {
      places.push_back(line[0]);
      continue;
    }
    const double length = way[piece] - way[piece - 1], share = length > 0 ? (at - way[piece - 1]) / length : 0;
    const cv::Vec2d place = vec(line[piece - 1]) + std::clamp(share, 0.0, 1.0) * (vec(line[piece]) - vec(line[piece - 1]));
    places.push_back({place[0], place[1]});
  }
  return places;
}

RigidDeformation::RigidDeformation(const std::vector<Point>& from, const std::vector<Point>& to, double scale)
    : scale_(scale) {
  if (from.empty() || to.empty()) throw BadInput("stroke: no points is not at least one");
  const int count = from.size() == 1 || to.size() == 1 ? 1 : pieces + 1;
  from_ = evenly_along(from, count);
  to_ = evenly_along(to, count);
}

Point RigidDeformation::at(Point place) const {
  const cv::Vec2d here = vec(place);
  double all = 0;
  cv::Vec2d from_mean, to_mean;
  std::vector<double> weights(from_.size());
  for (size_t i = 0; i < from_.size(); ++i) {
    const cv::Vec2d apart = vec(from_[i]) - here;
    weights[i] = 1 / std::max(apart.dot(apart), nearest);
    all += weights[i];
    from_mean += weights[i] * vec(from_[i]);
    to_mean += weights[i] * vec(to_[i]);
  }
  from_mean /= all;
  to_mean /= all;
  cv::Vec2d turned;  // the direction in which the place lies, as the lines' pieces around it turn
  const cv::Vec2d away = here - from_mean;
  for (size_t i = 0; i < from_.size(); ++i) {
    const cv::Vec2d from = vec(from_[i]) - from_mean, to = vec(to_[i]) - to_mean;
    turned += weights[i] * (from.dot(away) * to + across(from).dot(away) * across(to));
  }
  const double length = cv::norm(turned);
  const cv::Vec2d direction = length > 0 ? cv::Vec2d(turned / length) : (cv::norm(away) > 0 ? cv::Vec2d(away / cv::norm(away)) : cv::Vec2d());
  const cv::Vec2d at = to_mean + scale_ * cv::norm(away) * direction;
  return {at[0], at[1]};
}

}  // namespace stillwater
