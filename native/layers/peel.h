#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "layers/layer_image.h"
#include "layers/uncover.h"

/// From a picture and the mattes of its layers to the layers themselves, front to back: each is taken off what is
/// left of the picture, and the hole behind it is filled (METHODS.md 1; Chuang et al. 2005, 3.1).
namespace stillwater {

/// A matte of which only a part is kept: `pixels`, 0..1, in `box`, and 0 outside of it.
struct MatteInBox {
  Plane pixels;  ///< box.height x box.width
  cv::Rect box;  ///< picture pixels; empty for a layer without coverage
};

struct PeelLayer {
  std::optional<std::variant<Plane, MatteInBox>> matte;  ///< 0..1, a Plane of the picture's size; the last needs none
  Filling fill{Fill::push_pull};
  double feather = 0;  ///< softens the matte: a Gaussian of sigma feather / 2, px
};

/// What lies behind a layer that was taken off, as far as that changed the picture.
struct Behind {
  Rgba colour;        ///< box.height x box.width, opaque
  Plane matte;        ///< the same size: of the layer, feathered, and gone on behind what hides it
  cv::Rect box;       ///< picture pixels; empty for a layer without coverage
  bool open = false;  ///< nothing is behind what the layer covers wholly (Fill::none)
};

/// Takes the layers off a picture one after the other, front first.
///
/// - Laid over each other at rest they give the picture: exactly where mattes are 0 or 1, else to rounding (uncover()).
/// - What of a matte lies hidden behind layers in front goes on smoothly from what is seen of it, never below what
///   the matte itself says there.
class Peeling {
 public:
  /// `picture` counts as opaque (its fourth channel is not read). Throws BadInput where it is empty.
  explicit Peeling(const Rgba& picture);

  struct Taken {
    LayerImage layer;
    Behind behind;
  };

  /// Takes the next layer off; it needs a matte. `name` stands in sentences.
  /// Throws BadInput where a size differs, the matte is missing or reaches outside the picture, or the feather is not
  /// within 0 .. 1000, and as uncover() does; Cancelled. What is left is then as it was.
  Taken take(const PeelLayer& layer, std::string_view name = "layer", Progress progress = {});

  /// The next layer was taken off before, and left this. Throws BadInput where it does not fit the picture.
  void leave(const Behind& behind);

  /// What is left: the picture without the layers taken off, opaque.
  const Rgba& left() const { return left_; }

  /// All that is left, as the last layer.
  LayerImage rest() const;

 private:
  LayerImage cut(const Rgba& front, const Plane& matte, const cv::Rect& box) const;

  Rgba left_;
  Plane hidden_;  // how far the layers taken so far cover it
  Plane solid_;   // 0 where nothing is behind them
};

/// All layers at once, front first. A last layer without a matte covers the whole picture.
///
/// Throws BadInput as Peeling does, and where another layer than the last has no matte; Cancelled where `progress`,
/// asked now and then, says so.
std::vector<LayerImage> peel(const Rgba& picture, const std::vector<PeelLayer>& layers, Progress progress = {});

}  // namespace stillwater
