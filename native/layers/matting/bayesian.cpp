#include "layers/matting/bayesian.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int pixels_at_once = 64;

using Colour = Eigen::Vector3d;
using ColourImage = cv::Mat_<cv::Vec3d>;

Colour colour_of(const cv::Vec3d& pixel) { return {pixel[0], pixel[1], pixel[2]}; }

struct Solution {
  Colour front = Colour::Zero(), back = Colour::Zero();
  double alpha = 0;
  double likelihood = -std::numeric_limits<double>::infinity();
};

struct Gaussian {
  Colour mean;
  Eigen::Matrix3d inverse;
};

std::vector<Gaussian> gaussians(std::vector<WeightedColour>& colours, const ClusterOptions& options) {
  std::vector<Gaussian> result;
  for (const ColourCluster& cluster : colour_clusters(colours, options))
    result.push_back({cluster.mean, cluster.covariance.inverse()});
  return result;
}

// Eq. 9 and 10 in turn, for one pair of clusters.
Solution solve(const Colour& colour, const Gaussian& front, const Gaussian& back, double alpha,
               const BayesianOptions& options) {
  const double precision = 1 / (options.camera_noise * options.camera_noise);
  Solution best;
  best.alpha = alpha;
  for (int i = 0; i < options.iterations; ++i) {
    const double a = best.alpha, b = 1 - a;
    Eigen::Matrix<double, 6, 6> matrix;
    Eigen::Matrix<double, 6, 1> right;
    const Eigen::Matrix3d both = a * b * precision * Eigen::Matrix3d::Identity();
    matrix << front.inverse + a * a * precision * Eigen::Matrix3d::Identity(), both, both,
        back.inverse + b * b * precision * Eigen::Matrix3d::Identity();
    right << front.inverse * front.mean + a * precision * colour, back.inverse * back.mean + b * precision * colour;
    const Eigen::Matrix<double, 6, 1> mixed = matrix.ldlt().solve(right).cwiseMax(0).cwiseMin(1);
    best.front = mixed.head<3>();
    best.back = mixed.tail<3>();
    const Colour apart = best.front - best.back;
    const double square = apart.squaredNorm();
    if (square > 0) best.alpha = std::clamp((colour - best.back).dot(apart) / square, 0.0, 1.0);
    if (std::abs(best.alpha - a) < options.settled) break;
  }
  const Colour misfit = colour - best.alpha * best.front - (1 - best.alpha) * best.back;
  const Colour off_front = best.front - front.mean, off_back = best.back - back.mean;
  best.likelihood = -misfit.squaredNorm() * precision - off_front.dot(front.inverse * off_front) / 2 -
                    off_back.dot(back.inverse * off_back) / 2;
  return best;
}

class Peel {
 public:
  Peel(const Rgba& picture, const Trimap& trimap, const BayesianOptions& options)
      : options_(options), left_(trimap == known::unknown), alpha_(grey_of(trimap)), picture_(picture.size()) {
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.cols; ++x)
        for (int c = 0; c < 3; ++c) picture_(y, x)[c] = picture(y, x)[c];
    front_ = picture_.clone();
    back_ = picture_.clone();
  }

  Plane matte(const std::function<void(double)>& done) {
    const double all = cv::countNonZero(left_);
    double worked = 0;
    while (true) {
      const std::vector<cv::Point> pixels = contour();
      if (pixels.empty()) return alpha_;
      std::vector<Solution> solutions(pixels.size());
      parallel_rows(static_cast<int>(pixels.size()), pixels_at_once, [&](int first, int last) {
        for (int i = first; i < last; ++i) solutions[i] = solve_at(pixels[i]);
      });
      for (size_t i = 0; i < pixels.size(); ++i) {
        const Solution& s = solutions[i];
        front_(pixels[i]) = {s.front[0], s.front[1], s.front[2]};
        back_(pixels[i]) = {s.back[0], s.back[1], s.back[2]};
        alpha_(pixels[i]) = static_cast<float>(s.alpha);
        left_(pixels[i]) = 0;
      }
      done((worked += static_cast<double>(pixels.size())) / all);
    }
  }

 private:
  // The pixels left that touch one that is known, or was found before.
  std::vector<cv::Point> contour() const {
    cv::Mat inner;
    cv::erode(left_, inner, cv::Mat::ones(3, 3, CV_8U), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(255));
    std::vector<cv::Point> pixels;
    cv::findNonZero(left_ & ~inner, pixels);
    return pixels;
  }

  // Colours around a pixel, weighted; and their mean alpha.
  double gather(const cv::Point& centre, int radius, std::vector<WeightedColour>& front,
                std::vector<WeightedColour>& back) const {
    front.clear();
    back.clear();
    const double narrow = -1 / (2 * options_.sigma * options_.sigma);
    double sum = 0, weights = 0;
    for (int y = std::max(0, centre.y - radius); y <= std::min(left_.rows - 1, centre.y + radius); ++y)
      for (int x = std::max(0, centre.x - radius); x <= std::min(left_.cols - 1, centre.x + radius); ++x) {
        const int dx = x - centre.x, dy = y - centre.y, square = dx * dx + dy * dy;
        if (left_(y, x) || square > radius * radius) continue;
        const double a = alpha_(y, x), g = std::exp(narrow * square);
        sum += g * a;
        weights += g;
        if (a > 0) front.push_back({colour_of(front_(y, x)), a * a * g});
        if (a < 1) back.push_back({colour_of(back_(y, x)), (1 - a) * (1 - a) * g});
      }
    return weights > 0 ? sum / weights : 0.5;
  }

  Solution solve_at(const cv::Point& pixel) const {
    std::vector<WeightedColour> fronts, backs;
    const int largest = std::max(left_.cols, left_.rows);
    const auto least = static_cast<size_t>(options_.least);
    double alpha = 0.5;
    for (int radius = options_.radius;; radius += radius / 2 + 1) {
      alpha = gather(pixel, radius, fronts, backs);
      if (radius > largest || (fronts.size() >= least && backs.size() >= least)) break;
    }
    Solution best;
    const std::vector<Gaussian> front = gaussians(fronts, options_.clusters),
                                back = gaussians(backs, options_.clusters);
    for (const Gaussian& f : front)
      for (const Gaussian& b : back) {
        const Solution found = solve(colour_of(picture_(pixel)), f, b, alpha, options_);
        if (found.likelihood > best.likelihood) best = found;
      }
    return best;
  }

  const BayesianOptions options_;
  cv::Mat_<unsigned char> left_;
  Plane alpha_;
  ColourImage picture_, front_, back_;
};

}  // namespace

Plane bayesian_matte(const Rgba& picture, const Trimap& trimap, const BayesianOptions& options,
                     const std::function<void(double)>& done) {
  return Peel(picture, trimap, options).matte(done);
}

}  // namespace stillwater
