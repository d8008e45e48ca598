#include "motion/spectrum.h"

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace stillwater {
namespace {

double fourth(double x) { return x * x * x * x; }

constexpr double pierson_alpha = 0.0081, pierson_beta = 1.291;

double pierson_peak(double wind_speed) { return 0.87 * gravity / wind_speed; }

double fall(double alpha, double beta, double peak, double omega) {
  return alpha * gravity * gravity / (fourth(omega) * omega) * std::exp(-beta * fourth(peak / omega));
}

/// m^2 s / rad.
double jonswap(const Sea& sea, double omega) {
  const double u = sea.wind_speed, fetch = sea.fetch * 1000;
  const double alpha = 0.076 * std::pow(u * u / (fetch * gravity), 0.22);
  const double peak = 22 * std::cbrt(gravity * gravity / (u * fetch));
  const double sigma = omega <= peak ? 0.07 : 0.09;
  const double r = std::exp(-std::pow((omega - peak) / (sigma * peak), 2) / 2);
  return fall(alpha, 1.25, peak, omega) * std::pow(3.3, r);
}

double kitaigorodskii(double depth, double omega) {
  const double w = omega * std::sqrt(depth / gravity);
  if (w <= 1) return w * w / 2;
  return w < 2 ? 1 - (2 - w) * (2 - w) / 2 : 1;
}

/// d omega / d k.
double group_speed(const Sea& sea, double k) {
  const double omega = angular_frequency(sea, k);
  if (sea.spectrum != Spectrum::tma) return gravity / (2 * omega);
  const double kd = k * sea.depth, t = std::tanh(kd);
  return gravity * (t + kd * (1 - t * t)) / (2 * omega);
}

double phillips(double wind_speed, double k) {
  const double variance = pierson_alpha * gravity * gravity / (4 * pierson_beta * fourth(pierson_peak(wind_speed)));
  const double length = wind_speed * wind_speed / gravity;
  // exp(-1 / (k L)^2) / k^4 on a ring of 2 pi k, over its integral L^2 / 2.
  return variance * 2 / (length * length) * std::exp(-1 / (k * k * length * length)) / (k * k * k);
}

}  // namespace

std::string name_of(Spectrum spectrum) {
  switch (spectrum) {
    case Spectrum::phillips:
      return "phillips";
    case Spectrum::pierson_moskowitz:
      return "pierson-moskowitz";
    case Spectrum::jonswap:
      return "jonswap";
    case Spectrum::tma:
      return "tma";
  }
  return "";
}

Spectrum spectrum_named(const std::string& name) {
  for (const Spectrum s : {Spectrum::phillips, Spectrum::pierson_moskowitz, Spectrum::jonswap, Spectrum::tma})
    if (name_of(s) == name) return s;
  throw BadInput("spectrum: \"" + name + "\" is not phillips, pierson-moskowitz, jonswap or tma");
}

double angular_frequency(const Sea& sea, double wave_number) {
  const double deep = gravity * wave_number;
  return std::sqrt(sea.spectrum == Spectrum::tma ? deep * std::tanh(wave_number * sea.depth) : deep);
}

double radial_density(const Sea& sea, double wave_number) {
  constexpr double calm = 1e-3;  // m/s; the spectra's constants leave the numbers' range below
  if (sea.wind_speed < calm || wave_number <= 0) return 0;
  const double omega = angular_frequency(sea, wave_number);
  switch (sea.spectrum) {
    case Spectrum::phillips:
      return phillips(sea.wind_speed, wave_number);
    case Spectrum::pierson_moskowitz:
      return fall(pierson_alpha, pierson_beta, pierson_peak(sea.wind_speed), omega) * group_speed(sea, wave_number);
    case Spectrum::jonswap:
      return jonswap(sea, omega) * group_speed(sea, wave_number);
    case Spectrum::tma:
      return jonswap(sea, omega) * kitaigorodskii(sea.depth, omega) * group_speed(sea, wave_number);
  }
  return 0;
}

double spreading(double cosine_to_wind) {
  return cosine_to_wind <= 0 ? 0 : 2 / std::numbers::pi * cosine_to_wind * cosine_to_wind;
}

}  // namespace stillwater
