#pragma once

#include <array>

#include "core/image.h"

namespace stillwater {

/// Which share of what is seen moves, by its size: a frame of a fluid is its average, which has detail of its own, and what
/// changes. Bands lie between blurs of sigma 0, 1.5, 4 and 10 px of the clip, finest first.
///
///     share = E[band(D)^2] / (E[band(D)^2] + E[band(A)^2])        means weighted by where the residuals' energy is
///
/// Okabe et al. 2009 let all of the picture's detail move: then a film is livelier than its clip, by what in the clip stands.
constexpr int share_bands = 3;
using MovingShares = std::array<double, share_bands>;
inline constexpr std::array<double, share_bands> share_sigmas{1.5, 4, 10};

/// Mean squares of each band of a plane, under weights.
MovingShares band_squares(const Plane& plane, const Plane& weight);

/// What of the picture's detail stands: each band of `difference` times the root of 1 - share. `scale`: pixels for one of the
/// clip.
Rgb standing_part(const Rgb& difference, const MovingShares& shares, double scale);

}  // namespace stillwater
