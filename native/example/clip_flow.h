#pragma once

#include "core/progress.h"
#include "example/half_frames.h"
#include "flow/optical_flow.h"

namespace stillwater {

enum class ClipFlow {
  dense,    ///< optical_flow() everywhere
  features  ///< 100 corners a frame, followed by Lucas and Kanade's pyramid; spread by phi(r) = r: as published
};

/// "dense", "features". Throws BadInput for another name.
ClipFlow clip_flow_named(const std::string& name);

/// The mean velocity of what moves in a clip (v of Okabe et al. 2009, 3):
///
///     v = mean over i of the flow from D_i to D_{i+1},    D_i = F_i - A
///
/// of the differences from the average, so that a background that shows through does not hold the flow back. Where nothing
/// is seen nothing is known of it: each pixel of each pair counts by how much |grad D|^2 there is around it, and by which share of
/// what is around it is found again where the flow says; what hardly ever has any takes what its surroundings say. Features that are found again when
/// followed back count equally, in a mean over places 8 px wide.
///
/// Gives px per frame. Throws BadInput for fewer than 2 frames, or sides below 16 px.
Field mean_clip_flow(const HalfFrames& differences, ClipFlow method, FlowQuality quality, Progress& progress);

}  // namespace stillwater
