#include "layers/colour_prior.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int grain = 16;
constexpr int radius = 2;
// Keeps the colours' covariance invertible (colour squared).
constexpr double flat = 1e-5;

// How much of alpha's variance around a pixel no affine function of colour explains.
double roughness_at(const Rgba& picture, const Plane& alpha, int y, int x) {
  Eigen::Vector3d colour_sum = Eigen::Vector3d::Zero(), both = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  double alpha_sum = 0, alpha_square = 0;
  int count = 0;
  for (int ny = std::max(0, y - radius); ny <= std::min(picture.rows - 1, y + radius); ++ny)
    for (int nx = std::max(0, x - radius); nx <= std::min(picture.cols - 1, x + radius); ++nx) {
      const cv::Vec4f& pixel = picture(ny, nx);
      const Eigen::Vector3d colour(pixel[0], pixel[1], pixel[2]);
      const double a = alpha(ny, nx);
      colour_sum += colour;
      both += a * colour;
      square += colour * colour.transpose();
      alpha_sum += a;
      alpha_square += a * a;
      ++count;
    }
  const Eigen::Vector3d mean = colour_sum / count;
  const double alpha_mean = alpha_sum / count;
  const Eigen::Matrix3d covariance = square / count - mean * mean.transpose() + flat * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d slope_by = both / count - alpha_mean * mean;
  const double variance = alpha_square / count - alpha_mean * alpha_mean;
  return std::max(0.0, variance - slope_by.dot(covariance.ldlt().solve(slope_by)));
}

double distance_between(const cv::Vec4f& a, const cv::Vec4f& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// How far known pixels around each unknown one can speak for its colours, 0..1: in a box three times as wide as the
// distance to both kinds, a share of `crowd` must be known, of either kind.
Plane trust_in_known(const Trimap& trimap, double crowd) {
  Plane trust = Plane::zeros(trimap.size());
  std::array<cv::Mat_<int>, 2> sums;
  std::array<Plane, 2> distances;
  for (const int kind : {0, 1}) {
    const cv::Mat here = trimap == (kind ? known::foreground : known::background);
    cv::integral(here / 255, sums[kind], CV_32S);
    cv::distanceTransform(~here, distances[kind], cv::DIST_L2, cv::DIST_MASK_PRECISE);
  }
  parallel_rows(trimap.rows, grain, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < trimap.cols; ++x) {
        if (trimap(y, x) != known::unknown) continue;
        const int reach = static_cast<int>(3 * std::max(distances[0](y, x), distances[1](y, x))) + 2;
        const int top = std::max(0, y - reach), bottom = std::min(trimap.rows, y + reach + 1);
        const int left = std::max(0, x - reach), right = std::min(trimap.cols, x + reach + 1);
        int least = std::numeric_limits<int>::max();
        for (const auto& sum : sums)
          least = std::min(least, sum(bottom, right) - sum(top, right) - sum(bottom, left) + sum(top, left));
        const double share = least / (static_cast<double>(bottom - top) * (right - left));
        trust(y, x) = static_cast<float>(std::clamp(2 * share / crowd - 1, 0.0, 1.0));
      }
  });
  return trust;
}

}  // namespace

MattePrior colour_prior(const Rgba& picture, const Trimap& trimap, const ColourPriorOptions& options) {
  const Plane trust = trust_in_known(trimap, options.crowd);
  const ColourSamples samples = sample_colours(picture, trimap, cv::Mat_<unsigned char>(trust > 0), options.samples);
  MattePrior prior{grey_of(trimap), Plane::zeros(trimap.size())};
  const auto each_sampled = [&](const auto& work) {
    parallel_rows(trimap.rows, grain, [&](int first, int last) {
      for (int y = first; y < last; ++y)
        for (int x = 0; x < trimap.cols; ++x)
          if (samples.foreground(y, x)[3] > 0) work(y, x);
    });
  };
  each_sampled([&](int y, int x) {
    prior.alpha(y, x) = best_mix(picture(y, x), samples.foreground(y, x), samples.background(y, x));
  });
  each_sampled([&](int y, int x) {
    const double apart = distance_between(samples.foreground(y, x), samples.background(y, x)) / options.separation;
    const double fits = std::exp(-samples.misfit(y, x) / options.misfit);
    const double smooth = std::exp(-roughness_at(picture, prior.alpha, y, x) / options.roughness);
    prior.weight(y, x) = static_cast<float>(options.weight * std::min(1.0, apart * apart) * fits * smooth * trust(y, x));
  });
  return prior;
}

}  // namespace stillwater
