#include "flow/paint_flow.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "flow/local_stroke.h"
#include "flow/obstacles.h"
#include "flow/radial_fill.h"
#include "flow/stroke_points.h"

namespace stillwater {
namespace {

constexpr double orientation_tolerance = 0.03;  // of unit vectors
constexpr double speed_tolerance = 0.02;        // of the largest speed
constexpr double cancelled = 0.1;               // directions that add up to less say nothing
// The cost is their third power; the eye forgives speeds more than directions.
constexpr int usual_centres = 600, usual_speed_centres = 300, most_centres = 2000;
constexpr int centres_a_stroke = 8;

struct Drawn {
  const FlowStroke* stroke;
  StrokeTrack track;

  bool says(FlowStrokeKind kind) const { return stroke->kind == kind || stroke->kind == FlowStrokeKind::both; }
};

std::vector<Drawn> drawn(const std::vector<FlowStroke>& strokes, cv::Size picture) {
  check::size("picture", picture.width, picture.height);
  if (strokes.empty()) throw BadInput("strokes: none is not one stroke or more");
  std::vector<Drawn> all;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    Drawn one{&strokes[i], track_of(strokes[i], "strokes[" + std::to_string(i) + "]")};
    if (strokes[i].alpha > 0) all.push_back(std::move(one));
  }
  return all;
}

/// Those that say one kind, local ones or the others, their strength over the largest.
std::vector<PaintedTrack> tracks_of(const std::vector<Drawn>& all, FlowStrokeKind kind, bool local) {
  std::vector<PaintedTrack> tracks;
  double strongest = 0;
  for (const Drawn& one : all) {
    if (!one.says(kind) || one.stroke->local != local) continue;
    tracks.push_back({&one.track, one.stroke->alpha, kind == FlowStrokeKind::orientation, one.stroke->speed});
    strongest = std::max(strongest, one.stroke->alpha);
  }
  for (PaintedTrack& track : tracks) track.strength /= strongest;
  return tracks;
}

struct Accuracy {
  double tolerance;
  int centres;
};

Accuracy accuracy(double tolerance, std::size_t strokes, int usual) {
  return {tolerance, std::clamp(centres_a_stroke * static_cast<int>(strokes), usual, most_centres)};
}

RadialInterpolation interpolated(const std::vector<StrokePixel>& pixels, bool directed, const Accuracy& accuracy) {
  std::vector<Point> places;
  Eigen::MatrixXd values(static_cast<Eigen::Index>(pixels.size()), directed ? 2 : 1);
  for (const StrokePixel& pixel : pixels) {
    const auto row = static_cast<Eigen::Index>(places.size());
    places.push_back({pixel.index.x + 0.5, pixel.index.y + 0.5});
    for (Eigen::Index c = 0; c < values.cols(); ++c) values(row, c) = pixel.value[static_cast<int>(c)];
  }
  return {places, values, {.tolerance = accuracy.tolerance, .most_centres = accuracy.centres}};
}

cv::Vec2d direction(const cv::Vec2d& v) {
  const double size = cv::norm(v);
  return size > 1e-9 ? v / size : cv::Vec2d(1, 0);
}

/// What weaker strokes say, each pulled to what the firm ones say there; those that then say nothing are left out.
std::vector<StrokePixel> weakened(const std::vector<StrokePixel>& pixels, bool directed, const Accuracy& accuracy) {
  std::vector<StrokePixel> firm, all;
  for (const StrokePixel& pixel : pixels)
    if (pixel.strength >= 1) firm.push_back(pixel);
  if (firm.empty() || firm.size() == pixels.size()) return pixels;
  const RadialInterpolation base = interpolated(firm, directed, accuracy);
  for (StrokePixel pixel : pixels) {
    if (pixel.strength < 1) {
      const Eigen::MatrixXd there = base.at({{pixel.index.x + 0.5, pixel.index.y + 0.5}});
      cv::Vec2d below(there(0, 0), directed ? there(0, 1) : 0);
      if (directed) below = direction(below);
      pixel.value = below * (1 - pixel.strength) + pixel.value * pixel.strength;
      if (directed && cv::norm(pixel.value) < cancelled) continue;
      if (directed) pixel.value = direction(pixel.value);
    }
    all.push_back(pixel);
  }
  return all;
}

void normalise(Field& field) {
  parallel_pixels(field.size(), [&](int y, int x) {
    cv::Vec2f& v = field(y, x);
    const float size = std::sqrt(v[0] * v[0] + v[1] * v[1]);
    v = size > 1e-9f ? v * (1 / size) : cv::Vec2f(1, 0);
  });
}

void lay_local_directions(const std::vector<Drawn>& all, Field& orientation) {
  for (const Drawn& one : all) {
    if (!one.stroke->local || !one.says(FlowStrokeKind::orientation)) continue;
    const LocalLayer layer = local_layer(one.track, one.stroke->alpha, orientation.size());
    for (int y = 0; y < layer.box.height; ++y)
      for (int x = 0; x < layer.box.width; ++x) {
        cv::Vec2f& below = orientation(layer.box.y + y, layer.box.x + x);
        const float share = layer.matte(y, x);
        if (share > 0) below = direction(cv::Vec2d(below) * (1 - share) + cv::Vec2d(layer.tangent(y, x)) * share);
      }
  }
}

void lay_local_speeds(const std::vector<Drawn>& all, Plane& speed) {
  for (const Drawn& one : all) {
    if (!one.stroke->local || !one.says(FlowStrokeKind::speed)) continue;
    const LocalLayer layer = local_layer(one.track, one.stroke->alpha, speed.size());
    if (layer.box.empty()) continue;
    Plane below = speed(layer.box);
    below += layer.matte.mul(static_cast<float>(one.stroke->speed) - below);
  }
}

/// What the interpolation of one kind starts from.
struct Ready {
  std::vector<StrokePixel> pixels;
  Accuracy accuracy;
};

Ready ready_orientation(const std::vector<Drawn>& all, cv::Size picture) {
  std::vector<PaintedTrack> tracks = tracks_of(all, FlowStrokeKind::orientation, false);
  if (tracks.empty()) tracks = tracks_of(all, FlowStrokeKind::orientation, true);
  const Ready ready{stroke_pixels(tracks, picture), accuracy(orientation_tolerance, tracks.size(), usual_centres)};
  if (ready.pixels.empty())
    throw BadInput("strokes: none that touches the picture is of kind orientation or both, with an alpha above 0");
  return ready;
}

/// Without pixels where no global stroke says a speed.
Ready ready_speed(const std::vector<Drawn>& all, cv::Size picture) {
  const std::vector<PaintedTrack> tracks = tracks_of(all, FlowStrokeKind::speed, false);
  if (tracks.empty()) return {};
  const std::vector<StrokePixel> pixels = stroke_pixels(tracks, picture);
  if (pixels.empty()) throw BadInput("strokes: none of those that say a speed touches the picture");
  double largest = 0;
  for (const StrokePixel& pixel : pixels) largest = std::max(largest, pixel.value[0]);
  return {pixels, accuracy(std::max(1e-6, speed_tolerance * largest), tracks.size(), usual_speed_centres)};
}

Field finished_orientation(const Ready& ready, const std::vector<Drawn>& all, cv::Size picture) {
  const RadialInterpolation between = interpolated(weakened(ready.pixels, true, ready.accuracy), true, ready.accuracy);
  Field orientation = radial_fill<cv::Vec2f>(between, picture);
  normalise(orientation);
  lay_local_directions(all, orientation);
  return orientation;
}

Plane finished_speed(const Ready& ready, const std::vector<Drawn>& all, cv::Size picture) {
  const bool all_local = std::all_of(all.begin(), all.end(), [](const Drawn& one) { return one.stroke->local; });
  Plane speed;
  if (ready.pixels.empty()) {
    speed = Plane(picture, static_cast<float>(all_local ? 0 : FlowStroke().speed));
  } else {
    const auto slower = [](const StrokePixel& a, const StrokePixel& b) { return a.value[0] < b.value[0]; };
    const auto [slowest, fastest] = std::minmax_element(ready.pixels.begin(), ready.pixels.end(), slower);
    const RadialInterpolation between = interpolated(weakened(ready.pixels, false, ready.accuracy), false, ready.accuracy);
    speed = radial_fill<float>(between, picture);
    speed = cv::min(cv::max(speed, static_cast<float>(slowest->value[0])), static_cast<float>(fastest->value[0]));
  }
  lay_local_speeds(all, speed);
  return speed;
}

void slide_along(PaintedFlow& flow) {
  parallel_pixels(flow.speed.size(), [&](int y, int x) {
    const cv::Vec2f& wall = flow.wall(y, x);
    if (wall[0] == 0 && wall[1] == 0) return;
    const cv::Vec2f along = slide(flow.orientation(y, x), wall);
    const float size = std::sqrt(along.dot(along));
    flow.speed(y, x) *= size;
    if (size > 1e-4f) flow.orientation(y, x) = along * (1 / size);
  });
}

/// What bound and freeze say; empty where there is none.
struct Obstacles {
  Field wall;
  Plane stillness;
};

void obey(PaintedFlow& flow, const Obstacles& obstacles) {
  if (!obstacles.wall.empty()) {
    flow.wall = obstacles.wall;
    slide_along(flow);
  }
  if (!obstacles.stillness.empty()) cv::multiply(flow.speed, obstacles.stillness, flow.speed);
}

void check_obstacles(const Plane& bound, const Plane& freeze, const PaintedFlow& flow) {
  if (!bound.empty()) check::same_size("bound", bound, "picture", flow.speed);
  if (!freeze.empty()) check::same_size("freeze", freeze, "picture", flow.speed);
}

}  // namespace

