#include "layers/inpainting/blend_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int most_rounds = 400;
constexpr double good_enough = 1e-4;  // of the residual at the start
constexpr int grain = 4096;

using Pixels = std::vector<cv::Vec4f>;
using Sums = std::array<double, 4>;

float squared(const cv::Vec4f& v) { return v.dot(v); }

const std::array<cv::Point, 4> steps{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

// To an unknown of the equation, or to none.
struct Link {
  int to = -1;
  float weight = 0;
};

class Equation {
 public:
  Equation(const ShiftMap& shifts, const Mask& hole, const Rgba& colour, const BlendParameters& parameters)
      : parameters_(parameters), size_(hole.size()), number_(size_, -1) {
    for (int y = 0; y < size_.height; ++y)
      for (int x = 0; x < size_.width; ++x)
        if (hole(y, x)) number_(y, x) = static_cast<int>(places_.size()), places_.push_back({x, y});
    neighbours_.resize(places_.size());
    diagonal_.resize(places_.size());
    right_.resize(places_.size());
    each([&](int i) { describe(i, shifts, hole, colour); });
  }

  // Begins with the copies, and brings `colour` to the solution.
  void solve(Rgba& colour, const std::function<void(double)>& at) const {
    const int count = static_cast<int>(places_.size());
    Pixels u(places_.size()), residual(places_.size()), direction(places_.size()), image(places_.size());
    each([&](int i) { u[i] = colour(places_[i]); });
    apply(u, image);
    each([&](int i) {
      residual[i] = right_[i] - image[i];
      direction[i] = residual[i] * (1 / diagonal_[i]);
    });
    Sums error = product(residual, direction), start = error;
    for (int round = 0; round < most_rounds; ++round) {
      bool done = true;
      for (int c = 0; c < 4; ++c) done = done && error[c] <= good_enough * good_enough * start[c] + 1e-12 * count;
      if (done) break;
      apply(direction, image);
      const Sums curve = product(direction, image);
      cv::Vec4f step, turn;
      for (int c = 0; c < 4; ++c) step[c] = curve[c] > 0 ? static_cast<float>(error[c] / curve[c]) : 0.0f;
      each([&](int i) {
        u[i] += step.mul(direction[i]);
        residual[i] -= step.mul(image[i]);
        image[i] = residual[i] * (1 / diagonal_[i]);
      });
      const Sums next = product(residual, image);
      for (int c = 0; c < 4; ++c) turn[c] = error[c] > 0 ? static_cast<float>(next[c] / error[c]) : 0.0f;
      error = next;
      each([&](int i) { direction[i] = image[i] + turn.mul(direction[i]); });
      if (at) at(static_cast<double>(round) / most_rounds);
    }
    each([&](int i) { colour(places_[i]) = u[i]; });
  }

 private:
  template <class Work>
  void each(const Work& work) const {
    parallel_rows(static_cast<int>(places_.size()), grain, [&](int first, int last) {
      for (int i = first; i < last; ++i) work(i);
    });
  }

  void describe(int i, const ShiftMap& shifts, const Mask& hole, const Rgba& colour) {
    const cv::Rect inside(cv::Point(), size_);
    const cv::Point p = places_[i], ours = shift(shifts, p);
    cv::Vec4f right = parameters_.screen * colour(p);
    float diagonal = parameters_.screen;
    for (size_t k = 0; k < steps.size(); ++k) {
      const cv::Point q = p + steps[k];
      neighbours_[i][k] = {};
      if (!inside.contains(q)) continue;
      const bool open = hole(q) != 0;
      const cv::Point theirs = open ? shift(shifts, q) : cv::Point();
      // The change from p to q, by our shift and, where q is filled, by theirs; and how unlike they are.
      cv::Vec4f change(0, 0, 0, 0);
      int views = 0;
      float unlike = 0;
      if (seen(q + ours, hole)) {
        change += colour(q + ours) - colour(p + ours), ++views;
        unlike = std::max(unlike, squared(colour(q + ours) - colour(q)));
      }
      if (open && seen(p + theirs, hole)) {
        change += colour(q + theirs) - colour(p + theirs), ++views;
        unlike = std::max(unlike, squared(colour(p + theirs) - colour(p)));
      }
      if (views == 0) unlike = squared(colour(q) - colour(p)), views = 1;  // nothing is known of the change
      if (!open)
        for (int c = 0; c < 4; ++c) change[c] = std::clamp(change[c], -parameters_.steepest, parameters_.steepest);
      const float weight =
          (open ? 1 : parameters_.border) * parameters_.step_of_tone / (parameters_.step_of_tone + unlike);
      right -= change * (weight / static_cast<float>(views));
      diagonal += weight;
      if (open)
        neighbours_[i][k] = {number_(q), weight};
      else
        right += weight * colour(q);
    }
    right_[i] = right;
    diagonal_[i] = diagonal;
  }

  static cv::Point shift(const ShiftMap& shifts, const cv::Point& p) { return {shifts(p)[0], shifts(p)[1]}; }

  bool seen(const cv::Point& p, const Mask& hole) const { return cv::Rect(cv::Point(), size_).contains(p) && !hole(p); }

  void apply(const Pixels& from, Pixels& to) const {
    each([&](int i) {
      cv::Vec4f sum = diagonal_[i] * from[i];
      for (const Link& link : neighbours_[i])
        if (link.to >= 0) sum -= link.weight * from[link.to];
      to[i] = sum;
    });
  }

  // In a fixed order.
  Sums product(const Pixels& a, const Pixels& b) const {
    const int count = static_cast<int>(places_.size());
    std::vector<Sums> parts((count + grain - 1) / grain);
    parallel_rows(count, grain, [&](int first, int last) {
      Sums sum{};
      for (int i = first; i < last; ++i)
        for (int c = 0; c < 4; ++c) sum[c] += static_cast<double>(a[i][c]) * b[i][c];
      parts[first / grain] = sum;
    });
    Sums all{};
    for (const Sums& part : parts)
      for (int c = 0; c < 4; ++c) all[c] += part[c];
    return all;
  }

  BlendParameters parameters_;
  cv::Size size_;
  cv::Mat_<int> number_;
  std::vector<cv::Point> places_;
  std::vector<std::array<Link, 4>> neighbours_;
  std::vector<float> diagonal_;
  Pixels right_;
};

}  // namespace

void blend_seams(const ShiftMap& shifts, const Mask& hole, Rgba& colour, const BlendParameters& parameters,
                 const std::function<void(double)>& at) {
  const Rgba copies = colour.clone();
  Equation(shifts, hole, colour, parameters).solve(colour, at);
  for (int y = 0; y < hole.rows; ++y)
    for (int x = 0; x < hole.cols; ++x) {
      if (!hole(y, x)) continue;
      cv::Vec4f& pixel = colour(y, x);
      const cv::Vec4f& copy = copies(y, x);
      pixel[3] = std::clamp(pixel[3], 0.0f, 1.0f);
      for (int c = 0; c < 3; ++c) pixel[c] = std::clamp(pixel[c], std::min(0.0f, copy[c]), std::max(pixel[3], copy[c]));
    }
}

}  // namespace stillwater
