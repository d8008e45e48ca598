#include "example/moving_share.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stillwater {
namespace {

constexpr double finest_sigma = 0.3;  // px: less blurs nothing

template <class Image>
Image blurred(const Image& image, double sigma) {
  if (sigma < finest_sigma) return image.clone();
  Image result;
  cv::GaussianBlur(image, result, cv::Size(), sigma, sigma, cv::BORDER_REFLECT);
  return result;
}

}  // namespace

MovingShares band_squares(const Plane& plane, const Plane& weight) {
  MovingShares squares{};
  const double all = cv::sum(weight)[0];
  Plane finer = plane;
  for (int band = 0; band < share_bands; ++band) {
    const Plane coarser = blurred(plane, share_sigmas[band]), detail = finer - coarser;
    squares[band] = all > 0 ? cv::sum(detail.mul(detail).mul(weight))[0] / all : 0;
    finer = coarser;
  }
  return squares;
}

Rgb standing_part(const Rgb& difference, const MovingShares& shares, double scale) {
  Rgb standing(difference.size(), cv::Vec3f());
  Rgb finer = difference;
  for (int band = 0; band < share_bands; ++band) {
    const Rgb coarser = blurred(difference, scale * share_sigmas[band]);
    standing += std::sqrt(std::clamp(1 - shares[band], 0.0, 1.0)) * (finer - coarser);
    finer = coarser;
  }
  return standing;
}

}  // namespace stillwater
