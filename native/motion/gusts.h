#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <opencv2/core.hpp>

#include "motion/oscillator.h"
#include "motion/wind.h"

/// Gusts: strength that varies over the picture and travels with the wind. METHODS.md 1 names them as missing in
/// Chuang et al. 2005; this is our own law.
///
/// The picture is read as a plan of the ground, x to the right, up = away; its width stands for plan_width metres, so
/// a wind of 5 m/s carries a gust across it in 10 s. Over the plan stands a frozen pattern, the intensity of a sum of
/// plane waves of equal strength and random phase ("speckle"),
///
///     g(q) = | 1/sqrt(N) sum_j exp(i (k_j . q + phi_j)) |^2 ,       k_j Gaussian, both parts of deviation s
///
/// which is never negative, has the mean 1 and, for many waves, the variance 1 and the correlation
/// exp(-s^2 |q|^2): s is such that this falls to a half over half of gust_size. At a moment the pattern has travelled
/// by Wind::travel: g(q - travel). Multiplied out, g is 1 plus N (N - 1) plane waves, so an oscillator's answer to it
/// is a sum as well.
///
/// In a loop each k_j is bent, along the way the wind goes in one loop, to the nearest that makes whole turns: the
/// pattern still travels exactly with the wind and closes.
namespace stillwater {

inline constexpr double plan_width = 50;  ///< m

class GustField {
 public:
  /// gust_size: of the picture's width, above 0. Throws BadInput.
  GustField(double gust_size, std::uint64_t seed, cv::Size picture);

  /// Local over mean wind speed at a picture point: 1 - gusts + gusts g. Never negative, 1 where gusts is 0.
  double factor(Point place, const Moment& moment) const;

  /// The same at `count` places in a line, `step` apart: each wave turns by the same angle from one to the next.
  void factors(Point first, Point step, const Moment& moment, int count, float* out) const;

  /// Motion of an oscillator at `place` under the force factor - 1 in this moment's wind.
  double response(Point place, const Moment& moment, const Oscillator& oscillator) const;

 private:
  static constexpr int waves = 16;
  struct Waves {
    std::array<Point, waves> number;                  // k_j, rad / m
    std::array<std::complex<double>, waves> strength;  // of each wave at the place
  };
  Waves at(Point place, const Moment& moment) const;

  double metres_per_pixel_;
  std::array<Point, waves> number_;
  std::array<double, waves> phase_;
};

}  // namespace stillwater
