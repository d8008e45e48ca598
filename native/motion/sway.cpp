#include "motion/sway.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <mutex>
#include <numbers>
#include <vector>

#include "core/check.h"
#include "core/cpu.h"
#include "motion/shimmer.h"
#include "motion/sway_avx2.h"
#include "motion/sway_kernel.h"

namespace stillwater {
namespace {

constexpr double rms_at_amount_1 = 0.05;  // of the armature's length, under the default Wind and Sway
constexpr double shortening_at_1 = 0.5;     // of foreshortening: as seen from 30 degrees below
constexpr double furthest_armature = 1e6;  // px

void check_sway(const Sway& sway) {
  check::segment("armature", sway.armature);
  for (const double v : {sway.armature.from.x, sway.armature.from.y, sway.armature.to.x, sway.armature.to.y}) {
    check::in_range("armature", v, -furthest_armature, furthest_armature, "px");
  }
  check::positive("frequency", sway.frequency, "Hz");
  check::positive("mass", sway.mass);
  check::positive("damping", sway.damping, "1/s");
  check::in_range("amount", sway.amount, 0, 1000);
  check::in_range("foreshortening", sway.foreshortening, 0, 1);
  check::in_range("shimmer", sway.shimmer, 0, 1);
}

double length(const Segment& armature) {
  return std::hypot(armature.to.x - armature.from.x, armature.to.y - armature.from.y);
}

Point middle(const Segment& armature) {
  return {(armature.from.x + armature.to.x) / 2, (armature.from.y + armature.to.y) / 2};
}

// Mean square of an oscillator's motion that the spectrum expects over many series, for a force equal to the velocity.
double expected_square(const Oscillator& oscillator, double speed) {
  double sum = 0;
  for (int k = 1; k <= turbulence_period * turbulence_cutoff; ++k) {
    const double f = k / turbulence_period;
    sum += wind_spectrum(f, speed) * std::norm(oscillator.response(f));
  }
  return sum / turbulence_period;
}

// Pixels per second^2 (times mass) for each m/s of wind.
double force_of_wind(const Sway& now, double armature_length) {
  static const double rms = [] {
    const Sway usual;
    return std::sqrt(expected_square({usual.frequency, usual.mass, usual.damping}, Wind().speed));
  }();
  return now.amount * rms_at_amount_1 * armature_length / rms;
}

// How much of the turbulence's three parts, and of the mean wind, drives one direction of motion.
struct Share {
  double along, left, up;

  std::complex<double> of(const TurbulenceNoise& noise, int k) const {
    return along * noise(TurbulenceNoise::along, k) + left * noise(TurbulenceNoise::left, k) +
           up * noise(TurbulenceNoise::up, k);
  }
  double square() const { return along * along + left * left + up * up; }
};

// Sums over the modes for one direction.
struct Driven {
  Share share;
  double motion = 0, force = 0, square = 0;

  void add(const TurbulenceNoise& noise, int k, std::complex<double> phase, double velocity,
           std::complex<double> response) {
    const std::complex<double> wind = velocity * share.of(noise, k);
    force += (wind * phase).real();
    motion += (response * wind * phase).real();
    square += std::norm(response * wind) / 2;
  }
};

double soft_limit(double x) { return x / std::sqrt(std::sqrt(1 + x * x * x * x)); }

class Bending : public Displacement {
 public:
  Bending(const SwayKernel& kernel, float reach, std::unique_ptr<const Displacement> leaves)
      : kernel_(kernel), reach_(reach), leaves_(std::move(leaves)) {}

  bool at_rest() const override { return straight() && !leaves_; }
  float reach() const override { return reach_; }

  void map(float* x, float* y, int count) const override {
    if (leaves_) leaves_->map(x, y, count);
    if (straight()) return;
    static const auto points = has_avx2() ? sway_map_avx2 : sway_map_points;
    points(kernel_, x, y, count);
  }

  void unmap(float* x, float* y, int count) const override {
    if (!straight()) {
      static const auto points = has_avx2() ? sway_unmap_avx2 : sway_unmap_points;
      points(kernel_, x, y, count);
    }
    if (leaves_) leaves_->unmap(x, y, count);
  }

 private:
  bool straight() const { return kernel_.tip_angle == 0 && kernel_.stretch == 0; }

  SwayKernel kernel_;
  float reach_;
  std::unique_ptr<const Displacement> leaves_;
};

}  // namespace

/// The modes of the turbulence and what the oscillator makes of them: the same at all moments of one wind.
struct SwaySpectrum {
  double speed, frequency, period;
  int modes;
  std::vector<double> velocity;                ///< of modes 1, 2, ...
  std::vector<std::complex<double>> response;
  double expected = 0;                         ///< mean square of the motion, over many series

  SwaySpectrum(double wind_speed, const Oscillator& oscillator, const TurbulenceClock& clock)
      : speed(wind_speed), frequency(oscillator.frequency), period(clock.period), modes(clock.modes) {
    for (int k = 1; k <= modes; ++k) {
      const double f = k / period, power = wind_spectrum(f, speed) / period;
      velocity.push_back(std::sqrt(power));
      response.push_back(oscillator.response(f));
      expected += power * std::norm(response.back());
    }
    // Of a long series, also where a loop's is short.
    if (period != turbulence_period) expected = expected_square(oscillator, speed);
  }

