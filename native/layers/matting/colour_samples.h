#pragma once

#include <cstdint>
#include <functional>

#include "core/image.h"
#include "layers/matting/trimap.h"

namespace stillwater {

struct ColourSampleOptions {
  int iterations = 4;      ///< rounds of the search
  double nearness = 1;     ///< weight of the samples' distances against colour, 1 per 1/255
  std::uint64_t seed = 1;
};

/// For each pixel a known foreground and a known background colour that together explain it.
struct ColourSamples {
  Rgba foreground, background;  ///< of the picture's size, their fourth channel is 0 where there is none
  Plane misfit;                 ///< what the best mix of the two lacks of the pixel's colour, its length, 0..1
};

/// Global sampling (He, Rhemann, Rother, Tang and Sun 2011, "A global sampling method for alpha matting", eq. 2 to 5):
/// all known pixels along the border of what is unknown are samples, sorted by how bright they are; of the pairs the
/// best for each pixel is found by a random search, in rounds: what its neighbours have, then pairs ever nearer to its
/// own. A pair costs what its best mix lacks of the pixel's colour, and how far away both are, in distances of the
/// nearest.
///
/// Red and black pixels take turns, and random numbers are keyed by place: the same for any number of threads. The
/// trimap has foreground and background; samples are given to those of its unknown pixels that are `wanted` (not 0).
/// `done` is told how far it is, 0..1.
ColourSamples sample_colours(const Rgba& picture, const Trimap& trimap, const cv::Mat_<unsigned char>& wanted,
                             const ColourSampleOptions& options = {},
                             const std::function<void(double)>& done = [](double) {});

/// How much of the foreground, 0..1, mixes with the background best to a colour (He et al., eq. 2); 1 where they are
/// equal.
float best_mix(const cv::Vec4f& colour, const cv::Vec4f& foreground, const cv::Vec4f& background);

}  // namespace stillwater
