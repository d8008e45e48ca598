#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/progress.h"
#include "frame/cross_fade.h"
#include "frame/displaced_layer.h"
#include "frame/example_plate.h"
#include "frame/flowing_plate.h"
#include "frame/outlines.h"
#include "layers/layer_image.h"

namespace stillwater {

/// Along which axes a layer goes on for ever.
struct Endless {
  bool x = false, y = false;

  bool operator==(const Endless&) const = default;
};

/// The layer at the scale at which it is sampled: the output's where that is below 1 (areas are averaged), else as it is.
/// `picture` is the whole picture's size; the box comes back in pixels of that scale.
LayerImage scaled_layer(const LayerImage& layer, cv::Size picture, double output_scale);

/// What of a layer that drifts takes long to make: its pixels without an end
/// (make_cyclic_by_exemplars()), and CrossFade's mean.
struct EndlessPixels {
  Rgba pixels, mean;
};

EndlessPixels make_endless(const LayerImage& layer, cv::Size picture, double output_scale, Endless along,
                           Progress progress = {});

/// A layer as frames read it: ready for any moment, whatever the numbers of its motion are.
struct LayerPlates {
  cv::Rect box;                     ///< where the layer lies, picture pixels
  cv::Size picture;                 ///< the whole picture
  double output_scale = 1;          ///< output pixels for a picture pixel
  std::optional<Endless> drifting;  ///< of a layer that drifts, or follows one that does
  Plate colour, alpha;              ///< alpha: of the picture's own, as a grey picture; empty where it has none
  std::unique_ptr<const CrossFade> colour_fade, alpha_fade;  ///< of a layer that drifts; they belong to these plates
  std::unique_ptr<const FlowingPlate> colour_flow, alpha_flow;  ///< of a layer that flows, likewise
  std::unique_ptr<const ExamplePlate> colour_example;  ///< of a layer that flows like a clip; its alpha stands still
  Outlines outlines;                ///< of a layer whose outline moves: then its plates are opaque
};

/// What make_endless() gave for a layer that drifts, where that was called before.
struct MadeBefore {
  const EndlessPixels* colour = nullptr;
  const EndlessPixels* alpha = nullptr;
};

/// What moves a layer that flows.
struct FlowFields {
  std::vector<Field> velocities;  ///< of the layer's box at the picture's scale, px per frame; none: the layer does not flow
  double longest = 0;             ///< longest way that its Flow ever has, frames at speed 1
};

/// What moves a layer that flows like a clip; null: it does not.
struct ExampleFilm {
  const ExampleSetup* setup = nullptr;
  const ExampleLook* look = nullptr;  ///< made before, by ExamplePlate::make_look() of plates without one
};

/// Throws BadInput where a box does not fit its pixels or the picture, a field not the box, or what was made before, or an
/// outline, not the layer.
std::shared_ptr<const LayerPlates> make_plates(const LayerImage& colour, const LayerImage& alpha, cv::Size picture,
                                               double output_scale, std::optional<Endless> drifting,
                                               MadeBefore before = {}, const FlowFields& flow = {},
                                               const ExampleFilm& example = {}, Outlines outlines = {});

/// Length of one period of an endless layer's plate along x and y, in picture pixels.
Point plate_period(cv::Size picture, double output_scale);

}  // namespace stillwater
