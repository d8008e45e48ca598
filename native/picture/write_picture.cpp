#include "picture/write_picture.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "picture/colour.h"
#include "picture/picture_file.h"

namespace stillwater {
namespace {

struct Format {
  std::string extension, name;
  std::vector<int> bits;  ///< allowed; the first is the default
};

const Format& format_of(const std::string& path) {
  static const std::vector<Format> formats{
      {".png", "PNG", {8, 16}},      {".jpg", "JPEG", {8}},          {".jpeg", "JPEG", {8}},
      {".tif", "TIFF", {8, 16, 32}}, {".tiff", "TIFF", {8, 16, 32}}, {".exr", "OpenEXR", {16, 32}},
  };
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Format& format : formats)
    if (format.extension == extension) return format;
  throw BadInput(path + ": its extension is not .png, .jpg, .jpeg, .tif, .tiff or .exr");
}

int bits_for(const Format& format, int wish) {
  if (wish == 0) return format.bits.front();
  if (std::find(format.bits.begin(), format.bits.end(), wish) != format.bits.end()) return wish;
  std::string allowed;
  for (const int bits : format.bits) allowed += (allowed.empty() ? "" : ", ") + std::to_string(bits);
  throw BadInput("bits: " + std::to_string(wish) + " is not what " + format.name + " has (" + allowed + ")");
}

OIIO::TypeDesc stored_type(const Format& format, int bits) {
  if (format.name == "OpenEXR") return bits == 16 ? OIIO::TypeHalf : OIIO::TypeFloat;
  if (bits == 32) return OIIO::TypeFloat;
  return bits == 8 ? OIIO::TypeUInt8 : OIIO::TypeUInt16;
}

bool any_alpha_below_one(const Rgba& image) {
  return std::any_of(image.begin(), image.end(), [](const cv::Vec4f& p) { return p[3] < 1; });
}

OIIO::ImageSpec header(const Format& format, const Rgba& image, OIIO::TypeDesc type) {
  const bool exr = format.name == "OpenEXR";
  const bool alpha = exr || (format.name != "JPEG" && any_alpha_below_one(image));
  OIIO::ImageSpec spec(image.cols, image.rows, alpha ? 4 : 3, type);
  if (alpha && !exr) spec.attribute("oiio:UnassociatedAlpha", 1);
  // Not for TIFF: it would become a directory of its own (EXIF), for which the writer must read the file again.
  if (format.name != "TIFF") spec.attribute("oiio:ColorSpace", exr ? "Linear" : "sRGB");
  if (exr) spec.attribute("compression", "zip");
  if (format.name == "TIFF") spec.attribute("compression", "lzw");
  if (format.name == "JPEG") {
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4");
  }
  return spec;
}

/// A share of 0..1 as a whole number of `most`, or as it is where most is 0.
float stored_value(float value, float most) {
  const float share = std::clamp(value, 0.0f, 1.0f);
  return most > 0 ? std::floor(share * most + 0.5f) : value;
}

/// What stands in the file: straight display-referred channels, of 0..most.
std::vector<float> display_values(const Rgba& image, int channels, float most) {
  std::vector<float> values(image.total() * channels);
  parallel_rows(image.rows, 32, [&](int first, int last) {
    float* out = values.data() + static_cast<std::size_t>(first) * image.cols * channels;
    for (int y = first; y < last; ++y) {
      for (const cv::Vec4f* p = image[y]; p < image[y] + image.cols; ++p, out += channels) {
        const float cover = channels == 4 && (*p)[3] > 0 ? (*p)[3] : 1.0f;
        for (int c = 0; c < 3; ++c) out[c] = stored_value((*p)[c] / cover, most);
        if (channels == 4) out[3] = stored_value((*p)[3], most);
      }
    }
  });
  return values;
}

std::vector<float> scene_values(const Rgba& image) {
  std::vector<float> values(image.total() * 4);
  parallel_rows(image.rows, 32, [&](int first, int last) {
    for (int y = first; y < last; ++y)
      display_to_scene(image[y]->val, values.data() + static_cast<std::size_t>(y) * image.cols * 4, image.cols);
  });
  return values;
}

template <class Stored>
std::vector<Stored> rounded(const std::vector<float>& values) {
  std::vector<Stored> stored(values.size());
  std::transform(values.begin(), values.end(), stored.begin(), [](float v) { return static_cast<Stored>(v); });
  return stored;
}

bool write_pixels(OIIO::ImageOutput& output, const Rgba& image, OIIO::TypeDesc type) {
  const int channels = output.spec().nchannels;
  if (type == OIIO::TypeUInt8)
    return output.write_image(type, rounded<unsigned char>(display_values(image, channels, 255)).data());
  if (type == OIIO::TypeUInt16)
    return output.write_image(type, rounded<unsigned short>(display_values(image, channels, 65535)).data());
  if (std::string_view(output.format_name()) != "openexr")
    return output.write_image(type, display_values(image, channels, 0).data());
  std::vector<float> scene = scene_values(image);
  if (type == OIIO::TypeFloat) return output.write_image(type, scene.data());
  std::vector<std::uint16_t> halves(scene.size());
  to_half(scene.data(), halves.data(), halves.size());
  return output.write_image(type, halves.data());
}

}  // namespace

void write_picture(const std::string& path, const Rgba& image, int bits) {
  check::not_empty("image", image);
  check::size("image", image.cols, image.rows);
  const Format& format = format_of(path);
  const OIIO::TypeDesc type = stored_type(format, bits_for(format, bits));
  PictureFile file(path, format.extension.substr(1), header(format, image, type));
  file.write([&](OIIO::ImageOutput& output) { return write_pixels(output, image, type); });
  file.finish();
}

}  // namespace stillwater
