#pragma once

#include "core/image.h"

namespace stillwater {

/// What is known of each pixel: one of `known::background`, `known::unknown`, `known::foreground`.
using Trimap = cv::Mat_<unsigned char>;

namespace known {
inline constexpr unsigned char background = 0, unknown = 128, foreground = 255;
}  // namespace known

/// From grey: 0.9 and above is foreground, 0.1 and below background, all between unknown. Throws BadInput for an empty
/// plane and for numbers outside 0 .. 1.
Trimap trimap_from_grey(const Plane& grey);

/// Foreground 1, background 0, unknown 0.5.
Plane grey_of(const Trimap& trimap);

/// How many pixels are what.
struct TrimapCount {
  long long foreground = 0, background = 0, unknown = 0;
};
TrimapCount count(const Trimap& trimap);

}  // namespace stillwater
