#pragma once

#include <string>

/// Wave spectra of the open sea: how the variance of the water's height is spread over wave vectors.
namespace stillwater {

inline constexpr double gravity = 9.81;  ///< m/s^2

enum class Spectrum { phillips, pierson_moskowitz, jonswap, tma };

/// By the recipe's names: "phillips", "pierson-moskowitz", "jonswap", "tma". Throws BadInput.
Spectrum spectrum_named(const std::string& name);
std::string name_of(Spectrum spectrum);

/// The sea that a steady wind raises.
struct Sea {
  Spectrum spectrum = Spectrum::phillips;
  double wind_speed = 5;  ///< m/s; 0 is a flat sea
  double fetch = 100;     ///< km, jonswap and tma
  double depth = 200;     ///< m, tma
};

/// Angular frequency [rad/s] of a wave of `wave_number` [rad/m]: omega^2 = g k, and for TMA, whose spectrum is one
/// of shallow water, omega^2 = g k tanh(k depth).
double angular_frequency(const Sea& sea, double wave_number);

/// Variance density over wave numbers before spreading, m^2 / (rad/m): its integral over k > 0 is the variance of
/// the height, (significant height / 4)^2.
/// Frequency spectra S(omega) = alpha g^2 / omega^5 exp(-beta (omega_p / omega)^4):
/// - Pierson-Moskowitz (1964): alpha 0.0081, beta 1.291, omega_p = 0.87 g / U;
/// - JONSWAP (Hasselmann et al. 1973): alpha = 0.076 (U^2 / (F g))^0.22, beta 1.25, omega_p = 22 (g^2 / (U F))^(1/3),
///   times 3.3^exp(-(omega - omega_p)^2 / (2 sigma^2 omega_p^2)), sigma 0.07 below the peak and 0.09 above;
/// - TMA (Bouws et al. 1985): JONSWAP times Kitaigorodskii's depth factor, as Thompson and Vincent approximate it.
/// Phillips as Tessendorf 2001, eq. 40: exp(-1 / (k L)^2) / k^4 over the plane, L = U^2 / g, scaled to the variance
/// of Pierson-Moskowitz at the same wind.
double radial_density(const Sea& sea, double wave_number);

/// How a wave's variance is spread over directions, 1/rad: 2/pi cos^2 of the angle to the wind, given by its
/// cosine; 0 against the wind, for all four spectra, so that waves run with the wind. Its integral over the circle
/// is 1.
double spreading(double cosine_to_wind);

}  // namespace stillwater
