#include "flow/flow_map.h"

#include "core/check.h"
#include "core/parallel.h"
#include "flow/streamline.h"
#include "layers/displace.h"

namespace stillwater {
namespace {

constexpr double longest_time = 10'000;  // frames

template <class Frames>
Field mapped(const Field& velocity, const Frames& frames_at) {
  const SteadyFlow flow(velocity);
  Field map(velocity.size());
  parallel_pixels(map.size(), [&](int y, int x) {
    const cv::Vec2d here(x, y);
    map(y, x) = flow.carried(here, frames_at(y, x)) - here;
  });
  return map;
}

}  // namespace

Field flow_map(const Field& velocity, double frames) {
  check::in_range("frames", frames, -longest_time, longest_time);
  return mapped(velocity, [frames](int, int) { return frames; });
}

Field flow_map(const Field& velocity, const Plane& frames) {
  check::same_size("frames", frames, "velocity", velocity);
  check::each_in_range("frames", frames, -longest_time, longest_time);
  return mapped(velocity, [&frames](int y, int x) { return static_cast<double>(frames(y, x)); });
}

Rgba advect(const Rgba& image, const Field& velocity, double frames) {
  check::same_size("velocity", velocity, "image", image);
  return displace(image, flow_map(velocity, -frames));
}

}  // namespace stillwater
