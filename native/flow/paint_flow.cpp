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
constexpr int usual_centres = 600, most_centres = 2000;  // as many do for some 50 strokes; the cost is their third power
constexpr int centres_a_stroke = 12;

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

Accuracy accuracy(double tolerance, std::size_t strokes) {
  return {tolerance, std::clamp(centres_a_stroke * static_cast<int>(strokes), usual_centres, most_centres)};
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
    Plane below = speed(layer.box);
    below += layer.matte.mul(static_cast<float>(one.stroke->speed) - below);
  }
}

Plane interpolated_speed(const std::vector<PaintedTrack>& tracks, cv::Size picture) {
  const std::vector<StrokePixel> pixels = stroke_pixels(tracks, picture);
  if (pixels.empty()) throw BadInput("strokes: none of those that say a speed touches the picture");
  double largest = 0;
  for (const StrokePixel& pixel : pixels) largest = std::max(largest, pixel.value[0]);
  const Accuracy wanted = accuracy(std::max(1e-6, speed_tolerance * largest), tracks.size());
  return cv::max(radial_fill<float>(interpolated(weakened(pixels, false, wanted), false, wanted), picture), 0.0f);
}

void slide_along(PaintedFlow& flow) {
  parallel_pixels(flow.speed.size(), [&](int y, int x) {
    const cv::Vec2f along = slide(flow.orientation(y, x), flow.wall(y, x));
    const float size = std::sqrt(along.dot(along));
    flow.speed(y, x) *= size;
    if (size > 1e-4f) flow.orientation(y, x) = along * (1 / size);
  });
}

}  // namespace

Field paint_orientation(const std::vector<FlowStroke>& strokes, cv::Size picture) {
  const std::vector<Drawn> all = drawn(strokes, picture);
  std::vector<PaintedTrack> tracks = tracks_of(all, FlowStrokeKind::orientation, false);
  if (tracks.empty()) tracks = tracks_of(all, FlowStrokeKind::orientation, true);
  const std::vector<StrokePixel> pixels = stroke_pixels(tracks, picture);
  if (pixels.empty())
    throw BadInput("strokes: none that touches the picture is of kind orientation or both, with an alpha above 0");
  const Accuracy wanted = accuracy(orientation_tolerance, tracks.size());
  Field orientation = radial_fill<cv::Vec2f>(interpolated(weakened(pixels, true, wanted), true, wanted), picture);
  normalise(orientation);
  lay_local_directions(all, orientation);
  return orientation;
}

Plane paint_speed(const std::vector<FlowStroke>& strokes, cv::Size picture) {
  const std::vector<Drawn> all = drawn(strokes, picture);
  const std::vector<PaintedTrack> tracks = tracks_of(all, FlowStrokeKind::speed, false);
  const bool all_local = std::all_of(all.begin(), all.end(), [](const Drawn& one) { return one.stroke->local; });
  const auto elsewhere = static_cast<float>(all_local ? 0 : FlowStroke().speed);
  Plane speed = tracks.empty() ? Plane(picture, elsewhere) : interpolated_speed(tracks, picture);
  lay_local_speeds(all, speed);
  return speed;
}

void bound_flow(PaintedFlow& flow, const Plane& bound, const Plane& freeze) {
  if (!bound.empty()) {
    check::same_size("bound", bound, "picture", flow.speed);
    flow.wall = wall_along(bound);
    slide_along(flow);
  }
  if (!freeze.empty()) {
    check::same_size("freeze", freeze, "picture", flow.speed);
    flow.speed = flow.speed.mul(stillness_factor(freeze));
  }
}

PaintedFlow paint_flow(const std::vector<FlowStroke>& strokes, cv::Size picture, const Plane& bound, const Plane& freeze) {
  PaintedFlow flow{paint_orientation(strokes, picture), paint_speed(strokes, picture), {}};
  bound_flow(flow, bound, freeze);
  return flow;
}

}  // namespace stillwater
