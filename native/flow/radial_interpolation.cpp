#include "flow/radial_interpolation.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int first_centres = 96;
constexpr int grain = 256;                // places
constexpr double steps_of_tolerance = 1024;  // misses are compared in whole numbers of these

double distance(const Point& a, const Point& b) {
  const double x = a.x - b.x, y = a.y - b.y;
  return std::sqrt(x * x + y * y);
}

/// The system of the centres so far: its Cholesky factor, and its right-hand side solved half way (L z = v - v_0).
class GrowingSystem {
 public:
  GrowingSystem(const std::vector<Point>& places, const Eigen::MatrixXd& values) : places_(places), values_(values) {}

  /// Places by number; the very first one given is what differences are taken from.
  void add(const std::vector<int>& chosen) {
    auto next = chosen.begin();
    if (chosen_.empty()) chosen_.push_back(*next++);
    const Eigen::Index old = static_cast<Eigen::Index>(chosen_.size()) - 1;
    chosen_.insert(chosen_.end(), next, chosen.end());
    const Eigen::Index now = static_cast<Eigen::Index>(chosen_.size()) - 1, added = now - old;
    if (added == 0) return;

    factor_.conservativeResize(now, now);
    half_solved_.conservativeResize(now, values_.cols());
    auto right = half_solved_.bottomRows(added);
    for (Eigen::Index i = 0; i < added; ++i) {
      for (Eigen::Index j = 0; j <= old + i; ++j) factor_(old + i, j) = covariance(old + i, j);
      right.row(i) = values_.row(chosen_[old + i + 1]) - values_.row(chosen_[0]);
    }
    auto corner = factor_.bottomRightCorner(added, added);
    if (old > 0) {
      auto side = factor_.bottomLeftCorner(added, old);
      const auto before = factor_.topLeftCorner(old, old).triangularView<Eigen::Lower>();
      Eigen::MatrixXd turned = side.transpose();
      before.solveInPlace(turned);
      side = turned.transpose();
      corner.selfadjointView<Eigen::Lower>().rankUpdate(side, -1.0);
      right.noalias() -= side * half_solved_.topRows(old);
    }
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> corner_factor(corner);
    corner.triangularView<Eigen::Lower>().solveInPlace(right);
  }

  const std::vector<int>& chosen() const { return chosen_; }

  /// A row for each centre; their sum is 0.
  Eigen::MatrixXd weights() const {
    const Eigen::Index count = static_cast<Eigen::Index>(chosen_.size());
    Eigen::MatrixXd weights(count, values_.cols());
    if (count > 1) {
      Eigen::MatrixXd rest = half_solved_;
      factor_.triangularView<Eigen::Lower>().transpose().solveInPlace(rest);
      weights.bottomRows(count - 1) = rest;
      weights.row(0) = -rest.colwise().sum();
    } else {
      weights.setZero();
    }
    return weights;
  }

 private:
  double covariance(Eigen::Index i, Eigen::Index j) const {
    const Point &a = places_[chosen_[i + 1]], &b = places_[chosen_[j + 1]], &origin = places_[chosen_[0]];
    return distance(a, origin) + distance(b, origin) - distance(a, b);
  }

  const std::vector<Point>& places_;
  const Eigen::MatrixXd& values_;
  std::vector<int> chosen_;
  Eigen::MatrixXd factor_, half_solved_;
};

/// Places evenly spread over the order given.
std::vector<int> spread(int places, int wanted) {
  std::vector<int> chosen;
  for (int i = 0; i < wanted; ++i) chosen.push_back(static_cast<int>(static_cast<long long>(i) * places / wanted));
  return chosen;
}

/// Of each run between two centres the place that is missed most, if by more than the tolerance; at most `most`, those
/// missed most.
std::vector<int> missed_most(const Eigen::VectorXd& misses, std::vector<int> chosen, double tolerance, int most) {
  struct Missed {
    long long steps;
    int place;
  };
  std::vector<Missed> missed;
  std::sort(chosen.begin(), chosen.end());
  chosen.push_back(static_cast<int>(misses.size()));
  int first = 0;
  for (const int last : chosen) {
    Missed worst{static_cast<long long>(steps_of_tolerance), -1};
    for (int i = first; i < last; ++i) {
      const auto steps = static_cast<long long>(misses[i] / tolerance * steps_of_tolerance);
      if (steps > worst.steps) worst = {steps, i};
    }
    if (worst.place >= 0) missed.push_back(worst);
    first = last + 1;
  }
  std::stable_sort(missed.begin(), missed.end(), [](const Missed& a, const Missed& b) { return a.steps > b.steps; });
  missed.resize(std::min<std::size_t>(missed.size(), most));
  std::vector<int> places;
  for (const Missed& one : missed) places.push_back(one.place);
  std::sort(places.begin(), places.end());
  return places;
}

}  // namespace

RadialInterpolation::RadialInterpolation(const std::vector<Point>& places, const Eigen::MatrixXd& values,
                                         RadialOptions options) {
  const int count = static_cast<int>(places.size());
  const bool all = options.tolerance <= 0;
  GrowingSystem system(places, values);
  std::vector<int> next = spread(count, all ? count : std::min({count, first_centres, options.most_centres}));
  while (!next.empty()) {
    system.add(next);
    centres_.clear();
    for (const int chosen : system.chosen()) centres_.push_back(places[chosen]);
    weights_ = system.weights();
    constant_ = values.row(system.chosen()[0]);
    for (std::size_t i = 0; i < centres_.size(); ++i) constant_ += weights_.row(i) * distance(centres_[i], centres_[0]);
    const int more = options.most_centres - static_cast<int>(centres_.size());
    if (all || more <= 0) return;
    const Eigen::VectorXd misses = (values_at<float>(places) - values).rowwise().norm();
    next = missed_most(misses, system.chosen(), options.tolerance, more);
  }
}

/// Distances are taken in `Number`.
template <class Number>
Eigen::MatrixXd RadialInterpolation::values_at(const std::vector<Point>& places) const {
  const int count = static_cast<int>(places.size());
  const Eigen::Index columns = weights_.cols();
  Eigen::MatrixXd values(count, columns);
  parallel_rows(count, grain, [&](int first, int last) {
    const int some = last - first;
    std::vector<Number> x(some), y(some), apart(some);
    for (int i = 0; i < some; ++i) x[i] = static_cast<Number>(places[first + i].x), y[i] = static_cast<Number>(places[first + i].y);
    for (Eigen::Index c = 0; c < columns; ++c)
      for (int i = 0; i < some; ++i) values(first + i, c) = constant_[c];
    for (std::size_t k = 0; k < centres_.size(); ++k) {
      const auto at_x = static_cast<Number>(centres_[k].x), at_y = static_cast<Number>(centres_[k].y);
      for (int i = 0; i < some; ++i) {
        const Number dx = x[i] - at_x, dy = y[i] - at_y;
        apart[i] = std::sqrt(dx * dx + dy * dy);
      }
      for (Eigen::Index c = 0; c < columns; ++c) {
        const double weight = weights_(k, c);
        double* out = &values(first, c);
        for (int i = 0; i < some; ++i) out[i] -= weight * apart[i];
      }
    }
  });
  return values;
}

Eigen::MatrixXd RadialInterpolation::at(const std::vector<Point>& places) const { return values_at<double>(places); }

}  // namespace stillwater
