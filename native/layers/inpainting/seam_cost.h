#pragma once

#include <algorithm>
#include <cstdlib>

#include "layers/inpainting/inpaint_level.h"

namespace stillwater {

/// Shifts, (x, y) pixels, of an image's size: each pixel of a hole is the copy of the one so far away. 0 elsewhere.
using ShiftMap = cv::Mat_<cv::Vec2s>;

/// How much the border between two pieces of a shift map is seen, in whole numbers: for neighbours p, q
///
///     |I(p + s_p) - I(p + s_q)|^2 + |I(q + s_p) - I(q + s_q)|^2,
///
/// the same of the gradients of lightness, and a little for being a border at all; 0 where s_p = s_q. A known pixel has
/// the shift 0. Pritch, Kav-Venaki, Peleg 2009, "Shift-map image editing", equation 4.
class SeamCost {
 public:
  /// Of `level.bytes` only known pixels are read.
  explicit SeamCost(const InpaintLevel& level);

  /// p in the hole, q beside it, in the image; both their pixels may be copied from where their own shifts lead.
  int operator()(const cv::Point& p, const cv::Point& q, const cv::Vec2s& shift_p, const cv::Vec2s& shift_q) const;

  /// What a pixel costs for its shift alone: a little for coming from far, more for coming from above or below, for
  /// pictures lie in level bands.
  int far(const cv::Vec2s& shift) const {
    return (far_beside * std::abs(shift[0]) + far_above * std::abs(shift[1])) / std::max(inside_.width, inside_.height);
  }

  /// Does the shift lead to a pixel that may be copied, within the radius?
  bool may_copy(const cv::Point& p, const cv::Vec2s& shift) const {
    const cv::Point from(p.x + shift[0], p.y + shift[1]);
    return inside_.contains(from) && level_.allowed(from) &&
           shift[0] * shift[0] + shift[1] * shift[1] <= squared_radius_;
  }

  bool contains(const cv::Point& p) const { return inside_.contains(p); }

 private:
  static constexpr int far_beside = 30, far_above = 120;

  using Look = cv::Vec<short, 6>;  // four bytes, gradient of lightness

  int difference(const cv::Point& a, const cv::Point& b) const;
  bool is_known(const cv::Point& p) const { return inside_.contains(p) && !level_.hole(p); }

  const InpaintLevel& level_;
  cv::Rect inside_;
  double squared_radius_;
  cv::Mat_<Look> looks_;
};

}  // namespace stillwater
