#include "flow/optical_flow.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {
namespace {

constexpr int smallest_side = 16;  // two patches
constexpr int searched_side = 64;  // OpenCV's search reads beyond smaller planes: it has fewer levels than its presets use
constexpr std::size_t outermost = 1000;  // one in so many at each end is no part of the range

void check_plane(const std::string& name, const Plane& plane) {
  if (std::min(plane.rows, plane.cols) < smallest_side)
    throw BadInput(name + ": " + std::to_string(plane.cols) + " x " + std::to_string(plane.rows) + " is not at least " +
                   std::to_string(smallest_side) + " pixels a side");
  for (const float number : plane)
    if (!std::isfinite(number)) throw BadInput(name + ": not finite everywhere");
}

/// Two planes as grey on one scale.
struct GreyPair {
  cv::Mat_<unsigned char> a, b;
  bool shows_nothing = false;  ///< one value everywhere
};

GreyPair grey_pair(const Plane& a, const Plane& b) {
  check_plane("a", a);
  check_plane("b", b);
  check::same_size("b", b, "a", a);
  std::vector<float> numbers(a.begin(), a.end());
  numbers.insert(numbers.end(), b.begin(), b.end());
  const auto left_out = static_cast<std::ptrdiff_t>(numbers.size() / outermost);
  const auto low = numbers.begin() + left_out, high = numbers.end() - 1 - left_out;
  std::nth_element(numbers.begin(), low, numbers.end());
  std::nth_element(low, high, numbers.end());
  const double range = static_cast<double>(*high) - *low;
  GreyPair pair;
  pair.shows_nothing = !(range > 0);
  const double scale = pair.shows_nothing ? 0 : 255 / range;
  a.convertTo(pair.a, CV_8U, scale, -scale * *low);
  b.convertTo(pair.b, CV_8U, scale, -scale * *low);
  return pair;
}

/// With its last row and column repeated as often as the search needs.
cv::Mat wide_enough(const cv::Mat_<unsigned char>& grey) {
  cv::Mat wide;
  cv::copyMakeBorder(grey, wide, 0, std::max(0, searched_side - grey.rows), 0, std::max(0, searched_side - grey.cols),
                     cv::BORDER_REPLICATE);
  return wide;
}

cv::Ptr<cv::DISOpticalFlow> search(FlowQuality quality) {
  if (quality == FlowQuality::fast) return cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_FAST);
  const auto flow = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
  if (quality == FlowQuality::best) {
    flow->setFinestScale(0);
    flow->setVariationalRefinementIterations(15);
  }
  return flow;
}

}  // namespace

FlowQuality flow_quality_named(const std::string& name) {
  if (name == "fast") return FlowQuality::fast;
  if (name == "medium") return FlowQuality::medium;
  if (name == "best") return FlowQuality::best;
  throw BadInput("quality: " + name + " is not fast, medium or best");
}

Plane luma(const cv::Mat_<cv::Vec3f>& colours) {
  Plane grey;
  cv::transform(colours, grey, cv::Matx13f(0.2126f, 0.7152f, 0.0722f));
  return grey;
}

Field optical_flow(const Plane& a, const Plane& b, FlowQuality quality) {
  const GreyPair pair = grey_pair(a, b);
  if (pair.shows_nothing) return Field(a.size(), cv::Vec2f());
  Field flow;
  search(quality)->calc(wide_enough(pair.a), wide_enough(pair.b), flow);
  return flow.size() == a.size() ? flow : Field(flow(cv::Rect(cv::Point(), a.size())).clone());
}

}  // namespace stillwater
