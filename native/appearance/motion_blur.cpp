#include "appearance/motion_blur.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr double longest_path = 4096;

/// Bilinear, at an index position; beyond the sides the nearest pixel.
template <class Pixel>
Pixel at(const cv::Mat_<Pixel>& image, cv::Vec2f index) {
  const float x = std::clamp(index[0], 0.0f, static_cast<float>(image.cols - 1));
  const float y = std::clamp(index[1], 0.0f, static_cast<float>(image.rows - 1));
  const int left = std::min(static_cast<int>(x), std::max(0, image.cols - 2)), right = std::min(left + 1, image.cols - 1);
  const int top = std::min(static_cast<int>(y), std::max(0, image.rows - 2)), bottom = std::min(top + 1, image.rows - 1);
  const float u = x - static_cast<float>(left), v = y - static_cast<float>(top);
  const Pixel upper = image(top, left) + u * (image(top, right) - image(top, left));
  const Pixel lower = image(bottom, left) + u * (image(bottom, right) - image(bottom, left));
  return upper + v * (lower - upper);
}

float fastest(const Field& velocity) {
  float square = 0;
  for (const cv::Vec2f& v : velocity) {
    if (!std::isfinite(v[0]) || !std::isfinite(v[1])) throw BadInput("velocity: not finite everywhere");
    square = std::max(square, v.dot(v));
  }
  return std::sqrt(square);
}

/// Trapezoidal mean of the colours along the streamline through a pixel, `steps` steps of `step` frames each way.
cv::Vec4f mean_along(const Rgba& picture, const Field& velocity, cv::Vec2f from, int steps, float step) {
  cv::Vec4f sum = picture(static_cast<int>(from[1]), static_cast<int>(from[0]));
  for (const float way : {step, -step}) {
    cv::Vec2f place = from;
    for (int i = 1; i <= steps; ++i) {
      const cv::Vec2f halfway = place + 0.5f * way * at(velocity, place);
      place += way * at(velocity, halfway);
      sum += (i == steps ? 0.5f : 1.0f) * at(picture, place);
    }
  }
  return sum * (1.0f / static_cast<float>(2 * steps));
}

}  // namespace

Rgba motion_blur(const Rgba& picture, const Field& velocity, const MotionBlurParameters& parameters) {
  check::not_empty("picture", picture);
  check::finite_colours("picture", picture);
  check::same_size("velocity", velocity, "picture", picture);
  check::in_range("shutter", parameters.shutter, 0, 10, "s");
  check::in_range("fps", parameters.fps, 1, 1000);
  check::in_range("average_blur", parameters.average_blur, 0, 1000, "px");

  const double frames = parameters.shutter * parameters.fps / 2;
  const double reach = frames * fastest(velocity);
  check::in_range("velocity", 2 * reach, 0, longest_path, "px while the shutter is open");
  Rgba blurred = picture.clone();
  if (reach > 0) {
    const int steps = std::max(1, static_cast<int>(std::ceil(reach)));
    const auto step = static_cast<float>(frames / steps);
    parallel_pixels(picture.size(), [&](int y, int x) {
      if (velocity(y, x) == cv::Vec2f(0, 0)) return;
      blurred(y, x) = mean_along(picture, velocity, {static_cast<float>(x), static_cast<float>(y)}, steps, step);
    });
  }
  if (parameters.average_blur > 0)
    cv::GaussianBlur(blurred, blurred, cv::Size(), parameters.average_blur, parameters.average_blur, cv::BORDER_REPLICATE);
  return blurred;
}

}  // namespace stillwater
