#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/image.h"

/// A picture that flows for ever (Max and Becker 1995, "Flow visualization using moving textures"; Neyret 2003, "Advected
/// textures"): copies of the still picture are carried along, each around its own moment of birth, at which it is the
/// still picture itself. A copy comes in half a life before its birth, goes half a life after it, and counts most at it.
///
///     weight   /\    /\    /\         even copies
///             /  \  /  \  /  \        (lives are one period long, births half a period apart)
///            /    \/    \/    \       .
///     time   ------------------>
///
/// With these weights the mean way of what is seen is 0: colours that change slowly over the picture stay where they are.
/// Places differ in phase, so that not all fade together. Where a whole life would stretch the picture too much, lives
/// are a half or a quarter as long: copies of all three lengths are born at the same moments, and shared.
namespace stillwater {

/// The recipe's `flow`, resolved; everything that a frame reads.
struct Flow {
  double cycle = 0;           ///< where in the period the frame is, 0 .. 1
  std::vector<double> ways;   ///< way of the fluid since each age, from minus to plus half a period, evenly; frames at
                              ///< speed 1 (the speed enters through its integral); at least 2
  double step = 0;            ///< way to the next frame
  int field = 0, next_field = 0;  ///< which of the layer's fields
  double next_share = 0;      ///< 0 .. 1, of the second one
};

/// Copies that may be seen at once, by their birth; a place sees two of them, or three.
inline constexpr int flow_copies = 8;
/// Lengths of life: a period, a half, a quarter.
inline constexpr int flow_lives = 3;

/// Age of a copy, in periods, -0.5 .. 0.5. `phase`: of the place, with the cycle.
inline float age_of(int copy, float phase) {
  const float turned = phase - static_cast<float>(copy) / flow_copies;
  return turned - std::floor(turned) - 0.5f;
}

/// Weight of a copy at an age; they add up to 1 over all copies. `lives`: shares of the lengths of life at the place.
inline float weight_of(int copy, float age, const std::array<float, flow_lives>& lives) {
  const float old = std::abs(age), quarter = lives[2] * std::max(0.0f, 1 - 8 * old);
  if (copy % 2 != 0) return quarter;
  const float half = quarter + lives[1] * std::max(0.0f, 1 - 4 * old);
  return copy % 4 != 0 ? half : half + lives[0] * std::max(0.0f, 1 - 2 * old);
}

/// The way at an age, from Flow::ways.
double way_at(const Flow& flow, double age);

/// The same flow with the period cut into `turns`.
Flow faster(const Flow& flow, int turns);

/// Throws BadInput for numbers that are not finite or out of range, fewer than 2 ways, or a field that is not there.
void check_flow(const Flow& flow, int fields);

}  // namespace stillwater
