#pragma once

#include <memory>
#include <string>

#include "core/image.h"
#include "picture/openimageio.h"

/// A picture's file, opened and judged by its header; pixels are read on demand.
namespace stillwater {

struct OpenPicture {
  std::string path;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;  ///< of the part that holds the colours
  int part = 0;          ///< its number (OpenEXR files may have several)
  cv::Size size;         ///< of the picture, before it is turned upright
  cv::Point data;        ///< where the file's rectangle of data begins in the picture
  int orientation = 1;   ///< EXIF, 1 .. 8

  bool is(const char* format) const;
  bool covers_picture() const;  ///< the data fill all of `size`
};

/// Throws FileError and BadInput as read.h says.
OpenPicture open_picture(const std::string& path);

/// Channels [first, last) of the data's rectangle, interleaved, as `type` (uint8, uint16, int16, int32, uint32,
/// float). Throws FileError where the file ends too early.
cv::Mat stored_channels(OpenPicture& file, int first, int last, OIIO::TypeDesc type);

/// The same as floats; integers divided by the largest of their kind.
cv::Mat float_channels(OpenPicture& file, int first, int last);

/// Turns the picture as the camera was held.
cv::Mat upright(const cv::Mat& image, int orientation);

}  // namespace stillwater
