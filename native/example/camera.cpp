#include "example/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/parallel.h"
#include "example/sample_differences.h"
#include "flow/optical_flow.h"

namespace stillwater {
namespace {

constexpr int parts = 3;  // along each side, half overlapping

double median(std::array<double, size_t{parts} * parts> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

Point moved(const Plane& from, const Plane& to) {
  const cv::Size part(2 * from.cols / (parts + 1), 2 * from.rows / (parts + 1));
  cv::Mat1f window;
  cv::createHanningWindow(window, part, CV_32F);
  std::array<double, size_t{parts} * parts> x{}, y{};
  for (int i = 0; i < parts * parts; ++i) {
    const cv::Rect area(cv::Point(i % parts * part.width / 2, i / parts * part.height / 2), part);
    const cv::Point2d way = cv::phaseCorrelate(from(area).clone(), to(area).clone(), window);
    x[i] = way.x, y[i] = way.y;
  }
  return {median(x), median(y)};
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

std::vector<Point> camera_path(const HalfFrames& frames, Progress& progress) {
  std::vector<Point> step(frames.count());
  parallel_rows(
      frames.count() - 1, 4,
      [&](int first, int last) {
        Plane here = luma(frames.read(first));
        for (int i = first; i < last; ++i) {
          const Plane next = luma(frames.read(i + 1));
          step[i + 1] = moved(here, next);
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
