#pragma once

#include "core/image.h"

/// Where a displaced layer takes its colour from (Catmull and Rom 1974; Keys 1981 with a = -0.5): sixteen
/// neighbours with the exact weights of each place, no table of places.
namespace stillwater {

/// How a source goes on beyond its sides along one axis.
struct Beyond {
  bool wraps = false;                  ///< the image is one period of an endless one
  bool mirror_low = true;              ///< it goes on as its mirror image at the left (top) ...
  bool mirror_high = true;             ///< ... and at the right (bottom); else its last pixel repeats
};

/// An image ready to be sampled: a copy with a frame of pixels around it, so that no place needs a special case, and
/// a coarse map of where it is empty.
class Source {
 public:
  Source() = default;
  explicit Source(const Rgba& image, Beyond across = {}, Beyond down = {});

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return width_ == 0; }
  Beyond across() const { return across_; }
  Beyond down() const { return down_; }

  /// The image, in this object's memory.
  Rgba pixels() const { return padded_(cv::Rect(frame, frame, width_, height_)); }

  /// True where no pixel within the rectangle (index coordinates; may reach beyond the sides, no further than it
  /// reaches inside) has any coverage.
  bool is_clear(const cv::Rect& area) const;

  /// Colour at `count` places in index coordinates (0 = centre of the first pixel). Places whose `needed` byte is 0
  /// are left alone. Answers false, with nothing filled in, where there is no coverage around any of them. Coverage
  /// comes out within 0 .. 1, and colour with it, so that the straight colour is kept; where it is 1 but for the last
  /// bits of the weights, it is 1. `x` and `y` are used up; they go on to a whole eight.
  bool sample(float* x, float* y, const unsigned char* needed, int count, cv::Vec4f* out) const;

  /// Whether `count` pixels from (x, y) on are all in the image.
  bool holds(int x, int y, int count) const { return x >= 0 && x + count <= width_ && y >= 0 && y < height_; }

  /// The same as sample() for `count` pixels from (x, y) on, which it holds(): where they lie in the image, with at
  /// least 4 pixels behind them; null where there is no coverage.
  const cv::Vec4f* run_at(int x, int y, int count) const;

  /// Pixel (x, y), at most 4 outside of the image: what sample() gives there.
  const cv::Vec4f* at(int x, int y) const { return &padded_(y + frame, x + frame); }

 private:
  static constexpr int frame = 4;
  static constexpr int block = 8;

  enum class Covered { nowhere, somewhere, everywhere };  ///< of blocks

  void map_coverage();
  Covered covered_inside(const cv::Rect& area) const;

  Rgba padded_;
  Beyond across_, down_;
  cv::Mat_<int> covered_blocks_;  ///< integral image of blocks that hold any coverage
  int width_ = 0, height_ = 0;
};

}  // namespace stillwater
