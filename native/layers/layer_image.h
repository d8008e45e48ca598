#pragma once

#include "core/image.h"

namespace stillwater {

/// One layer as it was cut out of the picture: premultiplied colour and coverage in `box`, nothing outside of it.
/// Where the box ends at the border of the picture, the layer is thought to go on (its edge repeats).
///
///     picture +--------------------+
///             |     box +------+   |
///             |         |pixels|   |
///             |         +------+   |
///             +--------------------+
struct LayerImage {
  Rgba pixels;   ///< box.height x box.width
  cv::Rect box;  ///< picture pixels; empty for a layer without coverage
};

}  // namespace stillwater
