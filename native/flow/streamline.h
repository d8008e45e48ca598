#pragma once

#include "core/image.h"

namespace stillwater {

/// A steady velocity as it is read between its pixels: bilinear, beyond its sides the nearest pixel's holds.
/// Places are index coordinates (0 = centre of the first pixel).
class SteadyFlow {
 public:
  /// `velocity`: pixels per frame, must outlive this. Throws BadInput where it is empty or not finite.
  explicit SteadyFlow(const Field& velocity);

  /// Of a velocity that was found right before.
  struct Checked {};
  static constexpr Checked checked{};
  SteadyFlow(const Field& velocity, Checked) : velocity_(velocity) {}

  cv::Vec2d at(double x, double y) const;

  /// Where the fluid that is at a place will be `frames` later (negative: where it was before). Classical Runge-Kutta
  /// of fourth order; a step is never longer than `longest_step` px, nor does it turn or stretch the flow by more than
  /// a tenth.
  cv::Vec2d carried(cv::Vec2d place, double frames, double longest_step = 1) const;

 private:
  struct Cell;
  Cell cell(double x, double y) const;

  const Field& velocity_;
};

}  // namespace stillwater
