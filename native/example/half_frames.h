#pragma once

#include "core/image.h"

namespace stillwater {

/// The frames of a clip, or what is made of them, one after the other in memory that somebody else owns (a file mapped,
/// an array): half floats, frames x height x width x 3.
class HalfFrames {
 public:
  /// Throws BadInput where there is no frame, or a side is not 1 .. largest_side.
  HalfFrames(void* halves, int frames, cv::Size size);

  int count() const { return count_; }
  cv::Size size() const { return size_; }

  Rgb read(int frame) const;
  void write(int frame, const Rgb& colours);

 private:
  cv::Mat at(int frame) const;

  void* halves_;
  int count_;
  cv::Size size_;
};

}  // namespace stillwater
