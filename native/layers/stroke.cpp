#include "layers/stroke.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/error.h"

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

void draw_piece(const StrokePoint& a, const StrokePoint& b, double width, Mask& mask) {
  const double radius_a = a.pressure * width / 2, radius_b = b.pressure * width / 2;
  const double reach = std::max({radius_a, radius_b, thinnest});
  const cv::Range rows = pixels_between(std::min(a.y, b.y) - reach, std::max(a.y, b.y) + reach, mask.rows);
  const double along_x = b.x - a.x, along_y = b.y - a.y, square = along_x * along_x + along_y * along_y;
  for (int y = rows.start; y < rows.end; ++y) {
    const cv::Range columns = pixels_between(std::min(a.x, b.x) - reach, std::max(a.x, b.x) + reach, mask.cols);
    for (int x = columns.start; x < columns.end; ++x) {
      const double px = x + 0.5 - a.x, py = y + 0.5 - a.y;
      const double share = square > 0 ? std::clamp((px * along_x + py * along_y) / square, 0.0, 1.0) : 0;
      const double radius = std::max(thinnest, radius_a + share * (radius_b - radius_a));
      if (std::hypot(px - share * along_x, py - share * along_y) <= radius) mask(y, x) = 255;
    }
  }
}

}  // namespace

void draw(const Stroke& stroke, const std::string& name, Mask& mask) {
  check_stroke(stroke, name);
  for (size_t i = 0; i < stroke.points.size(); ++i) {
    const StrokePoint& point = stroke.points[i];
    draw_piece(stroke.points[i == 0 ? 0 : i - 1], point, stroke.width, mask);
    const double x = std::floor(point.x), y = std::floor(point.y);
    if (x >= 0 && y >= 0 && x < mask.cols && y < mask.rows) mask(static_cast<int>(y), static_cast<int>(x)) = 255;
  }
}

}  // namespace stillwater
