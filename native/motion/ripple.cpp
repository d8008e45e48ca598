#include "motion/ripple.h"

#include <array>
#include <cmath>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "core/check.h"
#include "motion/ripmap.h"
#include "motion/view.h"
#include "motion/water_displacement.h"
#include "motion/waves.h"

namespace stillwater {
namespace {

constexpr int kept_moments = 2;

WaveTile tile_of(const Ripple& ripple) {
  WaveTile tile;
  tile.side = ripple.tile;
  tile.resolution = ripple.resolution;
  tile.spectrum = ripple.spectrum;
  tile.fetch = ripple.fetch;
  tile.depth = ripple.depth;
  tile.seed = ripple.seed;
  tile.spline = true;
  return tile;
}

/// Seconds since frame 1, or periods since the loop's start.
double wave_time(const Moment& moment) {
  if (moment.loop_frames == 0) return moment.seconds();
  return std::fmod(moment.frame - moment.first_frame, moment.loop_frames) / moment.loop_frames;
}

/// All that a moment's displacement depends on, beside what the constructor was given.
using Key = std::array<double, 5>;

}  // namespace

struct RippleMotion::State {
  Ripple ripple;
  WaterPlane plane;
  cv::Size picture;
  cv::Rect region;

  State(const Ripple& r, const WaterPlane& p, cv::Size size, cv::Rect asked) : ripple(r), plane(p), picture(size), region(asked) {}

  std::mutex mutex;  // guards all below
  std::optional<Waves> waves;
  double period = 0;
  std::deque<std::pair<Key, std::shared_ptr<const Displacement>>> kept;

  WaterSurface surface_at(const Moment& moment, double amplitude);
};

WaterSurface RippleMotion::State::surface_at(const Moment& moment, double amplitude) {
  const double wanted = moment.loop_frames / moment.fps;
  if (!waves || wanted != period) waves.emplace(tile_of(ripple), wanted);
  period = wanted;
  waves->blow(moment.wind.speed, moment.wind.direction);
  const auto tile = [&](Waves::Quantity quantity) {
    return std::make_shared<const Ripmap>(waves->at(wave_time(moment), quantity));
  };
  WaterSurface surface;
  surface.samples_per_metre = ripple.resolution * ripple.roughness / ripple.tile;
  surface.side = ripple.resolution;
  surface.amplitude = amplitude;
  if (ripple.mode == RippleMode::height) {
    surface.heights = tile(Waves::Quantity::height);
  } else {
    surface.amplitude *= ripple.roughness;  // the same heights over shorter ways
    surface.slopes_right = tile(Waves::Quantity::slope_right);
    surface.slopes_away = tile(Waves::Quantity::slope_away);
  }
  return surface;
}

RippleMotion::RippleMotion(const Ripple& ripple, const View& view, const Wind&, cv::Size picture, cv::Rect region) {
  check::in_range("roughness", ripple.roughness, 1e-4, 1e4);
  check::in_range("tile", ripple.tile, 10, 2000, "m");
  state_ = std::make_unique<State>(ripple, WaterPlane(view, picture), picture, region);
}

RippleMotion::~RippleMotion() = default;
RippleMotion::RippleMotion(RippleMotion&&) noexcept = default;
RippleMotion& RippleMotion::operator=(RippleMotion&&) noexcept = default;

std::shared_ptr<const Displacement> RippleMotion::at(const Moment& moment, const Ripple& now) const {
  check::in_range("amplitude", now.amplitude, 0, 1000);
  const Key key{wave_time(moment), moment.loop_frames / moment.fps, moment.wind.speed, moment.wind.direction, now.amplitude};
  const std::lock_guard lock(state_->mutex);
  for (const auto& [kept_key, displacement] : state_->kept)
    if (kept_key == key) return displacement;
  auto displacement = std::make_shared<const WaterDisplacement>(
      state_->plane, state_->surface_at(moment, now.amplitude), state_->picture, state_->region);
  state_->kept.emplace_front(key, displacement);
  if (state_->kept.size() > kept_moments) state_->kept.pop_back();
  return displacement;
}

}  // namespace stillwater
