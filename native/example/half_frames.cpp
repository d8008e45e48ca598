#include "example/half_frames.h"

#include "core/check.h"

namespace stillwater {

HalfFrames::HalfFrames(void* halves, int frames, cv::Size size) : halves_(halves), count_(frames), size_(size) {
  check::in_range("frames", frames, 1, 1e6);
  check::size("frames", size.width, size.height);
}

cv::Mat HalfFrames::at(int frame) const {
  const auto start = static_cast<size_t>(frame) * size_.area() * 3;
  return {size_, CV_16FC3, static_cast<unsigned short*>(halves_) + start};
}

Rgb HalfFrames::read(int frame) const {
  Rgb colours;
  at(frame).convertTo(colours, CV_32F);
  return colours;
}

void HalfFrames::write(int frame, const Rgb& colours) {
  cv::Mat place = at(frame);
  colours.convertTo(place, CV_16F);
}

}  // namespace stillwater
