#include "flow/stroke_track.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/error.h"
#include "layers/matting/segment_distance.h"

namespace stillwater {
namespace {

constexpr double furthest = 1e6;         // px
constexpr double shortest = 1;           // px; what is shorter says no direction
constexpr double shortest_half_chord = 4;  // px

void check_stroke(const FlowStroke& stroke, const std::string& name) {
  if (stroke.points.empty()) throw BadInput(name + ".points: none is not one point or more");
  check::in_range(name + ".width", stroke.width, 0, largest_side, "px");
  check::positive(name + ".width", stroke.width, "px");
  check::in_range(name + ".speed", stroke.speed, 0, 1000, "px/frame");
  check::in_range(name + ".alpha", stroke.alpha, 0, 1);
  for (std::size_t i = 0; i < stroke.points.size(); ++i) {
    const std::string place = name + ".points[" + std::to_string(i) + "]";
    check::in_range(place, stroke.points[i][0], -furthest, furthest, "px");
    check::in_range(place, stroke.points[i][1], -furthest, furthest, "px");
    check::in_range(place + ", pressure", stroke.points[i][2], 0, 1);
  }
}

/// The polyline by its length.
class Line {
 public:
  explicit Line(const std::vector<cv::Vec3f>& points) : points_(points), at_(points.size(), 0.0) {
    for (std::size_t i = 1; i < points.size(); ++i)
      at_[i] = at_[i - 1] + std::hypot(double{points[i][0]} - points[i - 1][0], double{points[i][1]} - points[i - 1][1]);
  }

  double length() const { return at_.back(); }

  /// x, y, pressure at a length, cut to the line's ends.
  cv::Vec3d at(double length) const {
    const auto after = std::upper_bound(at_.begin(), at_.end(), length);
    if (after == at_.begin()) return points_.front();
    if (after == at_.end()) return points_.back();
    const std::size_t i = after - at_.begin();
    const double share = (length - at_[i - 1]) / (at_[i] - at_[i - 1]);
    return cv::Vec3d(points_[i - 1]) * (1 - share) + cv::Vec3d(points_[i]) * share;
  }

  /// Where the line turns back upon itself a chord is short: then it is the way that led there.
  cv::Vec2d tangent(double length, double half_chord) const {
    const cv::Vec3d before = at(length - half_chord), here = at(length), behind = at(length + half_chord);
    cv::Vec2d chord(behind[0] - before[0], behind[1] - before[1]);
    if (cv::norm(chord) < 0.01 * half_chord) chord = {here[0] - before[0], here[1] - before[1]};
    const double size = cv::norm(chord);
    return size > 0 ? chord / size : cv::Vec2d();
  }

 private:
  const std::vector<cv::Vec3f>& points_;
  std::vector<double> at_;
};

}  // namespace

StrokeTrack track_of(const FlowStroke& stroke, const std::string& name) {
  check_stroke(stroke, name);
  const Line line(stroke.points);
  const bool directed = stroke.kind != FlowStrokeKind::speed;
  if (directed && line.length() < shortest)
    throw BadInput(name + ".points: a line shorter than 1 px is not a direction");

  const double half_chord = std::max(shortest_half_chord, stroke.width);
  const int steps = static_cast<int>(std::ceil(line.length() / std::max(1.0, stroke.width / 2)));
  StrokeTrack track;
  cv::Point2d low(furthest, furthest), high(-furthest, -furthest);
  for (int i = 0; i <= steps; ++i) {
    const double length = steps > 0 ? line.length() * i / steps : 0;
    const cv::Vec3d here = line.at(length);
    const Station station{here[0], here[1], here[2] * stroke.width / 2,
                          directed ? line.tangent(length, half_chord) : cv::Vec2d()};
    track.stations.push_back(station);
    const double reach = std::max(0.5, station.radius);
    low = {std::min(low.x, here[0] - reach), std::min(low.y, here[1] - reach)};
    high = {std::max(high.x, here[0] + reach), std::max(high.y, here[1] + reach)};
  }
  track.box = {low, high};
  return track;
}

std::size_t pieces(const StrokeTrack& track) { return std::max<std::size_t>(1, track.stations.size() - 1); }

Nearest nearest_on_piece(const StrokeTrack& track, std::size_t piece, double x, double y) {
  const Station& from = track.stations[piece];
  const Station& to = track.stations[std::min(piece + 1, track.stations.size() - 1)];
  const auto [distance, share] = distance_to_segment(x, y, from.x, from.y, to.x, to.y);
  const cv::Vec2d mean = from.tangent * (1 - share) + to.tangent * share;
  const double size = cv::norm(mean);
  return {distance, from.radius + share * (to.radius - from.radius), size > 1e-6 ? mean / size : to.tangent};
}

Nearest nearest_on(const StrokeTrack& track, double x, double y) {
  Nearest nearest = nearest_on_piece(track, 0, x, y);
  for (std::size_t piece = 1; piece < pieces(track); ++piece)
    if (const Nearest other = nearest_on_piece(track, piece, x, y); other.distance <= nearest.distance) nearest = other;
  return nearest;
}

}  // namespace stillwater
