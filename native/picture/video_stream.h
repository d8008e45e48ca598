#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/image.h"

namespace stillwater {

/// The frames of a video file, one after the other, through FFmpeg's libraries: whatever they know (mp4, mov, mkv, webm,
/// avi, mpg, animated gif, ...).
///
/// Not through OpenImageIO: before its version 3.2 (pull request 5301) its reader lets swscale write past the end of a
/// buffer where rows are no multiple of 16 pixels, and it never empties the decoder at a clip's end.
class VideoStream {
 public:
  /// Throws FileError where the file is missing or not to be read, is a picture, holds no video, or a codec that is not
  /// there.
  explicit VideoStream(const std::string& path);
  ~VideoStream();
  VideoStream(VideoStream&&) noexcept;
  VideoStream& operator=(VideoStream&&) noexcept;

  int width() const;   ///< upright: as the file says that it is to be turned
  int height() const;
  double fps() const;  ///< 0 where the file doesn't say

  /// Of a stream that nothing was read from yet: when each stored frame is shown, s, in this order; NaN where the file
  /// doesn't say. Found by reading on to the end.
  std::vector<double> times_to_end();

  /// Decodes the next frame; false at the end. Throws FileError where it can't be decoded.
  bool advance();

  /// The frame advance() decoded: display-referred red, green, blue, upright; the file's own range and primaries' matrix
  /// (where it doesn't say: Rec. 709 from 720 rows on, else Rec. 601). What is transparent lies over black, its alpha
  /// taken as straight. Throws FileError.
  cv::Mat_<cv::Vec3f> frame();

  bool seen_transparent() const;  ///< a frame that frame() gave was, somewhere

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stillwater
