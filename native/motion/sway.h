#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>

#include "layers/displacement.h"
#include "motion/gusts.h"
#include "motion/wind.h"

/// Trees, plants and flags that bend about the root of an armature (Chuang et al. 2005, 3.1 - 3.2; METHODS.md 1).
namespace stillwater {

/// The recipe's `sway`; frequency and amount are those of one moment.
struct Sway {
  Segment armature;           ///< root and tip, picture pixels; may reach outside the picture
  double frequency = 0.6;     ///< f0, Hz, above 0
  double mass = 1;            ///< m, above 0
  double damping = 0.4;       ///< gamma, 1/s, above 0
  double amount = 1;          ///< 1 = a tip rms of 0.05 of the armature's length (upright, default wind and numbers)
  double foreshortening = 0;  ///< 0 .. 1, how much motion in depth changes the length; 1 = seen from 30 degrees below
  double shimmer = 0;         ///< 0 .. 1, see shimmer.h
  std::uint64_t seed = 0;
};

/// Motion of the tip before the limit of SwayMotion::at(), pixels.
struct TipMotion {
  double across = 0;  ///< in the picture, positive clockwise as seen on the screen (an upright tip to the right)
  double depth = 0;   ///< away from the viewer
  double force = 0;   ///< w in eq. 4: what drives `across`, pixels / s^2 x mass
};

/// One layer's sway.
///
/// The tip. The wind's turbulence has three independent parts of one spectrum: along its heading, and with `side_share`
/// of that strength to the side and upwards. What counts is their sum projected on the direction across the armature in
/// the picture; the part into depth moves the tip in depth. So a wind straight into depth sways an upright tree half as
/// much, by the side parts alone, which know no direction. Each motion is the closed sum over the modes of
///
///     D_tip(f) = W(f)/m / ( (2 pi)^2 (f0^2 - f^2) + i 2 pi gamma f )                      (eq. 5, 6)
///
/// under this moment's wind, scaled so that its mean square over the period is what the spectrum expects (a short loop
/// has few modes; it would else be still for some seeds and wild for others), times the local gust factor. A gust leans
/// the tip: the same oscillator under lean_share (factor - 1) of the mean speed.
///
/// The layer. A point at distance r from the root turns about it by d(u)/r, u = r / length,
///
///     d(u) = (u^4/3 - 4 u^3/3 + 2 u^2) d_tip  for u <= 1,  d_tip beyond                   (eq. 3)
///
/// The radius stays, so the opposite angle is the exact inverse, and nothing ever folds. d_tip is limited softly to the
/// armature's length (x / (1 + x^4)^(1/4) of it: 1e-4 less at 0.15, 0.2 % at 0.3): a turn of 1 rad.
/// Before it is turned, the layer is scaled along the armature, about the root, by
/// exp(-foreshortening depth / (2 length)); depth is limited alike.
class SwayMotion {
 public:
  static constexpr double side_share = 0.5;
  static constexpr double lean_share = 0.35;  ///< trees yield: their drag grows less than the speed

  /// Throws BadInput where a field is not what the structs allow.
  SwayMotion(const Sway& sway, const Wind& wind, cv::Size picture);
  ~SwayMotion();

  /// The displacement at a moment. Of `now` only frequency and amount are read, of moment.wind all but seed and
  /// gust_size.
  std::shared_ptr<const Displacement> at(const Moment& moment, const Sway& now) const;

  TipMotion tip(const Moment& moment, const Sway& now) const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace stillwater
