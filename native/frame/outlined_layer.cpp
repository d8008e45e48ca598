#include "frame/outlined_layer.h"

#include <algorithm>

namespace stillwater {
namespace {

// So far beyond the plate's sides its last pixel holds: a plate may be half a pixel smaller than the output has it.
constexpr float beyond = 0.75f;

}  // namespace

const cv::Vec4f* OutlinedLayer::draw(const Run& run, const unsigned char* needed, cv::Vec4f* room) const {
  const SampledRun at(plate_, nullptr, run);
  float covered[Run::longest];
  bool any = false;
  for (int i = 0; i < run.count; ++i) {
    covered[i] = needed[i] ? coverage(at.x[i], at.y[i]) : 0;
    any = any || covered[i] > 0;
  }
  const cv::Vec4f* colours = any ? inside_->draw(run, needed, room) : nullptr;
  if (!colours) return nullptr;
  for (int i = 0; i < run.count; ++i) room[i] = needed[i] ? covered[i] * colours[i] : cv::Vec4f();
  return room;
}

float OutlinedLayer::coverage(float x, float y) const {
  const auto last = static_cast<float>(outline_.cols - 1), lowest = static_cast<float>(outline_.rows - 1);
  if (x < -beyond || x > last + beyond || y < -beyond || y > lowest + beyond) return 0;
  x = std::clamp(x, 0.0f, last);
  y = std::clamp(y, 0.0f, lowest);
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const int right = std::min(left + 1, outline_.cols - 1);
  const unsigned char *upper = outline_[top], *lower = outline_[std::min(top + 1, outline_.rows - 1)];
  const float across = x - static_cast<float>(left), down = y - static_cast<float>(top);
  const float above = static_cast<float>(upper[left]) + across * static_cast<float>(upper[right] - upper[left]);
  const float below = static_cast<float>(lower[left]) + across * static_cast<float>(lower[right] - lower[left]);
  return (above + down * (below - above)) / 255;
}

}  // namespace stillwater
