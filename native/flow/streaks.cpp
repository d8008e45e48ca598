#include "flow/streaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"

namespace stillwater {
namespace {

constexpr int steps = 12;  // each way
constexpr double most_pixels = 640 * 400;
constexpr double usual_fast = 0.95;   // of what moves
constexpr float least_share = 0.02f;  // of that speed; what is slower stands still
constexpr float clear_share = 0.25f;  // from here on streaks are at their clearest
constexpr float largest_root = 1.4f;  // of speed over the usual fast one
constexpr double steepness = 1.3;     // of the tone, in standard deviations

struct Kernel {
  std::array<float, steps + 1> window, cosine, sine;  // at 0, 1/steps, ..., 1
};

Kernel make_kernel() {
  Kernel kernel;
  for (int j = 0; j <= steps; ++j) {
    const double t = static_cast<double>(j) / steps, wave = 2 * std::numbers::pi * t;
    const double window = std::pow(std::cos(std::numbers::pi * t / 2), 2);
    kernel.window[j] = static_cast<float>(window);
    kernel.cosine[j] = static_cast<float>(window * std::cos(wave));
    kernel.sine[j] = static_cast<float>(window * std::sin(wave));
  }
  return kernel;
}

/// The standard deviation of the sum for noise of variance 1, in the mean over the phases.
double deviation(const Kernel& kernel) {
  double square = 0;
  for (int j = 0; j <= steps; ++j) {
    const double both = j == 0 ? 1 : 2;
    square += both * (kernel.window[j] * kernel.window[j] * 1.5) / 4;
  }
  return std::sqrt(square);
}

cv::Size working_size(cv::Size size) {
  const double scale = std::min(1.0, std::sqrt(most_pixels / size.area()));
  return {std::max(1, static_cast<int>(size.width * scale)), std::max(1, static_cast<int>(size.height * scale))};
}

Plane noise(cv::Size size, std::uint64_t seed) {
  Plane plane(size);
  const auto root = static_cast<float>(std::sqrt(12.0));
  parallel_pixels(size, [&](int y, int x) { plane(y, x) = root * static_cast<float>(random_uniform(seed, {x, y, 0}) - 0.5); });
  return plane;
}

/// The speed that a share of what moves does not pass; 0 where nothing moves.
float fast_speed(const Field& flow) {
  std::vector<float> speeds;
  for (const cv::Vec2f& v : flow)
    if (const float speed = std::sqrt(v.dot(v)); speed > 1e-6f) speeds.push_back(speed);
  if (speeds.empty()) return 0;
  const auto nth = speeds.begin() + static_cast<std::ptrdiff_t>(usual_fast * (speeds.size() - 1));
  std::nth_element(speeds.begin(), nth, speeds.end());
  return *nth;
}

void check_flow(const Field& flow) {
  check::not_empty("flow", flow);
  check::size("flow", flow.cols, flow.rows);
  for (int y = 0; y < flow.rows; ++y)
    for (int x = 0; x < flow.cols; ++x)
      if (!std::isfinite(flow(y, x)[0]) || !std::isfinite(flow(y, x)[1]))
        throw BadInput("flow[" + std::to_string(y) + ", " + std::to_string(x) + "]: a vector is not finite numbers");
}

float smooth_step(float t) {
  const float x = std::clamp(t, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

/// The three sums along one streamline, one way (`way` 1 downstream, -1 up), without its middle.
void follow(const Field& step, const Plane& grain, const Kernel& kernel, int y, int x, float way, float* sums) {
  float at_x = static_cast<float>(x) + 0.5f, at_y = static_cast<float>(y) + 0.5f;
  cv::Vec2f by = step(y, x);
  for (int j = 1; j <= steps; ++j) {
    at_x += way * by[0];
    at_y += way * by[1];
    if (!(at_x >= 0 && at_y >= 0 && at_x < static_cast<float>(step.cols) && at_y < static_cast<float>(step.rows))) return;
    const int u = static_cast<int>(at_x), v = static_cast<int>(at_y);
    const float value = grain(v, u);
    sums[0] += kernel.window[j] * value;
    sums[1] += kernel.cosine[j] * value;
    sums[2] += way * kernel.sine[j] * value;
    by = step(v, u);
  }
}

}  // namespace

Streaks::Streaks(const Field& flow, const StreakParameters& parameters) : size_(flow.size()) {
  check_flow(flow);
  check::in_range("length", parameters.length, 0.001, 0.5);
  check::in_range("strength", parameters.strength, 0, 1);
  const cv::Size work = working_size(flow.size());
  Field step;
  if (work == flow.size()) step = flow.clone();
  else cv::resize(flow, step, work, 0, 0, cv::INTER_AREA);
  const float fast = fast_speed(step);
  const auto longest = static_cast<float>(parameters.length * std::hypot(work.width, work.height) / 2 / steps);
  opacity_ = Plane::zeros(work);
  parallel_pixels(work, [&](int y, int x) {
    cv::Vec2f& v = step(y, x);
    const float speed = std::sqrt(v.dot(v));
    if (!(speed > least_share * fast) || speed <= 0) {
      v = {};
      return;
    }
    const float share = speed / fast;
    opacity_(y, x) = static_cast<float>(parameters.strength) * smooth_step((share - least_share) / (clear_share - least_share));
    v *= longest * std::min(largest_root, std::sqrt(share)) / speed;
  });

  static const Kernel kernel = make_kernel();
  const auto scale = static_cast<float>(0.5 * steepness / deviation(kernel));
  const Plane grain = noise(work, parameters.seed);
  steady_ = Plane(work);
  cosine_ = Plane(work);
  sine_ = Plane(work);
  parallel_pixels(work, [&](int y, int x) {
    const float middle = grain(y, x);
    float sums[3] = {middle, middle, 0};
    if (opacity_(y, x) > 0)
      for (const float way : {1.0f, -1.0f}) follow(step, grain, kernel, y, x, way, sums);
    steady_(y, x) = scale * sums[0];
    cosine_(y, x) = scale * sums[1];
    sine_(y, x) = scale * sums[2];
  });
}

Rgba Streaks::at(double phase, cv::Size size) const {
  check::finite("phase", phase);
  check::size("size", size.width, size.height);
  const double turn = 2 * std::numbers::pi * (phase - std::floor(phase));
  const auto cosine = static_cast<float>(std::cos(turn)), sine = static_cast<float>(std::sin(turn));
  Plane tone(steady_.size());  // signed: light above 0
  parallel_pixels(tone.size(), [&](int y, int x) {
    const float value = steady_(y, x) + cosine * cosine_(y, x) - sine * sine_(y, x);
    tone(y, x) = opacity_(y, x) * value / std::sqrt(1 + value * value);
  });
  if (size != tone.size()) {
    Plane sized;
    cv::resize(tone, sized, size, 0, 0, cv::INTER_LINEAR);
    tone = sized;
  }
  Rgba overlay(size);
  parallel_pixels(size, [&](int y, int x) {
    const float light = std::max(0.0f, tone(y, x));
    overlay(y, x) = {light, light, light, std::abs(tone(y, x))};
  });
  return overlay;
}

}  // namespace stillwater
