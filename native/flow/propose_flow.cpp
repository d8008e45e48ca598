#include "flow/propose_flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "flow/stroke_points.h"

namespace stillwater {
namespace {

constexpr int longest_side = 480;      // px of the picture that is looked at
constexpr float noise_slope = 0.002f;  // of the colours, a pixel of that: below nothing is seen
constexpr double window = 0.018;       // sigma of the structure tensor, of the diagonal
constexpr double neighbourhood = 0.03;  // sigma of what signs agree with
constexpr double softness = 0.01;       // sigma of the last blur
constexpr double stroke_reach = 0.07;   // how far a stroke's own direction holds
constexpr int sign_rounds = 12;
constexpr float across_speed = 0.5f;  // share of the speed where the fluid runs across its kind's direction

struct KindOf {
  const char* name;
  cv::Vec2f direction;
  float trust;  // in the direction, against streaks that all agree (1)
  double speed;  // of the diagonal, a frame
};

constexpr int kinds = 5;
const KindOf& facts(FluidKind kind) {
  static const std::array<KindOf, kinds> table{{{"water", {0.94f, 0.342f}, 0.12f, 0.0015},
                                                {"falls", {0, 1}, 0.3f, 0.004},
                                                {"fire", {0, -1}, 0.25f, 0.003},
                                                {"smoke", {0, -1}, 0.2f, 0.0015},
                                                {"sky", {1, 0}, 0.15f, 0.0006}}};
  return table[static_cast<int>(kind)];
}

cv::Vec2f unit_or(const cv::Vec2f& v, const cv::Vec2f& other) {
  const float size = std::sqrt(v.dot(v));
  return size > 1e-6f ? v * (1 / size) : other;
}

cv::Vec2f doubled(const cv::Vec2f& v) { return {v[0] * v[0] - v[1] * v[1], 2 * v[0] * v[1]}; }

cv::Vec2f halved(const cv::Vec2f& v) {
  const float angle = std::atan2(v[1], v[0]) / 2;
  return {std::cos(angle), std::sin(angle)};
}

template <class Image>
Image blurred(const Image& image, double sigma) {
  Image result;
  cv::GaussianBlur(image, result, {0, 0}, sigma, sigma, cv::BORDER_REFLECT);
  return result;
}

template <class Image>
Image sized(const Image& image, cv::Size size, int interpolation) {
  if (image.empty() || image.size() == size) return image;
  Image result;
  cv::resize(image, result, size, 0, 0, interpolation);
  return result;
}

double diagonal(cv::Size size) { return std::hypot(size.width, size.height); }

/// Doubled angles of the streaks, their length 0..1: how far they agree.
Field streaks_seen(const Rgba& picture, const Plane& bound) {
  const Rgba smooth = blurred(picture, 1.0);
  cv::Mat slope_x, slope_y;
  cv::Sobel(smooth, slope_x, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(smooth, slope_y, CV_32F, 0, 1, 3, 1.0 / 8);
  cv::Mat_<cv::Vec3f> seen(picture.size());  // doubled angle, and its weight
  parallel_pixels(picture.size(), [&](int y, int x) {
    const cv::Vec4f across = slope_x.at<cv::Vec4f>(y, x), down = slope_y.at<cv::Vec4f>(y, x);
    float xx = 0, xy = 0, yy = 0;
    for (int c = 0; c < 3; ++c) {
      xx += across[c] * across[c];
      xy += across[c] * down[c];
      yy += down[c] * down[c];
    }
    const float size = std::sqrt((xx + yy) / 3), weight = bound.empty() ? 1.0f : bound(y, x);
    const float scale = size > 0 ? weight / (3 * size) : 0;
    seen(y, x) = {-(xx - yy) * scale, -2 * xy * scale, weight * size};
  });
  seen = blurred(seen, std::max(1.0, window * diagonal(picture.size())));
  const Plane covered = bound.empty() ? Plane() : blurred(bound, std::max(1.0, window * diagonal(picture.size())));
  Field streaks(picture.size());
  parallel_pixels(picture.size(), [&](int y, int x) {
    const cv::Vec3f& s = seen(y, x);
    const float most = s[2] + noise_slope * (covered.empty() ? 1.0f : covered(y, x)) + 1e-9f;
    streaks(y, x) = {s[0] / most, s[1] / most};
  });
  return streaks;
}

/// Unit vectors along the doubled angles, signed as `wanted` and, where that stands across, as their neighbours.
Field signed_directions(const Field& angles, const Field& wanted) {
  Field line(angles.size()), directions(angles.size());
  parallel_pixels(angles.size(), [&](int y, int x) {
    line(y, x) = halved(angles(y, x));
    directions(y, x) = line(y, x) * line(y, x).dot(wanted(y, x));
  });
  for (int round = 0; round < sign_rounds; ++round) {
    const Field around = blurred(directions, neighbourhood * diagonal(angles.size()));
    parallel_pixels(angles.size(), [&](int y, int x) {
      const cv::Vec2f& along = line(y, x);
      const float agreement = along.dot(around(y, x) + 0.5f * wanted(y, x));
      directions(y, x) = agreement < 0 ? -along : along;
    });
  }
  return directions;
}

/// 1 on the strokes that say a direction, falling to 0 around them.
Plane near_strokes(const std::vector<FlowStroke>& strokes, cv::Size picture, cv::Size size) {
  cv::Mat_<unsigned char> away(size, 255);
  const double scale_x = static_cast<double>(size.width) / picture.width, scale_y = static_cast<double>(size.height) / picture.height;
  for (const FlowStroke& stroke : strokes) {
    if (stroke.kind == FlowStrokeKind::speed || stroke.alpha == 0) continue;
    for (const Station& station : track_of(stroke, "strokes").stations)
      cv::circle(away, cv::Point2d(station.x * scale_x, station.y * scale_y), std::max(1, cvRound(station.radius * scale_x)), 0, -1);
  }
  Plane distance, near(size);
  cv::distanceTransform(away, distance, cv::DIST_L2, cv::DIST_MASK_5);
  const double reach = stroke_reach * diagonal(size);
  parallel_pixels(size, [&](int y, int x) { near(y, x) = static_cast<float>(std::exp(-std::pow(distance(y, x) / reach, 2))); });
  return near;
}

bool any_says(const std::vector<FlowStroke>& strokes, FlowStrokeKind kind) {
  return std::any_of(strokes.begin(), strokes.end(),
                     [&](const FlowStroke& stroke) { return stroke.kind == kind || stroke.kind == FlowStrokeKind::both; });
}

}  // namespace

FluidKind fluid_kind_named(const std::string& name) {
  for (int i = 0; i < kinds; ++i)
    if (name == facts(static_cast<FluidKind>(i)).name) return static_cast<FluidKind>(i);
  throw BadInput("kind: " + name + " is not water, falls, fire, smoke or sky");
}

PaintedFlow propose_flow(const Rgba& picture, FluidKind kind, const std::vector<FlowStroke>& strokes, const Plane& bound,
                         const Plane& freeze) {
  check::not_empty("picture", picture);
  check::size("picture", picture.cols, picture.rows);
  check::finite_colours("picture", picture);
  if (!bound.empty()) check::same_size("bound", bound, "picture", picture);
  const KindOf& of = facts(kind);
  const double scale = std::min(1.0, static_cast<double>(longest_side) / std::max(picture.cols, picture.rows));
  const cv::Size size(std::max(1, cvRound(picture.cols * scale)), std::max(1, cvRound(picture.rows * scale)));

  const bool directed = any_says(strokes, FlowStrokeKind::orientation);
  Field wanted(size, of.direction);
  Plane near = Plane::zeros(size);
  if (directed) {
    wanted = sized(paint_orientation(strokes, picture.size()), size, cv::INTER_AREA);
    near = near_strokes(strokes, picture.size(), size);
  }

  Field angles = streaks_seen(sized(picture, size, cv::INTER_AREA), sized(bound, size, cv::INTER_AREA));
  parallel_pixels(size, [&](int y, int x) {
    wanted(y, x) = unit_or(wanted(y, x), of.direction);
    angles(y, x) = (1 - near(y, x)) * angles(y, x) + (of.trust + near(y, x)) * doubled(wanted(y, x));
  });
  Field directions = signed_directions(angles, wanted);
  parallel_pixels(size, [&](int y, int x) {
    directions(y, x) = (1 - near(y, x)) * directions(y, x) + near(y, x) * wanted(y, x);
  });
  directions = blurred(directions, std::max(0.5, softness * diagonal(size)));

  const auto speed = static_cast<float>(of.speed * diagonal(picture.size()));
  PaintedFlow flow{sized(directions, picture.size(), cv::INTER_LINEAR), Plane(picture.size()), {}};
  const Field ways = sized(wanted, picture.size(), cv::INTER_LINEAR);
  parallel_pixels(picture.size(), [&](int y, int x) {
    flow.orientation(y, x) = unit_or(flow.orientation(y, x), of.direction);
    const float agreement = std::max(0.0f, flow.orientation(y, x).dot(ways(y, x)));
    flow.speed(y, x) = speed * (across_speed + (1 - across_speed) * agreement);
  });
  if (any_says(strokes, FlowStrokeKind::speed)) flow.speed = paint_speed(strokes, picture.size());
  bound_flow(flow, bound, freeze);
  return flow;
}

}  // namespace stillwater
