#include "flow/obstacles.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

using Bytes = cv::Mat_<unsigned char>;

constexpr double reach_share = 0.012;  // of the diagonal
constexpr double least_reach = 4;      // px
constexpr float flattest = 0.5f;       // slope of the distance above which its direction is a normal

/// From each pixel of value 255 to the border of the nearest one of value 0, px; 0 at those.
Plane distance_to_zero(const Bytes& inside) {
  Plane distance;
  cv::distanceTransform(inside, distance, cv::DIST_L2, cv::DIST_MASK_5);
  return distance;
}

float smooth_step(float t) {
  const float x = std::clamp(t, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

}  // namespace

double obstacle_reach(cv::Size picture) {
  return std::max(least_reach, reach_share * std::hypot(picture.width, picture.height));
}

Field wall_along(const Plane& matte) {
  check::each_in_range("bound", matte, 0, 1);
  Field wall(matte.size(), cv::Vec2f());
  const Bytes inside = matte >= outside;
  const int covered = cv::countNonZero(inside);
  if (covered == 0) throw BadInput("bound: a matte that is nowhere 0.1 or more is not a layer");
  if (covered == static_cast<int>(matte.total())) return wall;

  const auto reach = static_cast<float>(obstacle_reach(matte.size()));
  const Plane within = distance_to_zero(inside), without = distance_to_zero(~inside);
  const Plane distance = within - without;  // positive inside
  Plane smooth;
  const int window = 2 * static_cast<int>(std::ceil(reach / 4)) + 1;
  cv::blur(distance, smooth, {window, window}, {-1, -1}, cv::BORDER_REFLECT);
  cv::blur(smooth, smooth, {window, window}, {-1, -1}, cv::BORDER_REFLECT);
  parallel_pixels(matte.size(), [&](int y, int x) {
    const float share = 1 - smooth_step((within(y, x) - 1) / reach);
    if (share <= 0) return;
    const int left = std::max(0, x - 1), right = std::min(matte.cols - 1, x + 1);
    const int above = std::max(0, y - 1), below = std::min(matte.rows - 1, y + 1);
    const cv::Vec2f slope((smooth(y, right) - smooth(y, left)) / std::max(1, right - left),
                          (smooth(below, x) - smooth(above, x)) / std::max(1, below - above));
    const float steepness = std::sqrt(slope.dot(slope));
    wall(y, x) = slope * (std::sqrt(share) / std::max(steepness, flattest));
  });
  return wall;
}

Plane stillness_factor(const Plane& freeze) {
  check::each_in_range("freeze", freeze, 0, 1);
  const Bytes moving = freeze < 0.5f;
  Plane factor = 1.0f - freeze;
  const auto total = static_cast<int>(freeze.total());
  if (cv::countNonZero(moving) == total) return factor;
  const auto reach = static_cast<float>(obstacle_reach(freeze.size()));
  const Plane away = distance_to_zero(moving);
  parallel_pixels(freeze.size(), [&](int y, int x) { factor(y, x) *= smooth_step(away(y, x) / reach) * (moving(y, x) ? 1 : 0); });
  return factor;
}

}  // namespace stillwater
