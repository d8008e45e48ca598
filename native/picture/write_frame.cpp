#include "picture/write_frame.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "picture/colour.h"
#include "picture/picture_file.h"

namespace stillwater {
namespace {

constexpr std::array compressions{"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};
constexpr std::array<float, 8> rec709{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
constexpr const char* zip_level = ":2";  // OpenImageIO's usual 4 takes a fifth more time, saves a tenth of the size
constexpr std::size_t most_bytes = 64 << 20;  // held at a time in the file's formats
constexpr int rows_together = 256;            // a multiple of every compression's block of rows

void require_valid(const FrameImages& images, const FrameOptions& options) {
  check::not_empty("combined", images.combined);
  check::size("combined", images.combined.cols, images.combined.rows);
  if (!images.flow.empty()) check::same_size("flow", images.flow, "combined", images.combined);
  if (!images.matte.empty()) check::same_size("matte", images.matte, "combined", images.combined);
  for (const NamedImage& layer : images.layers) check::same_size(layer.name, layer.image, "combined", images.combined);
  if (std::find(compressions.begin(), compressions.end(), options.compression) == compressions.end())
    throw BadInput("compression: " + options.compression +
                   " is not none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa or dwab");
}

bool is_zip(const std::string& compression) { return compression == "zip" || compression == "zips"; }

OIIO::ImageSpec header(const FrameImages& images, const FrameOptions& options) {
  const OIIO::TypeDesc colour = options.half ? OIIO::TypeHalf : OIIO::TypeFloat;
  OIIO::ImageSpec spec(images.combined.cols, images.combined.rows, 0, colour);
  const auto add = [&](const std::string& layer, const char* channels, OIIO::TypeDesc type) {
    for (; *channels; ++channels) {
      spec.channelnames.push_back(layer + *channels);
      spec.channelformats.push_back(type);
    }
  };
  add("", "RGBA", colour);
  add("Stillwater.Combined.", "RGBA", colour);
  add("Stillwater.Flow.", "XYZ", OIIO::TypeFloat);
  add("Stillwater.Matte.", "V", colour);
  std::vector<std::string> names;
  for (const NamedImage& layer : images.layers) names.push_back(layer.name);
  for (const std::string& name : layer_names(names)) add(name + ".Combined.", "RGBA", colour);
  spec.nchannels = static_cast<int>(spec.channelnames.size());
  spec.attribute("compression", options.compression + (is_zip(options.compression) ? zip_level : ""));
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709.data());
  spec.attribute("DateTime", "");  // else the time of writing, and no two frames would be the same bytes
  if (!options.key.empty()) spec.attribute("stillwater:key", options.key);
  return spec;
}

/// One row in the file's formats: pixels one after the other, each with all its channels.
class PackedRow {
 public:
  PackedRow(unsigned char* row, int pixels, std::size_t pixel_bytes, bool half)
      : row_(row), pixels_(pixels), pixel_bytes_(pixel_bytes), half_(half) {}

  /// The next `channels` channels of each pixel, in the depth of colours; `copies` times one after the other.
  void add_colours(const float* values, int channels, int copies = 1) {
    for (int copy = 0; copy < copies && !half_; ++copy) add_floats(values, channels);
    if (!half_) return;
    halves_.resize(static_cast<std::size_t>(pixels_) * channels);
    to_half(values, halves_.data(), halves_.size());
    for (int copy = 0; copy < copies; ++copy) scatter(halves_.data(), channels * sizeof(std::uint16_t));
  }

  void add_floats(const float* values, int channels) { scatter(values, channels * sizeof(float)); }

 private:
  void scatter(const void* values, std::size_t bytes) {
    const auto* in = static_cast<const unsigned char*>(values);
    unsigned char* out = row_ + filled_;
    for (int x = 0; x < pixels_; ++x, in += bytes, out += pixel_bytes_) std::memcpy(out, in, bytes);
    filled_ += bytes;
  }

  unsigned char* row_;
  int pixels_;
  std::size_t pixel_bytes_, filled_ = 0;
  bool half_;
  std::vector<std::uint16_t> halves_;
};

void pack(const FrameImages& images, int y, PackedRow& row) {
  const int width = images.combined.cols;
  std::vector<float> values(static_cast<std::size_t>(width) * 4);
  const auto add_image = [&](const Rgba& image, int copies) {
    display_to_scene(image[y]->val, values.data(), width);
    row.add_colours(values.data(), 4, copies);
  };
  add_image(images.combined, 2);

  std::vector<float> flow(static_cast<std::size_t>(width) * 3, 0.0f);
  for (int x = 0; x < width && !images.flow.empty(); ++x) {
    flow[3 * x] = images.flow(y, x)[0];
    flow[3 * x + 1] = images.flow(y, x)[1];
  }
  round_mantissa(flow.data(), flow.data(), flow.size());
  row.add_floats(flow.data(), 3);

  const std::vector<float> none(images.matte.empty() ? width : 0, 0.0f);
  row.add_colours(images.matte.empty() ? none.data() : images.matte[y], 1);
  for (const NamedImage& layer : images.layers) add_image(layer.image, 1);
}

int rows_at_a_time(int height, std::size_t row_bytes) {
  const auto fitting = static_cast<int>(std::min<std::size_t>(height, most_bytes / row_bytes));
  return fitting >= height ? height : std::max(rows_together, fitting / rows_together * rows_together);
}

void write_rows(PictureFile& file, std::size_t pixel_bytes, const FrameImages& images, bool half) {
  const int width = images.combined.cols, height = images.combined.rows;
  const std::size_t row_bytes = pixel_bytes * width;
  const int step = rows_at_a_time(height, row_bytes);
  std::vector<unsigned char> packed(row_bytes * step);
  for (int begin = 0; begin < height; begin += step) {
    const int end = std::min(height, begin + step);
    parallel_rows(end - begin, 16, [&](int first, int last) {
      for (int y = first; y < last; ++y) {
        PackedRow row(packed.data() + row_bytes * y, width, pixel_bytes, half);
        pack(images, begin + y, row);
      }
    });
    file.write([&](OIIO::ImageOutput& output) {
      return output.write_scanlines(begin, end, 0, OIIO::TypeUnknown, packed.data());
    });
  }
}

}  // namespace

void write_frame(const std::string& path, const FrameImages& images, const FrameOptions& options) {
  require_valid(images, options);
  const OIIO::ImageSpec spec = header(images, options);
  PictureFile file(path, "exr", spec);
  write_rows(file, spec.pixel_bytes(true), images, options.half);
  file.finish();
}

std::string read_frame_key(const std::string& path) {
  const auto input = OIIO::ImageInput::open(path);
  if (!input) {
    OIIO::geterror();  // asked for nothing: not to be told to whoever fails next
    return "";
  }
  return input->spec().get_string_attribute("stillwater:key");
}

}  // namespace stillwater
