#include "picture/clip.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/check.h"
#include "core/error.h"
#include "picture/video_stream.h"

namespace stillwater {
namespace {

double longest_of_usual(const std::vector<double>& times) {
  std::vector<double> gaps;
  for (size_t i = 1; i < times.size() && std::isfinite(times[i]); ++i) gaps.push_back(times[i] - times[i - 1]);
  if (gaps.empty()) return 1;
  std::sort(gaps.begin(), gaps.end());
  const double usual = gaps[gaps.size() / 2];
  return usual > 0 ? gaps.back() / usual : 1;
}

}  // namespace

struct Clip::State {
  explicit State(const std::string& name) : path(name), stream(name) {}

  void decode_up_to(int number);

  std::string path;
  VideoStream stream;
  int frames = 0;
  double longest_gap = 1;
  bool seen_transparent = false;
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
  const std::vector<double> times = VideoStream(path).times_to_end();
  state_->frames = static_cast<int>(times.size());
  state_->longest_gap = longest_of_usual(times);
  if (state_->frames < 1) throw FileError(path + ": has no frames");
}

Clip::~Clip() = default;
Clip::Clip(Clip&&) noexcept = default;
Clip& Clip::operator=(Clip&&) noexcept = default;

int Clip::frames() const { return state_->frames; }
double Clip::fps() const { return state_->stream.fps(); }
double Clip::longest_gap() const { return state_->longest_gap; }
bool Clip::seen_transparent() const { return state_->seen_transparent; }
int Clip::width() const { return state_->stream.width(); }
int Clip::height() const { return state_->stream.height(); }

cv::Mat_<cv::Vec3f> Clip::frame(int number, int wanted_width, int wanted_height) {
  check::in_range("frames", number, 1, frames());
  check::size("size", wanted_width, wanted_height);
  state_->decode_up_to(number);
  const cv::Mat_<cv::Vec3f> stored = state_->stream.frame();
  state_->seen_transparent = state_->seen_transparent || state_->stream.seen_transparent();
  const bool smaller = wanted_width <= stored.cols && wanted_height <= stored.rows;
  cv::Mat_<cv::Vec3f> resized;
  cv::resize(stored, resized, {wanted_width, wanted_height}, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  return resized;
}

}  // namespace stillwater
