#include "layers/matting/colour_prior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/parallel.h"
#include "layers/matting/affine_alpha.h"

namespace stillwater {
namespace {

constexpr int grain = 16;
constexpr int radius = 2;
// Keeps the colours' covariance invertible (colour squared).
constexpr double flat = 1e-5;
// Less confidence than this is none.
constexpr double negligible = 1e-3;

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

MattePrior colour_prior(const Rgba& picture, const Trimap& trimap, const ColourPriorOptions& options,
                        const std::function<void(double)>& done) {
  const Plane trust = trust_in_known(trimap, options.crowd);
  const cv::Mat_<unsigned char> trusted_at(trust > 0);
  const ColourSamples samples = sample_colours(picture, trimap, trusted_at, options.samples, done);
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
    const double trusted = std::min(1.0, apart * apart) * fits * trust(y, x);
    if (trusted < negligible) return;
    const double rough = fit_affine_alpha(picture, prior.alpha, {x, y}, radius, flat).rest;
    prior.weight(y, x) = static_cast<float>(options.weight * trusted * std::exp(-rough / options.roughness));
  });
  return prior;
}

}  // namespace stillwater