Field paint_orientation(const std::vector<FlowStroke>& strokes, cv::Size picture) {
  const std::vector<Drawn> all = drawn(strokes, picture);
  return finished_orientation(ready_orientation(all, picture), all, picture);
}

Plane paint_speed(const std::vector<FlowStroke>& strokes, cv::Size picture) {
  const std::vector<Drawn> all = drawn(strokes, picture);
  return finished_speed(ready_speed(all, picture), all, picture);
}

void bound_flow(PaintedFlow& flow, const Plane& bound, const Plane& freeze) {
  check_obstacles(bound, freeze, flow);
  obey(flow, {bound.empty() ? Field() : wall_along(bound), freeze.empty() ? Plane() : stillness_factor(freeze)});
}

PaintedFlow paint_flow(const std::vector<FlowStroke>& strokes, cv::Size picture, const Plane& bound, const Plane& freeze) {
  const std::vector<Drawn> all = drawn(strokes, picture);
  const Ready orientation = ready_orientation(all, picture), speed = ready_speed(all, picture);
  PaintedFlow flow;
  Obstacles obstacles;
  parallel_rows(4, 1, [&](int part, int) {
    if (part == 0) flow.orientation = finished_orientation(orientation, all, picture);
    if (part == 1) flow.speed = finished_speed(speed, all, picture);
    if (part == 2 && !bound.empty()) obstacles.wall = wall_along(bound);
    if (part == 3 && !freeze.empty()) obstacles.stillness = stillness_factor(freeze);
  });
  check_obstacles(bound, freeze, flow);
  obey(flow, obstacles);
  return flow;
}

}  // namespace stillwater
