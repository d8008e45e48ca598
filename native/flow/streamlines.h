#pragma once

#include <vector>

#include "core/image.h"

namespace stillwater {

/// Where the fluid at the knots of a coarse grid comes from and goes to, for any time up to a longest one: streamlines,
/// made once and kept, so that a moving picture asks for millions of places a second.
class Streamlines {
 public:
  /// Pixels from knot to knot, along both axes; the first knot is the first pixel's centre.
  static constexpr int apart = 4;
  static cv::Size knots_of(cv::Size pixels);

  /// `velocity`: px per frame. `longest`: frames, above 0; times between -longest and longest can be asked for.
  Streamlines(const Field& velocity, double longest);

  cv::Size size() const { return size_; }

  /// Where the fluid that is at a knot will be `frames` later (negative: was before), minus the knot, px; exactly 0 for
  /// no time. Between the stored places by Catmull-Rom's curve.
  cv::Vec2f displaced(int row, int column, double frames) const;

  /// The stored places of a knot: times from -longest to longest, evenly.
  int stored() const { return 2 * half_ + 1; }
  cv::Vec2f stored_at(int row, int column, int index) const { return line(row, column)[1 + index]; }
  double time_of(int index) const { return (index - half_) * step_; }

 private:
  const cv::Vec2f* line(int row, int column) const {
    return places_.data() + (static_cast<size_t>(row) * size_.width + column) * (stored() + 2);
  }

  cv::Size size_;
  int half_ = 0;
  double step_ = 0;
  std::vector<cv::Vec2f> places_;  ///< of each knot stored() places, and one more at both ends
};

}  // namespace stillwater
