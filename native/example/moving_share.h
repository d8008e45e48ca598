#pragma once

#include <array>
#include <vector>

#include "core/image.h"

namespace stillwater {

/// Which share of what is seen moves, by its size and place by place: a frame of a fluid is its average, which has detail of
/// its own, and what changes. Bands lie between blurs of sigma 0, 1.5, 4 and 10 px of the clip, finest first.
///
///     share = E[band(D)^2] / (E[band(D)^2] + E[band(A)^2])        means over time, and around each place (sigma 24 px)
///
/// weighted by where the residuals' energy is: a rock in the water says little of the water.
///
/// Okabe et al. 2009 let all of the picture's detail move: then a film is livelier than its clip, by what in the clip stands.
constexpr int share_bands = 3;
inline constexpr std::array<double, share_bands> share_sigmas{1.5, 4, 10};

/// A channel for each band, 0..1; 1 where nothing is seen at all. `differences`: luma of D at some moments, at least one;
/// `average`: luma of A, and `energy`: of the residuals, of the same size.
Rgb moving_shares(const std::vector<Plane>& differences, const Plane& average, const Plane& energy);

/// What of the picture's detail stands: each band of `difference` times the root of 1 - share. `shares`: of the picture's
/// pixels; `scale`: pixels for one of the clip.
Rgb standing_part(const Rgb& difference, const Rgb& shares, double scale);

}  // namespace stillwater
