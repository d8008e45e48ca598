#include "layers/matting/stroke.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/error.h"
#include "layers/matting/segment_distance.h"

namespace stillwater {
namespace {

// A line is nowhere drawn thinner: in each column (or row) it then meets at least one pixel's centre.
constexpr double thinnest = 0.5;  // px, half width

void check_stroke(const Stroke& stroke, const std::string& name) {
  if (stroke.points.empty()) throw BadInput(name + ".points: none is not one point or more");
  check::in_range(name + ".width", stroke.width, 0, largest_side, "px");
  check::positive(name + ".width", stroke.width, "px");
  for (size_t i = 0; i < stroke.points.size(); ++i) {
    const std::string place = name + ".points[" + std::to_string(i) + "]";
    check::finite(place, stroke.points[i].x);
    check::finite(place, stroke.points[i].y);
    check::in_range(place + ", pressure", stroke.points[i].pressure, 0, 1);
  }
}

// The whole numbers from..to, cut to 0 .. size - 1.
cv::Range pixels_between(double from, double to, int size) {
  const double first = std::clamp(std::floor(from), 0.0, static_cast<double>(size));
  const double last = std::clamp(std::ceil(to), 0.0, static_cast<double>(size));
  return {static_cast<int>(first), static_cast<int>(last)};
}

// Gives the box that was looked at.
cv::Rect draw_piece(const StrokePoint& a, const StrokePoint& b, double width, Mask& mask) {
  const double radius_a = a.pressure * width / 2, radius_b = b.pressure * width / 2;
  const double reach = std::max({radius_a, radius_b, thinnest});
  const cv::Range rows = pixels_between(std::min(a.y, b.y) - reach, std::max(a.y, b.y) + reach, mask.rows);
  const cv::Range columns = pixels_between(std::min(a.x, b.x) - reach, std::max(a.x, b.x) + reach, mask.cols);
  for (int y = rows.start; y < rows.end; ++y)
    for (int x = columns.start; x < columns.end; ++x) {
      const auto [distance, share] = distance_to_segment(x + 0.5, y + 0.5, a.x, a.y, b.x, b.y);
      if (distance <= std::max(thinnest, radius_a + share * (radius_b - radius_a))) mask(y, x) = 255;
    }
  return {columns.start, rows.start, columns.size(), rows.size()};
}

}  // namespace

cv::Rect draw(const Stroke& stroke, const std::string& name, Mask& mask) {
  check_stroke(stroke, name);
  cv::Rect box;
  for (size_t i = 0; i < stroke.points.size(); ++i) {
    const StrokePoint& point = stroke.points[i];
    box |= draw_piece(stroke.points[i == 0 ? 0 : i - 1], point, stroke.width, mask);
    const double x = std::floor(point.x), y = std::floor(point.y);
    if (x < 0 || y < 0 || x >= mask.cols || y >= mask.rows) continue;
    mask(static_cast<int>(y), static_cast<int>(x)) = 255;
    box |= cv::Rect(static_cast<int>(x), static_cast<int>(y), 1, 1);
  }
  return box;
}

}  // namespace stillwater
