#pragma once

#include <memory>

#include "frame/motions.h"
#include "layers/layer_motion.h"
#include "layers/sampling.h"

namespace stillwater {

/// The pixels of one layer, ready for any moment: at the output's scale where that is below 1, else at the picture's.
struct Plate {
  Source source;
  Point origin;           ///< of its first pixel, in its own pixels: place x of the picture is index x * scale - origin.x - 0.5
  double scale = 1;       ///< its pixels for a picture pixel
  double output_scale = 1;
  cv::Rect box;           ///< where it lies, picture pixels
  bool endless_x = false, endless_y = false;
};

/// A layer that is the still layer, displaced (sway, ripple, bob, drift and whatever follows them): colour is sampled
/// through the map of this moment, the flow leads through the still picture to the map of the next.
std::unique_ptr<LayerMotion> displaced_layer(const Plate& plate, const Placement& now, const Travel& travel);

/// Both copies of a layer that drifts in a loop, cross-faded with variance kept, so that contrast does not sink half
/// way. `mean` is the layer, blurred: what does not change where the copies differ; rho is how alike the layer is to
/// itself at the distance of the copies. Of straight colours; coverage dissolves.
///
///     colour = M + (w1 (S1 - M1) + w2 (S2 - M2)) / sqrt(w1^2 + w2^2 + 2 w1 w2 rho),   M = w1 M1 + w2 M2
std::unique_ptr<LayerMotion> cross_faded_layer(const Plate& plate, const Plate& mean, const Placement& now, const Travel& travel);

}  // namespace stillwater
