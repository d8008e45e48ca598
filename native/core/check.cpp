#include "core/check.h"

#include <cmath>
#include <sstream>

#include "core/error.h"

namespace stillwater::check {
namespace {

template <class Given, class Allowed>
[[noreturn]] void refuse(std::string_view name, const Given& given, const Allowed& allowed,
                         std::string_view unit = "") {
  std::ostringstream sentence;
  sentence << name << ": " << given << " is not " << allowed;
  if (!unit.empty()) sentence << " (" << unit << ")";
  throw BadInput(sentence.str());
}

std::string place(std::string_view name, int y, int x) {
  return std::string(name) + "[" + std::to_string(y) + ", " + std::to_string(x) + "]";
}

std::string shape(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

}  // namespace

void finite(std::string_view name, double value) {
  if (!std::isfinite(value)) refuse(name, value, "a finite number");
}

void positive(std::string_view name, double value, std::string_view unit) {
  if (!(std::isfinite(value) && value > 0)) refuse(name, value, "above 0", unit);
}

void in_range(std::string_view name, double value, double low, double high, std::string_view unit) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  std::ostringstream allowed;
  allowed << "between " << low << " and " << high;
  refuse(name, value, allowed.str(), unit);
}

void power_of_two(std::string_view name, int value, int low, int high) {
  if (value >= low && value <= high && (value & (value - 1)) == 0) return;
  std::ostringstream allowed;
  allowed << "a power of two between " << low << " and " << high;
  refuse(name, value, allowed.str());
}

void segment(std::string_view name, const Segment& segment) {
  for (double v : {segment.from.x, segment.from.y, segment.to.x, segment.to.y}) finite(name, v);
  const double length = std::hypot(segment.to.x - segment.from.x, segment.to.y - segment.from.y);
  if (length <= 1e-6) refuse(name, "a line from a point to itself", "a line with two different ends");
}

void size(std::string_view name, int width, int height) {
  if (width >= 1 && height >= 1 && width <= largest_side && height <= largest_side) return;
  refuse(name, shape(width, height), "between 1 and " + std::to_string(largest_side) + " pixels a side");
}

void same_size(std::string_view name, const cv::Mat& image, std::string_view other_name, const cv::Mat& other) {
  if (image.size() == other.size()) return;
  refuse(name, shape(image.cols, image.rows),
         "the size of " + std::string(other_name) + ", " + shape(other.cols, other.rows));
}

void not_empty(std::string_view name, const cv::Mat& image) {
  if (image.empty()) refuse(name, shape(image.cols, image.rows), "an image of at least one pixel");
}

void finite_colours(std::string_view name, const Rgba& image) {
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const cv::Vec4f& colour = image(y, x);
      if (std::isfinite(colour[0] + colour[1] + colour[2])) continue;
      for (int c = 0; c < 3; ++c) finite(place(name, y, x), colour[c]);
    }
}

void each_in_range(std::string_view name, const Plane& plane, double low, double high) {
  for (int y = 0; y < plane.rows; ++y)
    for (int x = 0; x < plane.cols; ++x)
      if (!(plane(y, x) >= low && plane(y, x) <= high)) in_range(place(name, y, x), plane(y, x), low, high);
}

}  // namespace stillwater::check
