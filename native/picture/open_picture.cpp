#include "picture/open_picture.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "picture/channels.h"
#include "picture/whole_file.h"

namespace stillwater {
namespace {

/// The first part of an OpenEXR file that has colours without a layer's name, or the first one.
void choose_part(OpenPicture& file) {
  for (int i = 0; file.is("openexr") && file.input->seek_subimage(i, 0); ++i) {
    if (!has_plain_colours(file.input->spec().channelnames)) continue;
    file.spec = file.input->spec();
    file.part = i;
    return;
  }
}

int depth_of(OIIO::TypeDesc type) {
  if (type == OIIO::TypeUInt8) return CV_8U;
  if (type == OIIO::TypeUInt16) return CV_16U;
  if (type == OIIO::TypeInt16) return CV_16S;
  // OpenCV has no unsigned 32-bit pixels: the bits are kept.
  return type == OIIO::TypeInt32 || type == OIIO::TypeUInt32 ? CV_32S : CV_32F;
}

template <class Stored>
cv::Mat as_shares(const cv::Mat& stored) {
  constexpr float most = std::numeric_limits<Stored>::max();
  cv::Mat shares(stored.size(), CV_MAKETYPE(CV_32F, stored.channels()));
  parallel_rows(stored.rows, 32, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const Stored* in = stored.ptr<Stored>(y);
      float* out = shares.ptr<float>(y);
      for (int i = 0; i < stored.cols * stored.channels(); ++i) out[i] = in[i] / most;
    }
  });
  return shares;
}

}  // namespace

bool OpenPicture::is(const char* format) const { return std::string_view(input->format_name()) == format; }

bool OpenPicture::covers_picture() const {
  return data.x <= 0 && data.y <= 0 && data.x + spec.width >= size.width && data.y + spec.height >= size.height;
}

OpenPicture open_picture(const std::string& path) {
  OpenPicture file;
  file.path = path;
  file.input = open_file(path);
  if (file.is("FFmpeg movie")) throw FileError(path + ": is a clip, not a picture");
  file.spec = file.input->spec();
  choose_part(file);
  check::size(path, file.spec.width, file.spec.height);
  file.size = {file.spec.width, file.spec.height};
  if (file.is("openexr")) {
    check::size(path, file.spec.full_width, file.spec.full_height);
    file.size = {file.spec.full_width, file.spec.full_height};
    file.data = {file.spec.x - file.spec.full_x, file.spec.y - file.spec.full_y};
  }
  file.orientation = std::clamp(file.spec.get_int_attribute("Orientation", 1), 1, 8);
  return file;
}

cv::Mat stored_channels(OpenPicture& file, int first, int last, OIIO::TypeDesc type) {
  cv::Mat stored(file.spec.height, file.spec.width, CV_MAKETYPE(depth_of(type), last - first));
  if (!file.input->read_image(file.part, 0, first, last, type, stored.data))
    fail(file.path, "is cut short or damaged", file.input->geterror());
  if ((file.is("jpeg") && !is_whole_jpeg(file.path)) || (file.is("tiff") && !is_whole_tiff(file.path)))
    fail(file.path, "is cut short or damaged", "its end is missing");
  return stored;
}

cv::Mat float_channels(OpenPicture& file, int first, int last) {
  if (file.spec.format == OIIO::TypeUInt8)
    return as_shares<unsigned char>(stored_channels(file, first, last, OIIO::TypeUInt8));
  if (file.spec.format == OIIO::TypeUInt16)
    return as_shares<unsigned short>(stored_channels(file, first, last, OIIO::TypeUInt16));
  return stored_channels(file, first, last, OIIO::TypeFloat);
}

cv::Mat upright(const cv::Mat& image, int orientation) {
  cv::Mat turned = image;
  if (orientation >= 5) cv::transpose(image, turned);
  const bool left_right = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool up_down = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  if (!left_right && !up_down) return turned;
  cv::Mat flipped;
  cv::flip(turned, flipped, left_right && up_down ? -1 : (left_right ? 1 : 0));
  return flipped;
}

}  // namespace stillwater
