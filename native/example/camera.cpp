#include "example/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "core/parallel.h"
#include "example/sample_differences.h"
#include "flow/optical_flow.h"

namespace stillwater {
namespace {

constexpr int parts = 3;  // along each side, half overlapping
constexpr int looked_at = 24, alike = 5;
constexpr int frames_apart = 8;  // a fluid is another one by then, what stands behind it is not
constexpr double least_way = 0.5, off = 0.15, off_share = 1.0 / 6;  // px
constexpr int longest_side = 320;  // px: larger frames are made smaller first

using Ways = std::array<double, size_t{parts} * parts>;

double median(Ways values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

/// How each part moves from one plane to the next, px of these.
struct PartsMoved {
  Ways x{}, y{};

  PartsMoved(const Plane& from, const Plane& to) {
    const cv::Size part(2 * from.cols / (parts + 1), 2 * from.rows / (parts + 1));
    cv::Mat1f window;
    cv::createHanningWindow(window, part, CV_32F);
    for (int i = 0; i < parts * parts; ++i) {
      const cv::Rect area(cv::Point(i % parts * part.width / 2, i / parts * part.height / 2), part);
      const cv::Point2d way = cv::phaseCorrelate(from(area).clone(), to(area).clone(), window);
      x[i] = way.x, y[i] = way.y;
    }
  }

  Point usual() const { return {median(x), median(y)}; }
};

double shrinking(const HalfFrames& frames) {
  return std::min(1.0, static_cast<double>(longest_side) / std::max(frames.size().width, frames.size().height));
}

Plane small(const Plane& plane, double scale) {
  if (scale == 1) return plane;
  Plane reduced;
  cv::resize(plane, reduced, cv::Size(), scale, scale, cv::INTER_AREA);
  return reduced;
}

bool as_one(const PartsMoved& moved, double scale) {
  const Point usual = moved.usual();
  const double way = std::hypot(usual.x, usual.y) / scale;
  int same = 0;
  for (size_t i = 0; i < moved.x.size(); ++i)
    same += std::hypot(moved.x[i] - usual.x, moved.y[i] - usual.y) / scale < off + off_share * way;
  return way >= least_way && same >= alike;
}

// A straight line through the places, by least squares.
struct Trend {
  double start = 0, slope = 0;

  explicit Trend(const std::vector<double>& values) {
    const auto count = static_cast<double>(values.size());
    double mean = 0, middle = (count - 1) / 2, along = 0, across = 0;
    for (const double value : values) mean += value / count;
    for (size_t i = 0; i < values.size(); ++i) {
      const double t = static_cast<double>(i) - middle;
      along += t * t, across += t * (values[i] - mean);
    }
    slope = along > 0 ? across / along : 0;
    start = mean - slope * middle;
  }

  double at(size_t i) const { return start + slope * static_cast<double>(i); }
};

}  // namespace

double moves_as_one(const HalfFrames& frames) {
  const int apart = std::min(frames_apart, frames.count() - 1), pairs = frames.count() - apart;
  const int seen = std::min(pairs, looked_at);
  if (apart < 1) return 0;
  const double scale = shrinking(frames);
  std::vector<int> found(seen);
  parallel_rows(seen, 1, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      const int i = static_cast<int>(static_cast<std::int64_t>(k) * pairs / seen);
      found[k] = as_one({small(luma(frames.read(i)), scale), small(luma(frames.read(i + apart)), scale)}, scale) ? 1 : 0;
    }
  });
  return static_cast<double>(std::count(found.begin(), found.end(), 1)) / seen;
}

std::vector<Point> camera_path(const HalfFrames& frames, Progress& progress) {
  std::vector<Point> step(frames.count());
  parallel_rows(
      frames.count() - 1, 4,
      [&](int first, int last) {
        Plane here = luma(frames.read(first));
        for (int i = first; i < last; ++i) {
          const Plane next = luma(frames.read(i + 1));
          step[i + 1] = PartsMoved(here, next).usual();
          here = next;
        }
      },
      [&](double share) { progress.at(share); });
  for (size_t i = 1; i < step.size(); ++i) step[i].x += step[i - 1].x, step[i].y += step[i - 1].y;
  return step;
}

double hold_camera(HalfFrames& frames, const std::vector<Point>& path) {
  std::vector<double> x, y;
  for (const Point& place : path) x.push_back(place.x), y.push_back(place.y);
  const Trend along_x(x), along_y(y);
  double furthest = 0;
  for (size_t i = 0; i < path.size(); ++i)
    furthest = std::max(furthest, std::hypot(x[i] - along_x.at(i), y[i] - along_y.at(i)));
  parallel_rows(frames.count(), 1, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const cv::Vec2f off(static_cast<float>(x[i] - along_x.at(i)), static_cast<float>(y[i] - along_y.at(i)));
      frames.write(i, sample_differences(frames.read(i), Field(frames.size(), off)));
    }
  });
  return furthest;
}

}  // namespace stillwater
