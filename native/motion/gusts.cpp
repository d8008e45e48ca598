#include "motion/gusts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/random.h"

namespace stillwater {
namespace {

constexpr double turn = 2 * std::numbers::pi;

double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }

// The nearest wave number that makes whole turns over `way`.
Point closed_over(Point number, Point way) {
  const double length2 = dot(way, way);
  if (length2 == 0) return number;
  const double phase = dot(number, way);
  const double missing = (turn * std::nearbyint(phase / turn) - phase) / length2;
  return {number.x + missing * way.x, number.y + missing * way.y};
}

}  // namespace

GustField::GustField(double gust_size, std::uint64_t seed, cv::Size picture) {
  check::positive("gust_size", gust_size, "of the picture's width");
  check::size("picture", picture.width, picture.height);
  metres_per_pixel_ = plan_width / picture.width;
  const double deviation = 2 * std::sqrt(std::numbers::ln2) / (gust_size * plan_width);
  for (int j = 0; j < waves; ++j) {
    const std::complex<double> number = deviation * random_gaussian(seed, {j, 0, 1});
    number_[j] = {number.real(), number.imag()};
    phase_[j] = turn * random_uniform(seed, {j, 0, 2});
  }
}

GustField::Waves GustField::at(Point place, const Moment& moment) const {
  const Point travel = travel_in_loop(moment.wind.travel, moment.loop_travel, moment);
  const Point ground{place.x * metres_per_pixel_ - travel.x, -place.y * metres_per_pixel_ - travel.y};
  const double strength = 1 / std::sqrt(static_cast<double>(waves));
  Waves result;
  for (int j = 0; j < waves; ++j) {
    result.number[j] = moment.loop_frames > 0 ? closed_over(number_[j], moment.loop_travel) : number_[j];
    result.strength[j] = std::polar(strength, dot(result.number[j], ground) + phase_[j]);
  }
  return result;
}

double GustField::factor(Point place, const Moment& moment) const {
  if (moment.wind.gusts == 0) return 1;
  std::complex<double> sum = 0;
  for (const std::complex<double>& strength : at(place, moment).strength) sum += strength;
  return 1 - moment.wind.gusts + moment.wind.gusts * std::norm(sum);
}

void GustField::factors(Point first, Point step, const Moment& moment, int count, float* out) const {
  if (moment.wind.gusts == 0) {
    std::fill_n(out, count, 1.0f);
    return;
  }
  Waves here = at(first, moment);
  std::array<std::complex<double>, waves> turned;
  for (int j = 0; j < waves; ++j)
    turned[j] = std::polar(1.0, metres_per_pixel_ * dot(here.number[j], {step.x, -step.y}));
  for (int i = 0; i < count; ++i) {
    std::complex<double> sum = 0;
    for (int j = 0; j < waves; ++j) {
      sum += here.strength[j];
      here.strength[j] *= turned[j];
    }
    out[i] = static_cast<float>(1 - moment.wind.gusts + moment.wind.gusts * std::norm(sum));
  }
}

double GustField::response(Point place, const Moment& moment, const Oscillator& oscillator) const {
  if (moment.wind.gusts == 0) return 0;
  const Waves here = at(place, moment);
  const Point towards = heading(moment.wind);
  double motion = 0;
  for (int i = 0; i < waves; ++i) {
    for (int j = 0; j < i; ++j) {
      const Point number{here.number[i].x - here.number[j].x, here.number[i].y - here.number[j].y};
      const double frequency = -moment.wind.speed * dot(number, towards) / turn;  // as it passes the place
      const std::complex<double> force = here.strength[i] * std::conj(here.strength[j]);
      motion += 2 * (oscillator.response(frequency) * force).real();  // (i, j) and its conjugate (j, i)
    }
  }
  return moment.wind.gusts * motion;
}

}  // namespace stillwater
