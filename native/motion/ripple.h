#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/image.h"
#include "layers/displacement.h"
#include "motion/spectrum.h"
#include "motion/view.h"
#include "motion/wind.h"

/// Water: a plane of waves, seen in perspective (Chuang et al. 2005, 3.3).
///
///     d(p, t) = project( unproject(p) raised by h ) - p        forward displacement
///
/// With r the ray of p, n the up direction and kappa = h s / height, the raised point is seen at r + kappa n. The
/// height is averaged over the footprint of each pixel (ripmap.h), so that waves die towards the horizon where the
/// pixels can't show them; on and above the horizon there is no displacement.
namespace stillwater {

enum class RippleMode { height, normal };

/// By the recipe's names: "height", "normal". Throws BadInput.
RippleMode ripple_mode_named(const std::string& name);
std::string name_of(RippleMode mode);

/// The recipe's `ripple`, with its animated numbers resolved.
struct Ripple {
  double amplitude = 1;   ///< 1: the significant height of a grown sea at this wind
  double roughness = 1;   ///< how many times the tile is repeated over the same water
  double tile = 60;       ///< metres
  int resolution = 256;
  RippleMode mode = RippleMode::height;
  Spectrum spectrum = Spectrum::phillips;
  double fetch = 100;     ///< km
  double depth = 200;     ///< m
  std::uint64_t seed = 0;
};

/// The share of the picture's width by which mode "normal" displaces for a slope of 1.
inline constexpr double pixels_per_slope = 0.04;

class RippleMotion {
 public:
  /// `region`: where the motion will mostly be asked (picture pixels); elsewhere the answer is the same, but slower.
  /// Throws BadInput.
  RippleMotion(const Ripple& ripple, const View& view, const Wind& wind, cv::Size picture, cv::Rect region);
  ~RippleMotion();
  RippleMotion(RippleMotion&&) noexcept;
  RippleMotion& operator=(RippleMotion&&) noexcept;

  /// The water at one moment, under that moment's wind and with its amplitude. Any thread may ask; the last two
  /// moments are kept.
  std::shared_ptr<const Displacement> at(const Moment& moment, const Ripple& now) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stillwater
