#include "picture/clip.h"

#include <opencv2/imgproc.hpp>
#include <string_view>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "picture/openimageio.h"

namespace stillwater {

struct Clip::State {
  std::string path;
  std::unique_ptr<OIIO::ImageInput> input;
  int frames = 0;
  double fps = 0;
  int decoded = 0;  ///< the frame the reader stands at

  void open();
  void decode_up_to(int number);
};

void Clip::State::open() {
  input = open_file(path);
  if (std::string_view(input->format_name()) != "FFmpeg movie") throw FileError(path + ": is a picture, not a clip");
  decoded = 0;
}

/// One scanline of a frame is enough for the reader to decode it.
void Clip::State::decode_up_to(int number) {
  if (number < decoded) open();
  std::vector<unsigned char> scanline(input->spec().scanline_bytes(true));
  while (decoded < number) {
    if (!input->read_native_scanline(decoded, 0, 0, 0, scanline.data()))
      fail(path, "frame " + std::to_string(decoded + 1) + " cannot be decoded", input->geterror());
    ++decoded;
  }
}

Clip::Clip(const std::string& path) : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->open();
  const OIIO::ImageSpec& spec = state_->input->spec();
  check::size(path, spec.width, spec.height);
  state_->frames = spec.get_int_attribute("oiio:subimages");
  if (state_->frames < 1) throw FileError(path + ": has no frames");
  int rate[2] = {0, 1};
  spec.getattribute("FramesPerSecond", OIIO::TypeRational, rate);
  state_->fps = rate[1] > 0 ? static_cast<double>(rate[0]) / rate[1] : 0;
}

Clip::~Clip() = default;
Clip::Clip(Clip&&) noexcept = default;
Clip& Clip::operator=(Clip&&) noexcept = default;

int Clip::frames() const { return state_->frames; }
double Clip::fps() const { return state_->fps; }
int Clip::width() const { return state_->input->spec().width; }
int Clip::height() const { return state_->input->spec().height; }

cv::Mat_<cv::Vec3f> Clip::frame(int number, int wanted_width, int wanted_height) {
  check::in_range("frames", number, 1, frames());
  check::size("size", wanted_width, wanted_height);
  state_->decode_up_to(number);
  const int channels = std::min(state_->input->spec().nchannels, 3);
  cv::Mat stored(height(), width(), CV_MAKETYPE(CV_32F, channels));
  if (!state_->input->read_image(number - 1, 0, 0, channels, OIIO::TypeFloat, stored.data))
    fail(state_->path, "frame " + std::to_string(number) + " cannot be decoded", state_->input->geterror());

  if (channels < 3) cv::cvtColor(stored, stored, cv::COLOR_GRAY2RGB);
  const bool smaller = wanted_width <= width() && wanted_height <= height();
  cv::Mat_<cv::Vec3f> resized;
  cv::resize(stored, resized, {wanted_width, wanted_height}, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  return resized;
}

}  // namespace stillwater
