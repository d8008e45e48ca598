#pragma once

#include <complex>
#include <numbers>

namespace stillwater {

/// A branch's tip as a damped harmonic oscillator (Chuang et al. 2005, eq. 4):
///
///     d'' + gamma d' + (2 pi f0)^2 d = w(t) / m
struct Oscillator {
  double frequency;  ///< f0, Hz
  double mass;       ///< m
  double damping;    ///< gamma, 1/s

  /// D(f) / W(f), eq. 5 solved for D: the motion under a force e^(2 pi i f t). f may be negative.
  std::complex<double> response(double f) const {
    constexpr double turn = 2 * std::numbers::pi;
    const std::complex<double> resistance(turn * turn * (frequency * frequency - f * f), turn * damping * f);
    return std::conj(resistance) / (mass * std::norm(resistance));
  }
};

}  // namespace stillwater
