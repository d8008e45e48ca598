#pragma once

#include "frame/displaced_layer.h"
#include "layers/layer_image.h"

namespace stillwater {

/// Along which axes a layer goes on for ever.
struct Endless {
  bool x = false, y = false;
};

/// A layer's pixels at the scale at which they are sampled: the output's where that is smaller than the picture's
/// (areas are averaged), else the picture's. An endless layer is continued by make_cyclic().
Plate make_plate(const LayerImage& layer, cv::Size picture, double output_scale, Endless endless);

/// Length of one period of an endless layer's plate along x and y, in picture pixels.
Point plate_period(cv::Size picture, double output_scale);

}  // namespace stillwater
