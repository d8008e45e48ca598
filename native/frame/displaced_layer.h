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
  int picture_width = 0;  ///< picture pixels
};

/// Where a run of output pixels is sampled when a layer is displaced, in its plate's index coordinates. Null stands for
/// no displacement.
struct SampledRun {
  float x[Run::longest], y[Run::longest];

  SampledRun(const Plate& plate, const Displacement* displacement, const Run& run);
};

/// What layers that are the still layer, displaced, have in common, however many copies of it are seen: the flow leads
/// through the still picture to the map of the next moment.
class TravellingLayer : public LayerMotion {
 public:
  TravellingLayer(const Plate& plate, const Travel& travel) : plate_(plate), travel_(travel) {}

  bool at_rest() const override;
  void flow(float* x, float* y, int count) const override;

 protected:
  /// Output pixels that the layer can reach with this displacement (null: none).
  cv::Rect bounds(const Displacement* displacement) const;

  const Plate& plate_;

 private:
  Travel travel_;
};

/// A layer that is the still layer, displaced (sway, ripple, bob, drift and whatever follows them): colour is sampled
/// through the map of this moment.
std::unique_ptr<LayerMotion> displaced_layer(const Plate& plate, const Placement& now, const Travel& travel);

}  // namespace stillwater
