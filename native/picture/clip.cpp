#include "picture/clip.h"

#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/error.h"
#include "picture/video_stream.h"

namespace stillwater {

struct Clip::State {
  explicit State(const std::string& name) : path(name), stream(name) {}

  void decode_up_to(int number);

  std::string path;
  VideoStream stream;
  int frames = 0;
  int decoded = 0;  ///< the frame the stream stands at
};

void Clip::State::decode_up_to(int number) {
  if (number < decoded) {
    stream = VideoStream(path);
    decoded = 0;
  }
  for (; decoded < number; ++decoded)
    if (!stream.advance()) throw FileError(path + ": frame " + std::to_string(decoded + 1) + " cannot be decoded");
}

Clip::Clip(const std::string& path) : state_(std::make_unique<State>(path)) {
  check::size(path, width(), height());
  state_->frames = VideoStream(path).count_to_end();
  if (state_->frames < 1) throw FileError(path + ": has no frames");
}

Clip::~Clip() = default;
Clip::Clip(Clip&&) noexcept = default;
Clip& Clip::operator=(Clip&&) noexcept = default;

int Clip::frames() const { return state_->frames; }
double Clip::fps() const { return state_->stream.fps(); }
int Clip::width() const { return state_->stream.width(); }
int Clip::height() const { return state_->stream.height(); }

cv::Mat_<cv::Vec3f> Clip::frame(int number, int wanted_width, int wanted_height) {
  check::in_range("frames", number, 1, frames());
  check::size("size", wanted_width, wanted_height);
  state_->decode_up_to(number);
  const cv::Mat_<cv::Vec3f> stored = state_->stream.frame();
  const bool smaller = wanted_width <= stored.cols && wanted_height <= stored.rows;
  cv::Mat_<cv::Vec3f> resized;
  cv::resize(stored, resized, {wanted_width, wanted_height}, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  return resized;
}

}  // namespace stillwater
