#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <vector>

#include "core/image.h"

/// The one wind of a picture, and what it does to one element (METHODS.md 1; Chuang et al. 2005, 3.2).
namespace stillwater {

/// The recipe's `wind`, with its animated numbers resolved for one moment.
struct Wind {
  double speed = 5;         ///< m/s, 0 .. 40
  double direction = 0;     ///< degrees, where it blows to over the ground: 0 = picture's right, 90 = away from us
  double gusts = 0;         ///< 0 .. 1, share of the speed that comes as moving gusts
  double gust_size = 0.25;  ///< of the picture's width
  std::uint64_t seed = 0;

  /// Resolved from speed and direction: how far the gusts have travelled over the ground since frame 1, in metres
  /// (right, away).
  Point travel;
};

/// A moment of the timeline. Numbers of one frame, the same for all layers.
struct Moment {
  double frame = 1;        ///< may be fractional
  double fps = 24;
  int loop_frames = 0;     ///< period of the loop in frames, 0 = no loop
  int first_frame = 1;     ///< of the recipe's range: where the loop starts
  Wind wind;
  Point loop_travel;       ///< wind.travel gained over one loop (looping only)

  double seconds() const { return (frame - 1) / fps; }
};

/// Throw BadInput where a number is outside what the structs allow.
void check_wind(const Wind& wind);
void check_moment(const Moment& moment);

/// Unit vector over the ground, (right, away).
Point heading(const Wind& wind);

/// How many whole loops lie between the loop's first frame and the moment's (0 without a loop), and the frames
/// since that loop began (since frame 1 without a loop). Exact, so that a moment one loop later gives the same bytes.
double whole_loops(const Moment& moment);
double frames_into_loop(const Moment& moment);

/// `travelled` less what `gained` a loop adds up to in whole loops; in a loop rounded to 2^-24, far above the last
/// bits in which a sum over another loop may differ.
Point travel_in_loop(Point travelled, Point gained, const Moment& moment);

/// One-sided power spectrum of the wind's velocity along its heading, (m/s)^2 / Hz:
///
///     P_V(f) = c v / (1 + kappa f / v)^(5/3),   kappa = 50 z,   z = 10 m         (Chuang 2005, eq. 8; Kaimal's form)
///
/// c is such that its integral is (turbulence_intensity v)^2. 0 where the speed is 0 or f is.
double wind_spectrum(double frequency, double speed);
inline constexpr double turbulence_intensity = 0.17;  ///< rms over mean, open country at 10 m

/// Turbulence is a sum of waves of frequencies k / period, k = 1 .. modes, up to turbulence_cutoff. The period is the
/// loop's (a whole part of it where it is longer than turbulence_period), without a loop turbulence_period. A loop
/// shorter than 1 / turbulence_cutoff has no turbulence.
struct TurbulenceClock {
  double period;  ///< s
  int modes;
  double turn;  ///< phase of wave 1, turns in [0, 1)
};
inline constexpr double turbulence_period = 128;  ///< s
inline constexpr double turbulence_cutoff = 8;    ///< Hz; a frame rate of 24 shows no more than 12
TurbulenceClock turbulence_clock(const Moment& moment);

/// The noise of one element: complex numbers G_k of unit variance in both parts (eq. 9), for the wind's velocity
/// along its heading, to the left of it and upwards. They depend on the seed alone: whatever changes in the wind,
/// frames evaluate spectrum and response of that moment on the same noise.
class TurbulenceNoise {
 public:
  enum Component { along, left, up };
  explicit TurbulenceNoise(std::uint64_t seed);

  /// k from 1 to turbulence_period x turbulence_cutoff.
  std::complex<double> operator()(Component component, int k) const { return noise_[component][k - 1]; }

 private:
  std::array<std::vector<std::complex<double>>, 3> noise_;
};

/// Deviation of the wind from its mean speed along its heading, m/s, at the element that this seed names:
/// the sum over k of Re(G_k sqrt(P_V(f_k) / period) e^(2 pi i k turn)). Gusts are not in it (GustField::factor).
double turbulence(const TurbulenceNoise& noise, const Moment& moment);

}  // namespace stillwater
