#pragma once

#include <memory>
#include <string>

#include "core/image.h"

namespace stillwater {

/// A clip of footage, read one frame at a time (video_stream.h). Only one frame is in memory.
///
/// Frames are counted from 1, as they are stored, whatever their times are. A frame is always reached by reading on from
/// one before it, or from the beginning, never by the container's index, which gives other frames in files that were cut
/// without encoding or have a variable rate: so any order of reading gives the same frames, and going back costs the way
/// from the beginning.
class Clip {
 public:
  /// Throws FileError where the file is missing, not to be read or not a clip, BadInput where a side is above
  /// largest_side.
  explicit Clip(const std::string& path);
  ~Clip();
  Clip(Clip&&) noexcept;
  Clip& operator=(Clip&&) noexcept;

  int frames() const;
  double fps() const;  ///< 0 where the file doesn't say

  /// The longest time from one frame to the next, of the usual (median) one: above 1 where the rate is variable. 1 where
  /// the file doesn't say.
  double longest_gap() const;
  bool seen_transparent() const;  ///< a frame that was read was, somewhere: it lies over black
  int width() const;
  int height() const;

  /// Frame `number` (1 .. frames()), display-referred red, green, blue, at a wanted size: averaged over areas where
  /// that is smaller, bilinear where it is larger. Throws BadInput for another number or size, FileError where it can't
  /// be decoded.
  cv::Mat_<cv::Vec3f> frame(int number, int width, int height);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stillwater
