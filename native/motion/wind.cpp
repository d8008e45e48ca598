#include "motion/wind.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/random.h"

namespace stillwater {
namespace {

constexpr double gauge_height = 10;          // m
constexpr double kappa = 50 * gauge_height;  // m

double in_loop(double travelled, double gained, double loops) {
  return std::nearbyint((travelled - loops * gained) * 0x1p24) * 0x1p-24;
}

}  // namespace

void check_wind(const Wind& wind) {
  check::in_range("wind.speed", wind.speed, 0, 40, "m/s");
  check::in_range("wind.direction", wind.direction, -36000, 36000, "degrees");
  check::in_range("wind.gusts", wind.gusts, 0, 1);
  check::positive("wind.gust_size", wind.gust_size, "of the picture's width");
  check::finite("wind.travel", wind.travel.x);
  check::finite("wind.travel", wind.travel.y);
}

void check_moment(const Moment& moment) {
  check_wind(moment.wind);
  check::in_range("frame", moment.frame, -1e9, 1e9);
  check::positive("fps", moment.fps);
  check::in_range("loop_frames", moment.loop_frames, 0, 1e9);
  check::finite("loop_travel", moment.loop_travel.x);
  check::finite("loop_travel", moment.loop_travel.y);
}

Point heading(const Wind& wind) {
  const double angle = wind.direction * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

double whole_loops(const Moment& moment) {
  if (moment.loop_frames == 0) return 0;
  return std::floor((moment.frame - moment.first_frame) / moment.loop_frames);
}

double frames_into_loop(const Moment& moment) {
  if (moment.loop_frames == 0) return moment.frame - 1;
  return moment.frame - moment.first_frame - whole_loops(moment) * moment.loop_frames;
}

Point travel_in_loop(Point travelled, Point gained, const Moment& moment) {
  if (moment.loop_frames == 0) return travelled;
  const double loops = whole_loops(moment);
  return {in_loop(travelled.x, gained.x, loops), in_loop(travelled.y, gained.y, loops)};
}

double wind_spectrum(double frequency, double speed) {
  if (speed == 0 || frequency == 0) return 0;
  constexpr double c = turbulence_intensity * turbulence_intensity * kappa / 1.5;
  const double x = 1 + kappa * frequency / speed;
  const double root = std::cbrt(x);
  return c * speed / (x * root * root);
}

TurbulenceClock turbulence_clock(const Moment& moment) {
  TurbulenceClock clock{turbulence_period, 0, moment.seconds() / turbulence_period};
  if (moment.loop_frames > 0) {
    const double loop = moment.loop_frames / moment.fps;
    const double parts = std::ceil(loop / turbulence_period);
    clock.period = loop / parts;
    clock.turn = frames_into_loop(moment) * parts / moment.loop_frames;
  }
  clock.modes = static_cast<int>(clock.period * turbulence_cutoff);
  clock.turn -= std::floor(clock.turn);
  return clock;
}

TurbulenceNoise::TurbulenceNoise(std::uint64_t seed) {
  constexpr int modes = static_cast<int>(turbulence_period * turbulence_cutoff);
  for (int component = 0; component < 3; ++component) {
    noise_[component].resize(modes);
    for (int k = 1; k <= modes; ++k) noise_[component][k - 1] = random_gaussian(seed, {k, component, 0});
  }
}

double turbulence(const TurbulenceNoise& noise, const Moment& moment) {
  check_moment(moment);
  const TurbulenceClock clock = turbulence_clock(moment);
  const std::complex<double> step = std::polar(1.0, 2 * std::numbers::pi * clock.turn);
  std::complex<double> phase = 1;
  double velocity = 0;
  for (int k = 1; k <= clock.modes; ++k) {
    phase *= step;
    const double power = wind_spectrum(k / clock.period, moment.wind.speed) / clock.period;
    velocity += std::sqrt(power) * (noise(TurbulenceNoise::along, k) * phase).real();
  }
  return velocity;
}

}  // namespace stillwater
