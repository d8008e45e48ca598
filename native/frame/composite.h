#pragma once

#include <functional>
#include <vector>

#include "layers/layer_motion.h"

namespace stillwater {

/// One layer of the moment to be composed.
struct ComposedLayer {
  const LayerMotion* motion;
  float opacity = 1;
  bool moves = false;  ///< counts as moving in the matte
};

/// What is composed. Images that are not wanted stay empty.
struct Composition {
  Rgba combined;  ///< premultiplied
  Field flow;     ///< where the point seen here is at the next frame, minus here, output pixels
  Plane matte;    ///< share of the pixel that comes from layers that move
};

struct CompositionWish {
  bool flow = true, matte = true;
};

/// Lays the layers (front first) over each other in fixed tiles, row by row, front to back, skipping what is covered
/// already. The flow belongs to the front-most layer at which the coverage from the front reaches one half, else to the
/// layer that contributes most; it is 0 where there is no layer.
Composition compose(const std::vector<ComposedLayer>& layers, const cv::Size& size, CompositionWish wish);

/// The colours alone of one run of that.
void compose_run(const std::vector<ComposedLayer>& layers, const Run& run, cv::Vec4f* out);

/// Composes colours run by run, for who needs no whole image: `take` gets each run's place in the output and its
/// pixels, which it may change; several threads call it.
void compose_runs(const std::vector<ComposedLayer>& layers, const cv::Size& size,
                  const std::function<void(const Run& run, cv::Vec4f* pixels)>& take);

/// One layer alone, over nothing.
Rgba compose_alone(const ComposedLayer& layer, const cv::Size& size);

}  // namespace stillwater
