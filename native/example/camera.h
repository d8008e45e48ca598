#pragma once

#include <vector>

#include "core/progress.h"
#include "example/half_frames.h"

namespace stillwater {

/// Where the whole of each frame lies, minus where the first one does, px: from frame to frame by phase correlation (Kuglin and
/// Hines 1975) of luma under a Hann window, with a frame's parts voting: of nine parts that overlap the median, so that what
/// moves in some of them does not count as the camera's.
std::vector<Point> camera_path(const HalfFrames& frames, Progress& progress);

/// Moves each frame back by what its path is off a straight one: shake goes, a pan stays (it can't be told from a fluid that
/// fills the picture). Catmull-Rom, beyond the sides mirrored. Gives the largest way that a frame was moved, px.
double hold_camera(HalfFrames& frames, const std::vector<Point>& path);

}  // namespace stillwater
