#pragma once

#include <memory>
#include <vector>

#include "frame/composite.h"
#include "frame/cross_fade.h"
#include "frame/motions.h"
#include "frame/plate.h"
#include "layers/layer_image.h"

/// One whole frame of an animated picture, from its layers and their motions (DESIGN.md, "How a frame is made").
namespace stillwater {

/// What is fixed about one layer.
struct LayerSetup {
  LayerImage image;       ///< of the picture, counted as opaque
  LayerImage alpha;       ///< the same layer cut out of the picture's alpha as a grey picture; only where it has any
  std::shared_ptr<const LayerPlates> plates;  ///< instead of both: made before, by make_plates()
  MotionNumbers motion;   ///< animated fields are replaced at each moment
  int water = -1;         ///< of a bob: index of the ripple layer that carries it
  int follows = -1;       ///< index of the layer that this one goes with
  bool mirror = false;    ///< ... as its reflection
  bool visible = true;    ///< a hidden layer shows its fill
  Endless endless{true, true};  ///< of a drift and what follows it: axes along which it may move
};

/// What is fixed about the picture.
struct PictureSetup {
  cv::Size size;           ///< picture pixels
  double scale = 1;        ///< output pixels for a picture pixel, 0.001 .. 16
  View view;
  Wind wind;               ///< its gust_size and seed
  bool has_alpha = false;
};

/// The numbers of one layer at one moment.
struct LayerState {
  double opacity = 1;
  MotionNumbers motion;
  int outline = 0;  ///< which of its outlines, of a layer that has some
};

/// All numbers of one moment.
struct FrameNumbers {
  Moment moment;
  std::vector<LayerState> layers;
};

struct FrameWish {
  bool flow = true, matte = true, layers = false;
};

/// A frame: premultiplied, display-referred; what was not wished for is empty.
struct Frame {
  Rgba combined;
  Field flow;                ///< where the point seen here is at the next frame, minus here, output pixels
  Plane matte;               ///< share of the pixel that comes from layers whose motion is not still
  std::vector<Rgba> layers;  ///< each alone; empty images for hidden ones
};

/// What a screen shows of a moment.
struct ScreenWish {
  int layer = -1;        ///< index of the layer that is shown alone, over nothing; -1: all of them
  bool coverage = false;  ///< how much of each pixel is covered, as grey
};

class FrameRenderer {
 public:
  /// Throws BadInput for sizes out of range, layers outside the picture, plates made for something else, and what
  /// Motions refuses.
  FrameRenderer(const PictureSetup& picture, const std::vector<LayerSetup>& layers);

  /// The frame of the moment `now`; `after` is one frame later (for the flow). Keeps nothing that changes a later
  /// answer: any frame can be asked for alone, by several threads.
  Frame render(const FrameNumbers& now, const FrameNumbers& after, FrameWish wish) const;

  /// The picture of a moment as Blender keeps one: scene-linear, premultiplied, bottom row first, as exact as an eye
  /// needs it (display_to_screen()). `rgba`: four numbers for each pixel of size(). Throws BadInput for a layer that is
  /// not there.
  void render_for_screen(const FrameNumbers& now, ScreenWish wish, float* rgba) const;

  /// Takes points of the still picture (picture pixels) to where they are at a moment as part of one layer; where two
  /// copies are cross-faded, of the first. A flow leaves them where they are: its outline is still. Throws BadInput for a layer that is not there.
  void move(int layer, const FrameNumbers& now, float* x, float* y, int count) const;

  /// Width and height of the output.
  cv::Size size() const { return size_; }

 private:
  struct Layer {
    std::shared_ptr<const LayerPlates> plates;  // null: the layer is not seen
    bool moves = false;
  };

  void check(const std::vector<LayerSetup>& layers) const;
  void check_layer(int layer) const;
  std::optional<Endless> drifting(const std::vector<LayerSetup>& layers, int layer) const;
  using LayerMotions = std::vector<std::unique_ptr<LayerMotion>>;
  LayerMotions motions_of(const FrameNumbers& now, const std::vector<Placement>& placed, const std::vector<Travel>& travel,
                          bool of_alpha) const;
  std::vector<ComposedLayer> composed(const LayerMotions& motions, const FrameNumbers& now) const;
  void add_alpha(Frame& frame, const LayerMotions& motions, const FrameNumbers& now) const;

  PictureSetup picture_;
  cv::Size size_;
  std::vector<Layer> layers_;
  std::unique_ptr<Motions> motions_;
};

}  // namespace stillwater
