#pragma once

#include "core/image.h"

/// What every engine implements for one layer: the layer as it looks at one moment, tile by tile.
/// `frame/` asks each layer, front first, for the pixels that nothing in front of it covers.
namespace stillwater {

/// A rectangle of output pixels, no larger than tile_side a side.
using Tile = cv::Rect;
inline constexpr int tile_side = 64;

class LayerMotion {
 public:
  virtual ~LayerMotion() = default;

  /// True where the layer looks exactly as in the still picture at this moment (draw() copies).
  virtual bool at_rest() const = 0;

  /// Output pixels outside are transparent.
  virtual cv::Rect bounds() const = 0;

  /// Premultiplied colour and coverage of the tile's pixels. `out` holds tile.width floats x 4 a row, rows
  /// `stride` pixels apart. `needed`, one byte a pixel in rows of tile_side, is 0 where the result is not read.
  /// Answers false where the whole tile is transparent (out is then untouched).
  virtual bool draw(const Tile& tile, const unsigned char* needed, cv::Vec4f* out, int stride) const = 0;

  /// Where the points seen in these output pixels are one frame later, minus here, output pixels. `x`, `y` hold
  /// pixel centres in output pixels and are replaced by the flow.
  virtual void flow(float* x, float* y, int count) const = 0;
};

}  // namespace stillwater
