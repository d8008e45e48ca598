#include "flow/streaks.h"

#include <algorithm>
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

constexpr int fewest_steps = 8;
constexpr double most_pixels = 600 * 360;
constexpr double density = 1.0 / 72;  // seeds a pixel
constexpr double usual_fast = 0.95;   // of what moves
constexpr float least_share = 0.02f;  // of that speed; what is slower stands still
constexpr float clear_share = 0.25f;  // from here on streaks are at their clearest
constexpr float largest_root = 1.2f;  // of speed over the usual fast one
constexpr float contrast = 2.2f;

/// The window, alone and times e^(i pi t), at t = 0, 1/steps, ..., 1.
struct Kernel {
  int steps;
  std::vector<float> window, cosine, sine;
};

Kernel make_kernel(int steps) {
  Kernel kernel{steps, std::vector<float>(steps + 1), std::vector<float>(steps + 1), std::vector<float>(steps + 1)};
  for (int j = 0; j <= steps; ++j) {
    const double t = static_cast<double>(j) / steps, wave = std::numbers::pi * t;
    const double window = std::pow(std::cos(wave / 2), 2) / 2;
    kernel.window[j] = static_cast<float>(window);
    kernel.cosine[j] = static_cast<float>(window * std::cos(wave));
    kernel.sine[j] = static_cast<float>(window * std::sin(wave));
  }
  return kernel;
}

cv::Size working_size(cv::Size size) {
  const double scale = std::min(1.0, std::sqrt(most_pixels / size.area()));
  return {std::max(1, static_cast<int>(size.width * scale)), std::max(1, static_cast<int>(size.height * scale))};
}

using Seeds = cv::Mat_<cv::Vec3f>;  // a seed's colour (1 or -1), and that times its phase's cosine and sine

Seeds sow(cv::Size size, std::uint64_t seed) {
  Seeds seeds(size), soft;
  parallel_pixels(size, [&](int y, int x) {
    const double drawn = random_uniform(seed, {x, y, 0});
    seeds(y, x) = {};
    if (drawn >= density) return;
    const auto colour = drawn < density / 2 ? 1.0f : -1.0f;
    const double phase = 2 * std::numbers::pi * random_uniform(seed, {x, y, 1});
    seeds(y, x) = {colour, colour * static_cast<float>(std::cos(phase)), colour * static_cast<float>(std::sin(phase))};
  });
  cv::sepFilter2D(seeds, soft, CV_32F, cv::Vec3f(0.3f, 1, 0.3f), cv::Vec3f(0.3f, 1, 0.3f));
  return soft;
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

/// The three sums of a place on a streamline: the steady one, and the moving one at phases 0 and a quarter.
struct Sums {
  float steady = 0, cosine = 0, sine = 0;

  void add(const Kernel& kernel, int j, float way, const cv::Vec3f& seed) {
    const float sine_here = way * kernel.sine[j];
    steady += kernel.window[j] * seed[0];
    cosine += kernel.cosine[j] * seed[1] - sine_here * seed[2];
    sine += sine_here * seed[1] + kernel.cosine[j] * seed[2];
  }
};

/// A place that goes along a streamline.
struct Walker {
  float x, y, way;  ///< index coordinates + 0.5; 1 downstream, -1 up
  cv::Vec2f by;
  bool inside = true;

  void step(const Field& steps_of, const Seeds& seeds, const Kernel& kernel, int j, Sums& sums) {
    x += way * by[0];
    y += way * by[1];
    inside = x >= 0 && y >= 0 && x < static_cast<float>(steps_of.cols) && y < static_cast<float>(steps_of.rows);
    if (!inside) return;
    const int u = static_cast<int>(x), v = static_cast<int>(y);
    by = steps_of(v, u);
    sums.add(kernel, j, way, seeds(v, u));
  }
};

/// Along a pixel's streamline. Both ways at once: a processor waits for neither of two chains of places.
Sums follow(const Field& step, const Seeds& seeds, const Kernel& kernel, int y, int x) {
  Sums sums, up;
  const float at_x = static_cast<float>(x) + 0.5f, at_y = static_cast<float>(y) + 0.5f;
  Walker forth{at_x, at_y, 1, step(y, x)}, back{at_x, at_y, -1, step(y, x)};
  sums.add(kernel, 0, 1, seeds(y, x));
  for (int j = 1; j <= kernel.steps; ++j) {
    if (forth.inside) forth.step(step, seeds, kernel, j, sums);
    if (back.inside) back.step(step, seeds, kernel, j, up);
  }
  return {sums.steady + up.steady, sums.cosine + up.cosine, sums.sine + up.sine};
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
  const double half_length = parameters.length * std::hypot(work.width, work.height) / 2;
  const Kernel kernel = make_kernel(std::max(fewest_steps, static_cast<int>(std::ceil(half_length))));  // steps of 1 px
  const auto longest = static_cast<float>(half_length / kernel.steps);
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

  const Seeds seeds = sow(work, parameters.seed);
  steady_ = Plane(work);
  cosine_ = Plane(work);
  sine_ = Plane(work);
  parallel_pixels(work, [&](int y, int x) {
    const Sums sums = opacity_(y, x) > 0 ? follow(step, seeds, kernel, y, x) : Sums();
    steady_(y, x) = sums.steady;
    cosine_(y, x) = sums.cosine;
    sine_(y, x) = sums.sine;
  });
}

Rgba Streaks::at(double phase, cv::Size size) const {
  check::finite("phase", phase);
  check::size("size", size.width, size.height);
  const double turn = 2 * std::numbers::pi * (phase - std::floor(phase));
  const auto cosine = static_cast<float>(std::cos(turn)), sine = static_cast<float>(std::sin(turn));
  Plane tone(steady_.size());  // signed: light above 0
  parallel_pixels(tone.size(), [&](int y, int x) {
    const float value = contrast * (steady_(y, x) + cosine * cosine_(y, x) - sine * sine_(y, x));
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
