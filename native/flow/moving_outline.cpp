#include "flow/moving_outline.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr double widest_exponent = 16;  // and 1 / 16
constexpr int halvings = 24;            // of the exponents between, as ratios

float sampled(const Plane& plane, float x, float y) {
  x = std::clamp(x, 0.0f, static_cast<float>(plane.cols - 1));
  y = std::clamp(y, 0.0f, static_cast<float>(plane.rows - 1));
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, plane.cols - 1), bottom = std::min(top + 1, plane.rows - 1);
  const float across = x - static_cast<float>(left), down = y - static_cast<float>(top);
  const float above = plane(top, left) + across * (plane(top, right) - plane(top, left));
  const float below = plane(bottom, left) + across * (plane(bottom, right) - plane(bottom, left));
  return above + down * (below - above);
}

Plane carried(const Plane& outline, const Plane& matte, const Field& motion, float persistence) {
  Plane next(outline.size());
  parallel_pixels(next.size(), [&](int y, int x) {
    const cv::Vec2f way = motion(y, x);
    const float before = sampled(outline, static_cast<float>(x) - way[0], static_cast<float>(y) - way[1]);
    next(y, x) = persistence * before + (1 - persistence) * matte(y, x);
  });
  return next;
}

// The soft places of a plane, and how many are covered altogether. Sums are taken in the order of the rows.
class Softness {
 public:
  explicit Softness(const Plane& plane) {
    for (const float coverage : plane) {
      if (coverage >= 1) ++covered_;
      else if (coverage > 0) logarithms_.push_back(std::log(coverage));
    }
  }

  double area(double exponent) const {
    double sum = 0;
    for (const float logarithm : logarithms_) sum += std::exp(exponent * logarithm);
    return covered_ + sum;
  }

  // The exponent with which the plane has this area, as near as there is one.
  double exponent_for(double wanted) const {
    double low = 1 / widest_exponent, high = widest_exponent;
    for (int i = 0; i < halvings; ++i) {
      const double middle = std::sqrt(low * high);
      (area(middle) > wanted ? low : high) = middle;
    }
    return std::sqrt(low * high);
  }

 private:
  double covered_ = 0;
  std::vector<float> logarithms_;
};

}  // namespace

Plane moved_outline(const Plane& outline, const Plane& matte, const Field& motion, double persistence) {
  check::not_empty("outline", outline);
  check::same_size("matte", matte, "outline", outline);
  check::same_size("motion", motion, "outline", outline);
  check::each_in_range("outline", outline, 0, 1);
  check::each_in_range("matte", matte, 0, 1);
  check::in_range("persistence", persistence, 0, 1);
  if (!cv::checkRange(motion)) throw BadInput("motion: not finite everywhere");
  Plane next = carried(outline, matte, motion, static_cast<float>(persistence));
  const double exponent = Softness(next).exponent_for(cv::sum(matte)[0]);
  parallel_pixels(next.size(), [&](int y, int x) {
    float& coverage = next(y, x);
    if (coverage > 0 && coverage < 1) coverage = static_cast<float>(std::pow(static_cast<double>(coverage), exponent));
    coverage = std::clamp(coverage, 0.0f, 1.0f);
  });
  return next;
}

}  // namespace stillwater
