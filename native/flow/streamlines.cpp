#include "flow/streamlines.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "flow/streamline.h"

namespace stillwater {
namespace {

constexpr double stored_apart = 8;  // px, where the flow is fastest
constexpr int fewest = 4, most = 64;
constexpr double longest_step = 8;  // px: what bends is cut finer in any case

double fastest(const Field& velocity) {
  float square = 0;
  for (const cv::Vec2f& v : velocity) square = std::max(square, v.dot(v));
  return std::sqrt(square);
}

}  // namespace

cv::Size Streamlines::knots_of(cv::Size pixels) {
  return {(pixels.width + apart - 2) / apart + 1, (pixels.height + apart - 2) / apart + 1};
}

Streamlines::Streamlines(const Field& velocity, double longest) : size_(knots_of(velocity.size())) {
  check::positive("longest", longest, "frames");
  const SteadyFlow flow(velocity);
  half_ = std::clamp(static_cast<int>(std::ceil(longest * fastest(velocity) / stored_apart)), fewest, most);
  step_ = longest / half_;
  places_.resize(static_cast<size_t>(size_.area()) * (stored() + 2));
  parallel_rows(size_.height, 4, [&](int first, int last) {
    for (int row = first; row < last; ++row)
      for (int column = 0; column < size_.width; ++column) {
        auto* middle = const_cast<cv::Vec2f*>(line(row, column)) + 1 + half_;
        const cv::Vec2d knot(column * apart, row * apart);
        for (const int way : {-1, 1}) {
          cv::Vec2d place = knot;
          for (int i = 1; i <= half_ + 1; ++i) {
            place = flow.carried(place, way * step_, longest_step);
            middle[way * i] = place - knot;
          }
        }
      }
  });
}

cv::Vec2f Streamlines::displaced(int row, int column, double frames) const {
  const double at = frames / step_ + half_;
  const int left = std::clamp(static_cast<int>(std::floor(at)), 0, 2 * half_ - 1);
  const auto t = static_cast<float>(std::clamp(at - left, 0.0, 1.0)), t2 = t * t, t3 = t2 * t;
  const cv::Vec2f* p = line(row, column) + left;
  return (-0.5f * t3 + t2 - 0.5f * t) * p[0] + (1.5f * t3 - 2.5f * t2 + 1.0f) * p[1] +
         (-1.5f * t3 + 2.0f * t2 + 0.5f * t) * p[2] + (0.5f * t3 - 0.5f * t2) * p[3];
}

}  // namespace stillwater
