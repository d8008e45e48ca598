#include "flow/refine_flow.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/parallel.h"
#include "flow/obstacles.h"

namespace stillwater {
namespace {

constexpr float one_step = 0.004f;     // a slope that says as much as the painted direction
constexpr double finest_blur = 3;      // px of the smaller picture; sigma is never less there
constexpr int coarsest = 64;           // px, side of the largest squares

Plane luma(const Rgba& picture) {
  Plane grey(picture.size());
  parallel_pixels(picture.size(), [&](int y, int x) {
    const cv::Vec4f& p = picture(y, x);
    grey(y, x) = 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
  });
  return grey;
}

/// |G| Psi_o at one pixel: the gradient turned by a quarter, the way of the painted direction.
cv::Vec2f along_edge(float slope_x, float slope_y, const cv::Vec2f& painted) {
  const cv::Vec2f edge(-slope_y, slope_x);
  const float agreement = edge.dot(painted);
  return edge * static_cast<float>((agreement > 0) - (agreement < 0));  // a branch would be guessed wrong as often as not
}

/// Means of |G| Psi_o over squares of `side` px, a power of two.
Field edge_directions(const Rgba& picture, const Field& painted, int side) {
  Plane smooth, slope_x, slope_y;
  cv::GaussianBlur(luma(picture), smooth, {5, 5}, 0);
  cv::Sobel(smooth, slope_x, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(smooth, slope_y, CV_32F, 0, 1, 3, 1.0 / 8);
  const int shift = std::countr_zero(static_cast<unsigned>(side));
  Field means((picture.rows + side - 1) / side, (picture.cols + side - 1) / side);
  parallel_rows(means.rows, std::max(1, 16 / side), [&](int first, int last) {
    for (int v = first; v < last; ++v) {
      std::vector<cv::Vec2f> sums(means.cols);
      const int below = std::min(picture.rows, (v + 1) * side);
      for (int y = v * side; y < below; ++y)
        for (int x = 0; x < picture.cols; ++x) sums[x >> shift] += along_edge(slope_x(y, x), slope_y(y, x), painted(y, x));
      for (int u = 0; u < means.cols; ++u)
        means(v, u) = sums[u] * (1.0f / ((below - v * side) * (std::min(picture.cols, (u + 1) * side) - u * side)));
    }
  });
  return means;
}

/// A power of two, so that a blur of `sigma` is at least finest_blur on squares of that side.
int square_side(double sigma) {
  int side = 1;
  while (side < coarsest && sigma / (side * 2) >= finest_blur) side *= 2;
  return side;
}

/// The variance that squares of `side` and straight lines between their middles have already, px^2.
double spread(int side) { return side == 1 ? 0 : (side * side - 1) / 12.0 + side * side / 6.0; }

Field blurred(const Field& field, double sigma) {
  if (sigma <= 0) return field;
  Field result;
  const int reach = static_cast<int>(std::ceil(3.5 * sigma));
  cv::GaussianBlur(field, result, {2 * reach + 1, 2 * reach + 1}, sigma, sigma, cv::BORDER_REFLECT);
  return result;
}

/// Where a row or column of pixels lies between the middles of squares.
struct Between {
  int first, second;
  float share;
};

std::vector<Between> between_middles(int pixels, int squares, int side) {
  std::vector<Between> places(pixels);
  for (int i = 0; i < pixels; ++i) {
    const double at = std::clamp((i + 0.5) / side - 0.5, 0.0, squares - 1.0);
    const int first = static_cast<int>(at);
    places[i] = {first, std::min(first + 1, squares - 1), static_cast<float>(at - first)};
  }
  return places;
}

cv::Vec2f refined(cv::Vec2f direction, const cv::Vec2f& painted, float speed, float amount) {
  direction += one_step * painted;
  const float size = std::sqrt(direction.dot(direction));
  const cv::Vec2f psi = size > 1e-9f ? direction * (1 / size) : painted;
  const float agreement = std::max(0.0f, psi.dot(painted));
  return speed * ((1 - amount) * painted + (amount * agreement) * psi);
}

}  // namespace

Field refine_flow(const PaintedFlow& painted, const Rgba& picture, const RefineParameters& parameters) {
  check::not_empty("picture", picture);
  check::same_size("picture", picture, "orientation", painted.orientation);
  check::same_size("speed", painted.speed, "orientation", painted.orientation);
  check::finite_colours("picture", picture);
  check::in_range("width", parameters.width, 0, 1000, "px");
  check::in_range("amount", parameters.amount, 0, 1);

  const int side = square_side(parameters.width);
  const double sigma = std::sqrt(std::max(0.0, parameters.width * parameters.width - spread(side))) / side;
  const Field directions = blurred(edge_directions(picture, painted.orientation, side), sigma);

  const auto across = between_middles(picture.cols, directions.cols, side);
  const auto down = between_middles(picture.rows, directions.rows, side);
  const auto amount = static_cast<float>(parameters.amount);
  Field flow(picture.size());
  parallel_rows(picture.rows, 16, [&](int first, int last) {
    std::vector<cv::Vec2f> line(directions.cols);
    for (int y = first; y < last; ++y) {
      const auto [above, below, share] = down[y];
      for (int u = 0; u < directions.cols; ++u)
        line[u] = directions(above, u) * (1 - share) + directions(below, u) * share;
      for (int x = 0; x < picture.cols; ++x) {
        const cv::Vec2f direction = line[across[x].first] * (1 - across[x].share) + line[across[x].second] * across[x].share;
        flow(y, x) = refined(direction, painted.orientation(y, x), painted.speed(y, x), amount);
        if (!painted.wall.empty()) flow(y, x) = slide(flow(y, x), painted.wall(y, x));
      }
    }
  });
  return flow;
}

}  // namespace stillwater
