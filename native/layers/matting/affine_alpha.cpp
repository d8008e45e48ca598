#include "layers/matting/affine_alpha.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace stillwater {

AffineAlpha fit_affine_alpha(const Rgba& picture, const Plane& alpha, const cv::Point& pixel, int radius,
                             double ridge) {
  Eigen::Vector3d colours = Eigen::Vector3d::Zero(), both = Eigen::Vector3d::Zero();
  double rr = 0, rg = 0, rb = 0, gg = 0, gb = 0, bb = 0, alphas = 0, alpha_squares = 0;
  int count = 0;
  for (int y = std::max(0, pixel.y - radius); y <= std::min(picture.rows - 1, pixel.y + radius); ++y)
    for (int x = std::max(0, pixel.x - radius); x <= std::min(picture.cols - 1, pixel.x + radius); ++x, ++count) {
      const cv::Vec4f& here = picture(y, x);
      const double r = here[0], g = here[1], b = here[2], a = alpha(y, x);
      colours += Eigen::Vector3d(r, g, b);
      both += a * Eigen::Vector3d(r, g, b);
      rr += r * r, rg += r * g, rb += r * b;
      gg += g * g, gb += g * b, bb += b * b;
      alphas += a;
      alpha_squares += a * a;
    }
  Eigen::Matrix3d squares;
  squares << rr, rg, rb, rg, gg, gb, rb, gb, bb;
  const Eigen::Vector3d mean = colours / count;
  const double mean_alpha = alphas / count;
  const Eigen::Matrix3d covariance = squares / count - mean * mean.transpose() + ridge * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d together = both / count - mean_alpha * mean;
  const Eigen::Vector3d slope = covariance.llt().solve(together);
  const double variance = alpha_squares / count - mean_alpha * mean_alpha;
  return {{slope[0], slope[1], slope[2]}, mean_alpha - slope.dot(mean), std::max(0.0, variance - together.dot(slope))};
}

}  // namespace stillwater
