#include "picture/read.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.h"
#include "core/parallel.h"
#include "picture/channels.h"
#include "picture/open_picture.h"

namespace stillwater {
namespace {

constexpr int grain = 32;  // rows

/// Pixels of the file to RGBA; a colour with a value that is not finite becomes 0. Returns how many did.
long long gather(const float* in, int channels, const ColourChannels& from, cv::Vec4f* out, int pixels) {
  long long bad = 0;
  for (int x = 0; x < pixels; ++x, in += channels) {
    const float red = in[from.red], green = in[from.green], blue = in[from.blue];
    const float alpha = from.alpha < 0 ? 1.0f : in[from.alpha];
    const float cover = std::isfinite(alpha) ? std::clamp(alpha, 0.0f, 1.0f) : 0.0f;
    const bool good = std::isfinite(red) && std::isfinite(green) && std::isfinite(blue) && std::isfinite(alpha);
    out[x] = good ? cv::Vec4f(red, green, blue, cover) : cv::Vec4f(0, 0, 0, cover);
    bad += !good;
  }
  return bad;
}

void premultiply(cv::Vec4f* row, int pixels) {
  for (int x = 0; x < pixels; ++x)
    for (int c = 0; c < 3; ++c) row[x][c] *= row[x][3];
}

bool is_linear(ColourSpace wish, const OpenPicture& file) {
  if (wish == ColourSpace::automatic) return file.is("openexr") || file.is("hdr");
  return wish == ColourSpace::linear;
}

/// The columns and rows of the picture for which the file has data.
cv::Rect covered(const OpenPicture& file) {
  return cv::Rect(file.data, cv::Size(file.spec.width, file.spec.height)) & cv::Rect({0, 0}, file.size);
}

template <class Pixel>
cv::Mat_<Pixel> placed(const cv::Mat_<Pixel>& data, const OpenPicture& file) {
  if (data.size() == file.size && file.data == cv::Point()) return data;
  cv::Mat_<Pixel> picture = cv::Mat_<Pixel>::zeros(file.size);
  const cv::Rect window = covered(file);
  if (!window.empty()) data(window - file.data).copyTo(picture(window));
  return picture;
}

bool any_alpha_below_one(const Rgba& image) {
  return std::any_of(image.begin(), image.end(), [](const cv::Vec4f& p) { return p[3] < 1; });
}

/// Grey stays exactly what it was.
float luma(float red, float green, float blue) {
  if (red == green && green == blue) return red;
  return 0.2126f * red + 0.7152f * green + 0.0722f * blue;
}

float share(float value) { return value > 0 ? std::min(value, 1.0f) : 0.0f; }

Plane grey(OpenPicture& file) {
  ColourChannels from = colour_channels(file.spec.channelnames, file.spec.alpha_channel);
  from.alpha = -1;
  const cv::Mat data = float_channels(file, from.first(), from.last());
  from = from.shifted(-from.first());
  Plane plane(data.size());
  for (int y = 0; y < data.rows; ++y) {
    const float* in = data.ptr<float>(y);
    for (int x = 0; x < data.cols; ++x, in += data.channels())
      plane(y, x) = share(luma(in[from.red], in[from.green], in[from.blue]));
  }
  return plane;
}

Plane one_channel(OpenPicture& file, int channel) {
  Plane plane = float_channels(file, channel, channel + 1);
  for (float& value : plane) value = share(value);
  return plane;
}

bool says_nothing(const Plane& alpha) {
  return std::all_of(alpha.begin(), alpha.end(), [](float a) { return a == 1; });
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

template <class Stored>
int label(const Stored* pixel, int channels, const std::string& path) {
  const double value = static_cast<double>(pixel[0]);
  const bool whole = value >= 0 && value <= std::numeric_limits<int>::max() && value == std::floor(value);
  if (whole && std::all_of(pixel, pixel + channels, [&](Stored other) { return other == pixel[0]; }))
    return static_cast<int>(value);
  if (whole) throw BadInput(path + ": a coloured picture is not a label map (one channel of whole numbers)");
  std::ostringstream sentence;
  sentence << path << ": " << value << " is not a label (a whole number from 0 to 2147483647)";
  throw BadInput(sentence.str());
}

template <class Stored>
Labels labels_stored_as(OpenPicture& file, OIIO::TypeDesc type) {
  ColourChannels from = colour_channels(file.spec.channelnames, file.spec.alpha_channel);
  from.alpha = -1;
  const cv::Mat stored = stored_channels(file, from.first(), from.last(), type);
  Labels labels(stored.size());
  for (int y = 0; y < stored.rows; ++y) {
    const Stored* pixel = stored.ptr<Stored>(y);
    for (int x = 0; x < stored.cols; ++x, pixel += stored.channels())
      labels(y, x) = label(pixel, stored.channels(), file.path);
  }
  return labels;
}

Labels stored_labels(OpenPicture& file) {
  const OIIO::TypeDesc type = file.spec.format;
  if (type == OIIO::TypeUInt8) return labels_stored_as<unsigned char>(file, type);
  if (type == OIIO::TypeUInt16) return labels_stored_as<unsigned short>(file, type);
  if (type == OIIO::TypeInt16) return labels_stored_as<short>(file, type);
  if (type == OIIO::TypeUInt32) return labels_stored_as<unsigned>(file, type);
  if (type == OIIO::TypeInt32) return labels_stored_as<int>(file, type);
  return labels_stored_as<float>(file, OIIO::TypeFloat);
}

}  // namespace

FileFacts inspect_picture(const std::string& path) {
  const OpenPicture file = open_picture(path);
  FileFacts facts{file.size.width,          file.size.height,          file.spec.nchannels,
                  file.spec.format.c_str(), file.input->format_name(), file.spec.channelnames};
  if (file.orientation >= 5) std::swap(facts.width, facts.height);
  return facts;
}

Picture read_picture(const std::string& path, ColourSpace colour_space) {
  OpenPicture file = open_picture(path);
  ColourChannels from = colour_channels(file.spec.channelnames, file.spec.alpha_channel);
  const cv::Mat data = float_channels(file, from.first(), from.last());
  from = from.shifted(-from.first());

  const bool straight = file.spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
  const bool linear = is_linear(colour_space, file);
  Rgba image(data.size());
  std::atomic<long long> bad{0};
  parallel_rows(data.rows, grain, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      cv::Vec4f* row = image[y];
      bad += gather(data.ptr<float>(y), data.channels(), from, row, data.cols);
      if (straight) premultiply(row, data.cols);
      if (linear) scene_to_display(row->val, row->val, data.cols);
    }
  });

  Picture picture;
  picture.image = upright(placed(image, file), file.orientation);
  picture.has_alpha = (from.alpha >= 0 || !file.covers_picture()) && any_alpha_below_one(picture.image);
  picture.bad_pixels = bad;
  return picture;
}

Plane read_matte(const std::string& path, const std::string& channel) {
  OpenPicture file = open_picture(path);
  const int index = channel.empty() ? -1 : channel_named(file.spec.channelnames, channel);
  const bool default_name = channel.empty() || channel == "A";
  if (index < 0 && !default_name)
    throw BadInput(path + ": " + channel + " is not one of its channels (" + listed(file.spec.channelnames) + ")");
  Plane plane;
  if (index >= 0) plane = one_channel(file, index);
  if (plane.empty() || (channel == "A" && file.spec.nchannels > 1 && says_nothing(plane))) plane = grey(file);
  return upright(placed(plane, file), file.orientation);
}

Labels read_labels(const std::string& path) {
  OpenPicture file = open_picture(path);
  return upright(placed(stored_labels(file), file), file.orientation);
}

}  // namespace stillwater