  bool is_of(double wind_speed, double own_frequency, const TurbulenceClock& clock) const {
    return speed == wind_speed && frequency == own_frequency && period == clock.period && modes == clock.modes;
  }
};

struct SwayMotion::State {
  Sway sway;
  cv::Size picture;
  TurbulenceNoise noise;
  GustField gusts;
  Shimmer shimmer;

  std::mutex mutex{};
  std::shared_ptr<const SwaySpectrum> kept{};  // of the moment before; under the mutex

  std::shared_ptr<const SwaySpectrum> spectrum(double speed, double frequency, const TurbulenceClock& clock);
};

std::shared_ptr<const SwaySpectrum> SwayMotion::State::spectrum(double speed, double frequency,
                                                                const TurbulenceClock& clock) {
  const std::lock_guard lock(mutex);
  if (!kept || !kept->is_of(speed, frequency, clock))
    kept = std::make_shared<const SwaySpectrum>(speed, Oscillator{frequency, sway.mass, sway.damping}, clock);
  return kept;
}

SwayMotion::SwayMotion(const Sway& sway, const Wind& wind, cv::Size picture) {
  check_sway(sway);
  check_wind(wind);
  state_.reset(new State{sway, picture, TurbulenceNoise(sway.seed), GustField(wind.gust_size, wind.seed, picture),
                         Shimmer(sway.armature, sway.seed)});
}

SwayMotion::~SwayMotion() = default;

TipMotion SwayMotion::tip(const Moment& moment, const Sway& now) const {
  check_moment(moment);
  check::positive("frequency", now.frequency, "Hz");
  check::in_range("amount", now.amount, 0, 1000);
  const double speed = moment.wind.speed;
  if (speed == 0 || now.amount == 0) return {};

  // Directions: the wind over the ground, and across the armature to its right as seen from the root.
  const Segment& armature = state_->sway.armature;
  const Point wind = heading(moment.wind);
  const double across_x = -(armature.to.y - armature.from.y) / length(armature);
  const double across_y = (armature.to.x - armature.from.x) / length(armature);
  Driven across{{across_x * wind.x, -side_share * across_x * wind.y, -side_share * across_y}};
  Driven depth{{wind.y, side_share * wind.x, 0}};

  // The turbulence, mode by mode.
  const Oscillator oscillator{now.frequency, state_->sway.mass, state_->sway.damping};
  const TurbulenceClock clock = turbulence_clock(moment);
  const auto spectrum = state_->spectrum(speed, now.frequency, clock);
  const std::complex<double> step = std::polar(1.0, 2 * std::numbers::pi * clock.turn);
  std::complex<double> phase = 1;
  for (int k = 1; k <= clock.modes; ++k) {
    phase *= step;
    across.add(state_->noise, k, phase, spectrum->velocity[k - 1], spectrum->response[k - 1]);
    depth.add(state_->noise, k, phase, spectrum->velocity[k - 1], spectrum->response[k - 1]);
  }

  // Its expected strength, and the gusts.
  const double gust = state_->gusts.factor(middle(armature), moment);
  const double lean = lean_share * speed * state_->gusts.response(middle(armature), moment, oscillator);
  const double scale = force_of_wind(now, length(armature));
  const auto turbulent = [&](const Driven& driven) {
    return driven.square > 0 ? scale * gust * std::sqrt(spectrum->expected * driven.share.square() / driven.square) : 0;
  };
  return {turbulent(across) * across.motion + scale * across.share.along * lean,
          turbulent(depth) * depth.motion + scale * depth.share.along * lean,
          turbulent(across) * across.force + scale * across.share.along * lean_share * speed * (gust - 1)};
}

std::shared_ptr<const Displacement> SwayMotion::at(const Moment& moment, const Sway& now) const {
  const Sway& sway = state_->sway;
  const Segment& armature = sway.armature;
  const TipMotion tip_motion = tip(moment, now);
  const double full = length(armature);
  const double angle = soft_limit(tip_motion.across / full);
  const double shortening = shortening_at_1 * sway.foreshortening * soft_limit(tip_motion.depth / full);

  SwayKernel kernel{};
  kernel.root_x = static_cast<float>(armature.from.x);
  kernel.root_y = static_cast<float>(armature.from.y);
  kernel.axis_x = static_cast<float>((armature.to.x - armature.from.x) / full);
  kernel.axis_y = static_cast<float>((armature.to.y - armature.from.y) / full);
  kernel.inverse_length = static_cast<float>(1 / full);
  kernel.tip_angle = static_cast<float>(angle);
  kernel.stretch = static_cast<float>(std::expm1(-shortening));
  kernel.unstretch = static_cast<float>(std::expm1(shortening));

  std::unique_ptr<const Displacement> leaves;
  if (sway.shimmer > 0 && moment.wind.speed > 0) {
    const double local_speed = moment.wind.speed * state_->gusts.factor(middle(armature), moment);
    leaves = state_->shimmer.at(moment, sway.shimmer, local_speed);
  }

  // A turn moves a point along an arc no longer than the tip's; a scale, in proportion to the distance.
  const Point root = armature.from;
  const double furthest = std::hypot(std::max(std::abs(root.x), std::abs(state_->picture.width - root.x)),
                                     std::max(std::abs(root.y), std::abs(state_->picture.height - root.y)));
  double reach = std::abs(angle) * full + std::expm1(std::abs(shortening)) * furthest;
  if (leaves) reach += leaves->reach();
  return std::make_shared<Bending>(kernel, static_cast<float>(reach), std::move(leaves));
}

}  // namespace stillwater
