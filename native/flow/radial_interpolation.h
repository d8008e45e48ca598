#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/image.h"

namespace stillwater {

struct RadialOptions {
  double tolerance = 0;    ///< largest distance from a given value that may be left; 0 = all places are met exactly
  int most_centres = 2000;  ///< the work grows with the third power; where that many do not do, the rest is left over
};

/// Scattered values interpolated over the plane by radial basis functions phi(r) = r (Okabe et al. 2009, 5.1):
///
///     f(x) = c - sum_i w_i |x - x_i|,    sum_i w_i = 0,    f(x_i) = v_i
///
/// the kernel, its sign and the constant of scipy's RBFInterpolator(kernel="linear"). (It is the likeliest field where values
/// wander as a Brownian motion along every line: Levy 1948.) The values' columns are interpolated each for itself.
///
/// The system is solved without the constant: with differences from the first place, the matrix |x_i - x_0| + |x_j - x_0| -
/// |x_i - x_j| is positive definite, and its Cholesky factor grows by rows when centres are added. Centres are chosen
/// greedily: evenly spread ones first; then round by round, wherever a value is missed by more than the tolerance, the one
/// missed most between two centres (in the order given: along the strokes); ties take the earliest.
class RadialInterpolation {
 public:
  /// `places`: one or more, no two the same. `values`: a row for each place.
  RadialInterpolation(const std::vector<Point>& places, const Eigen::MatrixXd& values, RadialOptions options = {});

  /// Exact; a row for each place.
  Eigen::MatrixXd at(const std::vector<Point>& places) const;

  const std::vector<Point>& centres() const { return centres_; }
  const Eigen::MatrixXd& weights() const { return weights_; }         ///< a row for each centre
  const Eigen::RowVectorXd& constant() const { return constant_; }

 private:
  template <class Number>
  Eigen::MatrixXd values_at(const std::vector<Point>& places) const;

  std::vector<Point> centres_;
  Eigen::MatrixXd weights_;
  Eigen::RowVectorXd constant_;
};

}  // namespace stillwater
