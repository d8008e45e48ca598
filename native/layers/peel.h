#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/progress.h"
#include "layers/layer_image.h"

/// From a picture and the mattes of its layers to the layers themselves, front to back: each is taken off what is
/// left of the picture, and the hole behind it is filled (METHODS.md 1; Chuang et al. 2005, 3.1).
namespace stillwater {

enum class Fill {
  push_pull,  ///< smoothly, from what surrounds the hole at 3 px or more (nearer lies the fringe of what was cut out)
  none,       ///< transparent behind what the layer covers wholly
};

/// A matte of which only a part is kept: `pixels`, 0..1, in `box`, and 0 outside of it.
struct MatteInBox {
  Plane pixels;  ///< box.height x box.width
  cv::Rect box;  ///< picture pixels; empty for a layer without coverage
};

struct PeelLayer {
  std::optional<std::variant<Plane, MatteInBox>> matte;  ///< 0..1, a Plane of the picture's size; the last needs none
  std::variant<Fill, Rgba> fill{Fill::push_pull};  ///< or a painted background, size of the picture
  double feather = 0;                        ///< softens the matte: a Gaussian of sigma feather / 2, px
};

/// The layers, front first. `picture` counts as opaque (its fourth channel is not read).
///
/// - Laid over each other at rest they give the picture: exactly where mattes are 0 or 1, else to rounding. Whatever
///   foreground F and background B are thought to be, the remainder r = P - aF - (1-a)B is split between them:
///   F += a r / (a^2 + (1-a)^2), B += (1-a) r / (a^2 + (1-a)^2).
/// - F at soft edges is drawn smoothly from where the layer is whole, so that no halo of the old background moves along.
/// - What of a matte lies hidden behind layers in front goes on smoothly from what is seen of it, never below what
///   the matte itself says there.
/// - The last layer without a matte covers the whole picture.
///
/// Throws BadInput where sizes differ, a matte is missing or reaches outside the picture, or a feather is not within 0 .. 1000; Cancelled where
/// `progress`, asked after each layer, says so.
std::vector<LayerImage> peel(const Rgba& picture, const std::vector<PeelLayer>& layers, Progress progress = {});

}  // namespace stillwater
