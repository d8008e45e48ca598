#pragma once

#include <vector>

#include "example/source_map.h"

namespace stillwater {

/// What is known of a clip when a picture takes its residuals.
struct ClipMotion {
  Field velocity;  ///< px per frame of the clip
  Plane energy;    ///< of the residuals, of the same size
};

/// For each patch of a picture's flow, on a grid of half a patch, the place of the clip whose flow is most like it
/// (Okabe et al. 2009, 5.2: "Residual transfer"; METHODS.md 2).
///
/// A patch is described by 5 x 5 vectors of its flow, with its own mean direction turned to the right; the clip's patches by
/// their principal components (all that hold 99 % of the variance), searched exactly by a k-d tree (FLANN). Both flows are
/// measured in multiples of their own median speed, so that a picture painted slower than the clip matches all the same.
/// Of the 24 nearest, of 24 others anywhere, and of the places with which the patches around go on, the one is taken that
/// costs least:
///
///     d + 0.3 (1 - cos turn) + 0.1 (1 - energy, against the clip's 90th percentile, at most 1)
///       + 0.25 (for each laid neighbour that it does not go on with) + 0.02 (for each time that it was taken, of its square)
///
/// d: squared difference of the vectors, as a share of their own squares and a quarter of the median speed's. Patches are
/// laid where they cost least first, and from there on by their neighbours.
///
/// So a patch is turned only where nothing of the clip runs its way; where the flow is uniform, and all places fit, lively
/// and connected ones are taken, not flat ones, and not one again and again. The flow where nothing moves has no direction,
/// and is not turned.
///
/// `velocity`: of the picture, in its px per frame of the clip. The patches come in the order in which they are to be laid:
/// the best matches last, or first. The same for any number of threads; ties take the place that comes first in the clip.
/// Throws BadInput where sizes differ, numbers are not finite, parameters are out of range, or the clip is smaller than a
/// patch.
std::vector<PlacedPatch> match_patches(const Field& velocity, const ClipMotion& clip, const TransferParameters& parameters = {});

}  // namespace stillwater
