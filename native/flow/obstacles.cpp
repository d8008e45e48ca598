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

constexpr double reach_share = 0.015;  // of the diagonal
constexpr double least_reach = 6;      // px
constexpr float flattest = 0.5f;       // slope of the distance above which its direction is a normal

/// From each pixel of value 255 to the border of the nearest one of value 0, px; 0 at those.
Plane distance_to_zero(const Bytes& inside) {
  Plane distance;
  cv::distanceTransform(inside, distance, cv::DIST_L2, cv::DIST_MASK_5);
  return distance;
}

/// Pixels up to which a reach is felt: the distances above are a few hundredths off.
int felt(float reach) { return static_cast<int>(std::ceil(1.1f * (reach + 1))) + 1; }

/// The box around the pixels of value 255, `more` px larger on each side as far as the picture goes.
cv::Rect box_around(const Bytes& some, int more) {
  const cv::Rect box = cv::boundingRect(some);
  return cv::Rect(box.x - more, box.y - more, box.width + 2 * more, box.height + 2 * more) & cv::Rect({0, 0}, some.size());
}

float smooth_step(float t) {
  const float x = std::clamp(t, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

/// wall_along() of a part of the picture that holds all that is outside, and what is near it.
void lay_wall(const Bytes& inside, float reach, int window, Field wall) {
  const Plane within = distance_to_zero(inside), without = distance_to_zero(~inside);
  Plane smooth = within - without;  // positive inside
  cv::blur(smooth, smooth, {window, window}, {-1, -1}, cv::BORDER_REFLECT);
  cv::blur(smooth, smooth, {window, window}, {-1, -1}, cv::BORDER_REFLECT);
  parallel_pixels(inside.size(), [&](int y, int x) {
    const float share = 1 - smooth_step((within(y, x) - 1) / reach);
    if (share <= 0) return;
    const int left = std::max(0, x - 1), right = std::min(inside.cols - 1, x + 1);
    const int above = std::max(0, y - 1), below = std::min(inside.rows - 1, y + 1);
    const cv::Vec2f slope((smooth(y, right) - smooth(y, left)) / std::max(1, right - left),
                          (smooth(below, x) - smooth(above, x)) / std::max(1, below - above));
    const float steepness = std::sqrt(slope.dot(slope));
    wall(y, x) = slope * (std::sqrt(share) / std::max(steepness, flattest));
  });
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
  const int window = 2 * static_cast<int>(std::ceil(reach / 4)) + 1;
  const cv::Rect near = box_around(~inside, felt(reach) + window + 1);
  lay_wall(inside(near), reach, window, wall(near));
  return wall;
}

Plane stillness_factor(const Plane& freeze) {
  check::each_in_range("freeze", freeze, 0, 1);
  const Bytes held = freeze >= 0.5f;
  Plane factor = 1.0f - freeze;
  if (cv::countNonZero(held) == 0) return factor;
  const auto reach = static_cast<float>(obstacle_reach(freeze.size()));
  const cv::Rect near = box_around(held, felt(reach));
  const Plane away = distance_to_zero(~held(near));
  Plane slowed = factor(near);
  parallel_pixels(near.size(), [&](int y, int x) { slowed(y, x) *= smooth_step(away(y, x) / reach); });
  return factor;
}

}  // namespace stillwater
