#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include "core/fft.h"
#include "core/image.h"
#include "motion/spectrum.h"

/// The water's surface as one periodic tile, at any time directly (Chuang et al. 2005, 3.3; Tessendorf 2001, 4.3;
/// Mastin et al. 1987):
///
///     h(q, t) = sum over k of H(k, t) e^{i k.q},   H(k, t) = A(k) e^{-i omega t} + conj(A(-k)) e^{i omega t}
///     A(k)    = 1/sqrt(2) (xi_r + i xi_i) sqrt(S(k) dk^2 / 2)
///
/// so that a wave whose A(k) is drawn runs along k. The noise xi is a function of the seed and the wave number
/// alone: a finer tile has the same long waves, and another wind only changes S.
namespace stillwater {

struct WaveTile {
  double side = 60;      ///< metres
  int resolution = 256;  ///< samples a side, a power of two, 16 .. 2048
  Spectrum spectrum = Spectrum::phillips;
  double fetch = 100;    ///< km
  double depth = 200;    ///< m
  std::uint64_t seed = 0;
  /// The tile holds the coefficients of the periodic cubic B-spline through the heights instead of the heights.
  bool spline = false;
};

class Waves {
 public:
  enum class Quantity { height, slope_right, slope_away };

  /// `period` in seconds: every frequency becomes the nearest multiple of 1 / period (at least one), 0 = none.
  /// Throws BadInput.
  explicit Waves(const WaveTile& tile, double period = 0);

  /// From now on the sea of this wind: speed in m/s, direction in degrees (0 = along the rows, 90 = along the
  /// columns). Throws BadInput.
  void blow(double speed, double direction);

  /// The tile at `time`, in seconds, or in periods where there is one: metres, or metres a metre. Row y, column x
  /// of the result is the place (x, y) side / resolution.
  const InverseFft2& at(double time, Quantity quantity = Quantity::height);

 private:
  float* mode_column(int kx);

  WaveTile tile_;
  double speed_ = 0, direction_ = 0;
  int half_, stride_;
  std::vector<double> turns_;                ///< omega / 2 pi of the quarter kx, ky >= 0, ky running
  std::vector<std::complex<float>> noise_;   ///< xi / sqrt 2, all n x n
  std::vector<float> modes_;                 ///< four columns for each kx, see wave_modes() in waves_kernel.h
  InverseFft2 transform_;
};

/// Heights of one tile, metres, rows away from the viewer, under a wind of `speed` m/s to `direction` degrees. `period` as in
/// Waves; `seconds` in either case. Throws BadInput.
Plane wave_heights(const WaveTile& tile, double speed, double direction, double seconds, double period);

}  // namespace stillwater
