#pragma once

#include "core/image.h"

/// What every engine implements for one layer: the layer as it looks at one moment, row by row of output pixels.
/// `frame/` asks each layer, front first, for the pixels that nothing in front of it covers.
namespace stillwater {

/// Output pixels (x, y) .. (x + count - 1, y): at most `longest` of them.
struct Run {
  static constexpr int longest = 64;
  int x, y, count;
};

class LayerMotion {
 public:
  virtual ~LayerMotion() = default;

  /// True where the layer looks exactly as in the still picture at this moment.
  virtual bool at_rest() const = 0;

  /// The part of a tile (output pixels) beside which the layer is surely transparent; empty where all of it is.
  virtual cv::Rect covered(const cv::Rect& tile) const = 0;

  /// Premultiplied colour and coverage of a run. Where `needed` is 0 the result is not read, and need not be made.
  /// The answer is `room` (run.count pixels, and three behind them that may be read), or memory of the layer itself
  /// where its pixels lie there as they are; null where the whole run is transparent.
  virtual const cv::Vec4f* draw(const Run& run, const unsigned char* needed, cv::Vec4f* room) const = 0;

  /// Where the points seen at these places are one frame later, minus here, output pixels. `x`, `y` hold places in
  /// output pixels (centres at + 0.5) and are replaced by the flow.
  virtual void flow(float* x, float* y, int count) const = 0;
};

}  // namespace stillwater
