#include "layers/cyclic.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/check.h"

namespace stillwater {
namespace {

// Share of the side, 1/n, over which the strip goes on as a mirror image at each end, fading.
constexpr int blend_part = 16;

// How many rows and columns of a blend are compared at most: the choice needs no more, and time is short.
constexpr int compared_rows = 64, compared_columns = 8;

// Sum of squared differences, in steps of 1/255: whole numbers, so that the choice is the same everywhere.
std::int64_t difference(const Rgba& image, int column, int other) {
  std::int64_t sum = 0;
  for (int y = 0; y < image.rows; y += image.rows / compared_rows + 1)
    for (int c = 0; c < 4; ++c) {
      const auto step = std::lround(255 * std::clamp(image(y, column)[c] - image(y, other)[c], -1.0f, 1.0f));
      sum += step * step;
    }
  return sum;
}

// First column of the piece that goes on best from the picture's end and leads best to its beginning.
int best_piece(const Rgba& image, int strip, int blend) {
  const int side = image.cols;
  int best = 0;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (int start = 0; start + strip <= side; ++start) {
    std::int64_t misfit = 0;
    for (int j = 0; j < blend; j += blend / compared_columns + 1)
      misfit += difference(image, start + j, side - 1 - j) + difference(image, start + strip - 1 - j, j);
    if (misfit < least) best = start, least = misfit;
  }
  return best;
}

float smooth_step(float t) { return t * t * (3 - 2 * t); }

// For each row what must be added to the columns from `at` on, in the direction of `step`, to have the tone of those
// from `wanted` on, in the direction of `wanted_step`; smooth along the column.
Rgba tone_step(const Rgba& image, int at, int step, int wanted, int wanted_step, int blend) {
  Rgba steps = Rgba::zeros(image.rows, 1);
  for (int y = 0; y < image.rows; ++y)
    for (int j = 0; j < blend; ++j)
      steps(y, 0) += (image(y, wanted + j * wanted_step) - image(y, at + j * step)) * (1.0 / blend);
  const double sigma = std::max(1.0, image.rows / 16.0);
  cv::GaussianBlur(steps, steps, cv::Size(1, 0), 1, sigma, cv::BORDER_REPLICATE);
  return steps;
}

cv::Vec4f in_range(cv::Vec4f pixel) {
  for (int c = 0; c < 4; ++c) pixel[c] = std::max(pixel[c], 0.0f);
  pixel[3] = std::min(pixel[3], 1.0f);
  return pixel;
}

Rgba continued_to_the_right(const Rgba& image) {
  const int side = image.cols, strip = cyclic_period(side) - side;
  const int blend = std::min((side + blend_part - 1) / blend_part, strip / 2);
  const int start = best_piece(image, strip, blend);
  const Rgba from = tone_step(image, start, 1, side - 1, -1, blend);
  const Rgba to = tone_step(image, start + strip - 1, -1, 0, 1, blend);
  Rgba whole(image.rows, side + strip);
  image.copyTo(whole.colRange(0, side));
  for (int y = 0; y < image.rows; ++y)
    for (int j = 0; j < strip; ++j) {
      const int left = strip - 1 - j;
      const float t = (j + 0.5f) / strip;
      cv::Vec4f pixel = in_range(image(y, start + j) + (1 - t) * from(y, 0) + t * to(y, 0));
      if (std::min(j, left) < blend) {
        const float share = smooth_step((std::min(j, left) + 0.5f) / blend);
        pixel = share * pixel + (1 - share) * (j < left ? image(y, side - 1 - j) : image(y, left));
      }
      whole(y, side + j) = pixel;
    }
  return whole;
}

}  // namespace

int cyclic_period(int side) { return side + (side + 3) / 4; }

Rgba make_cyclic(const Rgba& image, bool along_x, bool along_y) {
  check::not_empty("image", image);
  Rgba whole = along_x ? continued_to_the_right(image) : image;
  if (along_y) whole = Rgba(continued_to_the_right(whole.t()).t());
  return whole;
}

}  // namespace stillwater
