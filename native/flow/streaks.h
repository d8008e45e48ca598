#pragma once

#include <cstdint>

#include "core/image.h"

namespace stillwater {

struct StreakParameters {
  double length = 0.03;    ///< of a streak where the flow is fast, in parts of the picture's diagonal, 0.001..0.5
  double strength = 0.85;  ///< 0..1, opacity of the clearest streaks
  std::uint64_t seed = 0;  ///< of the noise
};

/// A flow made visible as streaks that move, over any picture: line integral convolution of white noise with a kernel whose
/// phase runs (Cabral and Leedom 1993, 3 and 4).
///
///     value(p, phase) = sum_j k(t_j, phase) noise(streamline_p(t_j)),   t_j = -1 .. 1
///     k = cos^2(pi t / 2) (1 + cos(2 pi t + 2 pi phase)) / 2
///
/// The cosine of a sum is two products, so a streamline is followed once, for three sums, and each phase is made of those.
/// A streak's length goes with the root of its speed, so that slow places show something too; the phase moves it half its
/// length a turn, downstream. Speeds count by the one that 95 % of what moves don't pass. The picture is worked at in at most
/// 0.26 megapixels: grain and streaks grow with it, and look the same on a screen.
class Streaks {
 public:
  /// `flow`: px per frame. Throws BadInput for a flow without pixels or with a vector that is not finite, and for parameters
  /// out of range.
  explicit Streaks(const Field& flow, const StreakParameters& parameters = {});

  /// What is laid over a picture, premultiplied: white and black streaks, so that they show on light and dark, clear where
  /// nothing moves. `phase` 0..1 is one turn; 1 is 0 again. Throws BadInput where it is not a finite number or the size is
  /// not 1 .. largest_side.
  Rgba at(double phase, cv::Size size) const;

  cv::Size size() const { return size_; }  ///< the flow's

 private:
  cv::Size size_;
  Plane steady_, cosine_, sine_;  ///< the three sums
  Plane opacity_;
};

}  // namespace stillwater
