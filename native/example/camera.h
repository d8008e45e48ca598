#pragma once

#include <vector>

#include "core/progress.h"
#include "example/half_frames.h"

namespace stillwater {

/// Share of pairs of frames (8 apart, 24 pairs at most, spread over the clip) between which the picture moves as one: of nine
/// parts that overlap, at least five move by the same way, within a sixth of it and 0.15 px, and it is 0.5 px or more. A
/// camera that moves, or a fluid that fills the picture and flows evenly: the two can't be told apart.
double moves_as_one(const HalfFrames& frames);

/// Where the whole of each frame lies, minus where the first one does, px: from frame to frame by phase correlation (Kuglin and
/// Hines 1975) of luma under a Hann window, with a frame's parts voting: of nine parts that overlap the median, so that what
/// moves in some of them does not count as the camera's.
std::vector<Point> camera_path(const HalfFrames& frames, Progress& progress);

/// Moves each frame back by what its path is off a straight one: shake goes, a pan stays (it can't be told from a fluid that
/// fills the picture). Catmull-Rom, beyond the sides mirrored. Gives the largest way that a frame was moved, px.
double hold_camera(HalfFrames& frames, const std::vector<Point>& path);

}  // namespace stillwater
