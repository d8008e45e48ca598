#include "motion/waves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/cpu.h"
#include "core/parallel.h"
#include "core/random.h"
#include "motion/waves_avx2.h"
#include "motion/waves_kernel.h"

namespace stillwater {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr int lanes = 8;  // columns of turns start at multiples of 8 floats

const WaveTile& checked(const WaveTile& tile) {
  check::in_range("tile", tile.side, 1e-3, 2000, "m");
  check::power_of_two("resolution", tile.resolution, 16, 2048);
  check::positive("fetch", tile.fetch, "km");
  check::positive("depth", tile.depth, "m");
  return tile;
}

/// What divides the spectrum of heights to give that of their cubic B-spline's coefficients, one axis.
double spline_response(int wave, int n) { return (2 + std::cos(turn * wave / n)) / 3; }

/// Samples can't tell the two directions of the highest frequency apart: it stays empty.
bool highest(int kx, int ky, int n) { return kx == n / 2 || std::abs(ky) == n / 2; }

}  // namespace

Waves::Waves(const WaveTile& tile, double period)
    : tile_(checked(tile)),
      half_(tile.resolution / 2),
      stride_((half_ + 1 + lanes - 1) / lanes * lanes),
      turns_(static_cast<size_t>(half_ + 1) * stride_),
      noise_(static_cast<size_t>(tile.resolution) * tile.resolution),
      modes_(static_cast<size_t>(half_ + 1) * 4 * tile.resolution),
      transform_(tile.resolution) {
  const int n = tile_.resolution;
  const Sea sea{tile_.spectrum, 0, tile_.fetch, tile_.depth};
  parallel_rows(half_ + 1, 8, [&](int first, int last) {
    for (int kx = first; kx < last; ++kx)
      for (int ky = 0; ky <= half_; ++ky) {
        const double turns = angular_frequency(sea, turn / tile_.side * std::hypot(kx, ky)) / turn;
        turns_[static_cast<size_t>(kx) * stride_ + ky] =
            period > 0 && turns > 0 ? std::max(1.0, std::round(turns * period)) : turns;
      }
  });
  parallel_rows(n, 8, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      for (int x = 0; x < n; ++x) {
        const int kx = x < half_ ? x : x - n, ky = y < half_ ? y : y - n;
        noise_[static_cast<size_t>(y) * n + x] = random_gaussian(tile_.seed, {kx, ky, 0}) * std::numbers::sqrt2 / 2.0;
      }
  });
}

float* Waves::mode_column(int kx) { return modes_.data() + static_cast<size_t>(kx) * 4 * tile_.resolution; }

void Waves::blow(double speed, double direction) {
  check::in_range("wind.speed", speed, 0, 100, "m/s");
  check::finite("wind.direction", direction);
  if (speed == speed_ && direction == direction_) return;
  speed_ = speed, direction_ = direction;
  const int n = tile_.resolution;
  const Sea sea{tile_.spectrum, speed, tile_.fetch, tile_.depth};
  const double dk = turn / tile_.side;
  const double right = std::cos(direction * turn / 360), away = std::sin(direction * turn / 360);

  // A(k) of the wave numbers (kx, ky), |kx| and |ky| below n / 2.
  const auto amplitude = [&](int kx, int ky, double root) -> std::complex<float> {
    const double towards = (kx * right + ky * away) / std::hypot(kx, ky);
    const auto noise = noise_[static_cast<size_t>((ky + n) % n) * n + (kx + n) % n];
    return noise * static_cast<float>(root * std::sqrt(spreading(towards)));
  };
  parallel_rows(half_ + 1, 4, [&](int first, int last) {
    for (int kx = first; kx < last; ++kx)
      for (int ky = 0; ky <= half_; ++ky) {
        const bool empty = highest(kx, ky, n) || (kx == 0 && ky == 0);
        const double k = dk * std::hypot(kx, ky);
        double root = empty ? 0 : std::sqrt(radial_density(sea, k) / k / 2) * dk;
        if (tile_.spline) root /= spline_response(kx, n) * spline_response(ky, n);
        for (const int sign : {1, -1}) {
          if (sign < 0 && (ky == 0 || ky == half_)) continue;
          const auto with = empty ? 0 : amplitude(kx, sign * ky, root);
          const auto against = empty ? 0 : amplitude(-kx, -sign * ky, root);
          float* mode = mode_column(kx) + (sign * ky + n) % n;
          mode[0] = with.real() + against.real();
          mode[n] = with.imag() + against.imag();
          mode[2 * n] = with.imag() - against.imag();
          mode[3 * n] = against.real() - with.real();
        }
      }
  });
}

const InverseFft2& Waves::at(double time, Quantity quantity) {
  const int n = tile_.resolution;
  const auto phases = has_avx2() ? wave_phases_avx2 : wave_phases;
  const auto modes = has_avx2() ? wave_modes_avx2 : wave_modes;
  const float dk = static_cast<float>(turn / tile_.side);
  transform_.run([&](int kx, std::complex<float>* column) {
    thread_local std::vector<float> cosines, sines;
    cosines.resize(n + 1), sines.resize(n + 1);
    phases(turns_.data() + static_cast<size_t>(kx) * stride_, time, half_ + 1, cosines.data(), sines.data());
    for (int ky = 1; ky < half_; ++ky) cosines[n - ky] = cosines[ky], sines[n - ky] = sines[ky];
    modes(mode_column(kx), n, cosines.data(), sines.data(), n, reinterpret_cast<float*>(column));
    if (quantity == Quantity::height) return;
    for (int y = 0; y < n; ++y) {
      const float k = dk * static_cast<float>(quantity == Quantity::slope_right ? kx : y < half_ ? y : y - n);
      column[y] = {-k * column[y].imag(), k * column[y].real()};
    }
  });
  return transform_;
}

Plane wave_heights(const WaveTile& tile, double speed, double direction, double seconds, double period) {
  check::finite("seconds", seconds);
  Waves waves(tile, period);
  waves.blow(speed, direction);
  const InverseFft2& filled = waves.at(period > 0 ? seconds / period : seconds);
  Plane heights(tile.resolution, tile.resolution);
  for (int y = 0; y < tile.resolution; ++y) std::copy_n(filled.tile_row(y), tile.resolution, heights[y]);
  return heights;
}

}  // namespace stillwater
