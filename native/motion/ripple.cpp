#include "motion/ripple.h"

#include <array>
#include <cmath>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "motion/filtered_water.h"
#include "motion/gusts.h"
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
  return moment.loop_frames == 0 ? moment.seconds() : frames_into_loop(moment) / moment.loop_frames;
}

double loop_seconds(const Moment& moment) { return moment.loop_frames / moment.fps; }

/// All that a moment's water depends on, beside what the constructor was given.
using Key = std::array<double, 8>;

Key key_of(const Moment& moment, double amplitude) {
  const Wind& wind = moment.wind;
  const bool gusty = wind.gusts > 0;
  const Point travel = gusty ? travel_in_loop(wind.travel, moment.loop_travel, moment) : Point{};
  return {wave_time(moment), loop_seconds(moment), wind.speed, wind.direction, amplitude, wind.gusts, travel.x, travel.y};
}

}  // namespace

struct RippleMotion::State {
  State(const Ripple& ripple_, const WaterPlane& plane_, const Wind& wind, cv::Size picture_, cv::Rect region_)
      : ripple(ripple_), plane(plane_), gusts(wind.gust_size, wind.seed, picture_), picture(picture_), region(region_) {}

  Ripple ripple;
  WaterPlane plane;
  GustField gusts;
  cv::Size picture;
  cv::Rect region;

  std::mutex mutex;  // guards all below
  std::optional<Waves> waves;
  double period = 0;
  std::deque<std::pair<Key, std::shared_ptr<const Displacement>>> kept;

  std::shared_ptr<const Displacement> made(const Moment& moment, double amplitude);
};

std::shared_ptr<const Displacement> RippleMotion::State::made(const Moment& moment, double amplitude) {
  if (!waves || loop_seconds(moment) != period) waves.emplace(tile_of(ripple), loop_seconds(moment));
  period = loop_seconds(moment);
  waves->blow(moment.wind.speed, moment.wind.direction);
  const auto local_wind = std::make_shared<const LocalWind>(gusts, moment, plane, picture);
  const TileOnPlane on_plane{ripple.resolution * ripple.roughness / ripple.tile, static_cast<double>(ripple.resolution)};
  const auto filtered = [&](Waves::Quantity quantity, double factor, double ceiling) {
    auto levels = std::make_shared<const Ripmap>(waves->at(wave_time(moment), quantity));
    return FilteredWater(plane, picture, std::move(levels), on_plane, factor, ceiling, local_wind);
  };
  if (ripple.mode == RippleMode::height)
    return std::make_shared<RaisedWater>(plane, picture, region, filtered(Waves::Quantity::height, amplitude, plane.height()));
  const double steeper = amplitude * ripple.roughness;  // the same heights over shorter ways
  return std::make_shared<MirrorWater>(plane, picture, region, filtered(Waves::Quantity::slope_right, steeper, 0),
                                       filtered(Waves::Quantity::slope_away, steeper, 0), pixels_per_slope * picture.width);
}

std::string name_of(RippleMode mode) { return mode == RippleMode::height ? "height" : "normal"; }

RippleMode ripple_mode_named(const std::string& name) {
  for (const RippleMode mode : {RippleMode::height, RippleMode::normal})
    if (name_of(mode) == name) return mode;
  throw BadInput("mode: \"" + name + "\" is not height or normal");
}

RippleMotion::RippleMotion(const Ripple& ripple, const View& view, const Wind& wind, cv::Size picture, cv::Rect region) {
  check::in_range("roughness", ripple.roughness, 1e-4, 1e4);
  check::in_range("tile", ripple.tile, 10, 2000, "m");
  state_ = std::make_unique<State>(ripple, WaterPlane(view, picture), wind, picture, region);
}

RippleMotion::~RippleMotion() = default;
RippleMotion::RippleMotion(RippleMotion&&) noexcept = default;
RippleMotion& RippleMotion::operator=(RippleMotion&&) noexcept = default;

std::shared_ptr<const Displacement> RippleMotion::at(const Moment& moment, const Ripple& now) const {
  check_moment(moment);
  check::in_range("amplitude", now.amplitude, 0, 1000);
  const Key key = key_of(moment, now.amplitude);
  const std::lock_guard lock(state_->mutex);
  for (const auto& [kept_key, displacement] : state_->kept)
    if (kept_key == key) return displacement;
  state_->kept.emplace_front(key, state_->made(moment, now.amplitude));
  if (state_->kept.size() > kept_moments) state_->kept.pop_back();
  return state_->kept.front().second;
}

}  // namespace stillwater
