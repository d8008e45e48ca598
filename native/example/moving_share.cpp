#include "example/moving_share.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr double finest_sigma = 0.3;  // px: less blurs nothing
constexpr double around = 24;         // px of the clip

template <class Image>
Image blurred(const Image& image, double sigma) {
  if (sigma < finest_sigma) return image.clone();
  Image result;
  cv::GaussianBlur(image, result, cv::Size(), sigma, sigma, cv::BORDER_REFLECT);
  return result;
}

// Adds the square of each band, a channel for each.
void add_squares(const Plane& plane, const Plane& weight, Rgb& squares) {
  Plane finer = plane;
  for (int band = 0; band < share_bands; ++band) {
    const Plane coarser = blurred(plane, share_sigmas[band]);
    parallel_pixels(plane.size(), [&](int y, int x) {
      const float detail = finer(y, x) - coarser(y, x);
      squares(y, x)[band] += weight(y, x) * detail * detail;
    });
    finer = coarser;
  }
}

}  // namespace

Rgb moving_shares(const std::vector<Plane>& differences, const Plane& average, const Plane& energy) {
  Rgb moves(average.size(), cv::Vec3f()), stands(average.size(), cv::Vec3f());
  for (const Plane& difference : differences) add_squares(difference, energy / static_cast<double>(differences.size()), moves);
  add_squares(average, energy, stands);
  moves = blurred(moves, around);
  stands = blurred(stands, around);
  parallel_pixels(moves.size(), [&](int y, int x) {
    for (int band = 0; band < share_bands; ++band) {
      const float all = moves(y, x)[band] + stands(y, x)[band];
      moves(y, x)[band] = all > 0 ? std::clamp(moves(y, x)[band] / all, 0.0f, 1.0f) : 1;
    }
  });
  return moves;
}

Rgb standing_part(const Rgb& difference, const Rgb& shares, double scale) {
  Rgb standing(difference.size(), cv::Vec3f());
  Rgb finer = difference;
  for (int band = 0; band < share_bands; ++band) {
    const Rgb coarser = blurred(difference, scale * share_sigmas[band]);
    parallel_pixels(difference.size(), [&](int y, int x) {
      standing(y, x) += std::sqrt(std::clamp(1 - shares(y, x)[band], 0.0f, 1.0f)) * (finer(y, x) - coarser(y, x));
    });
    finer = coarser;
  }
  return standing;
}

}  // namespace stillwater
