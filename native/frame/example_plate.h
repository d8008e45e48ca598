#pragma once

#include <memory>
#include <vector>

#include "appearance/match_texture.h"
#include "appearance/motion_blur.h"
#include "core/progress.h"
#include "example/carried_residuals.h"
#include "example/moving_share.h"
#include "frame/displaced_layer.h"

namespace stillwater {

/// The recipe's `example`, as far as it concerns the look.
struct LookParameters {
  MotionBlurParameters average;       ///< A'
  cv::Size grid = {0, 0};             ///< cells of the matching; 0 x 0: of about 55 px of the picture
  int repetitions = 3;                ///< 0: nothing is matched
  bool matched = true;                ///< else, and below smallest_matched_side, the differences only get the picture's contrast
  TextureMatching matching = TextureMatching::steerable;
  double stylize = 1;                 ///< 0..1
};

/// What moves a layer like a clip.
struct ExampleSetup {
  HalfFrames residuals;
  std::shared_ptr<const void> memory;  ///< of the residuals
  std::vector<PlacedPatch> patches;    ///< in pixels of the layer's box
  std::vector<CloneStroke> strokes;    ///< likewise
  TransferParameters transfer;
  double reach = 1;                    ///< ClipAnalysis::reach
  Rgb moving;                          ///< ClipAnalysis::moving; empty: all moves
  std::vector<Field> velocities;       ///< of the layer's box at the picture's scale, px per step of the clip, at least one
  Plane freeze;                        ///< of the box: 1 is held still; or empty
  CarriedResiduals::Parameters carried;
  LookParameters look;
};

/// What of a layer's look takes long to find: it is the same for all frames, so that nothing flickers.
struct ExampleLook {
  Rgb base;              ///< A', the mean of C and what of it stands
  Rgb slope;             ///< of the differences (local_contrast.h)
  Plane hold;
  TextureCurves curves;  ///< the mean of those of a few moments
};

/// A layer that flows like a clip, ready for any moment (Okabe et al. 2009, 4):
///
///     F'(s) = A' + mean C + standing C + slope luma(D'(s)), then matched to the picture's texture by the look's curves
///
/// As much of the picture's detail stands as of the clip's does where it takes its residuals from (moving_share.h).
/// Without an outline: the colours are those of extend_colours(), coverage is the still layer's. What is frozen shows the
/// picture, and so does a layer whose flows stand everywhere.
class ExamplePlate {
 public:
  /// Without a look, only make_look() can be asked for. Throws BadInput where sizes or numbers do not fit.
  ExamplePlate(const Plate& plate, const ExampleSetup& setup, const ExampleLook* look = nullptr);

  /// Found at moments spread over the clip. Throws BadInput as describe(); Cancelled.
  ExampleLook make_look(Progress progress = {}) const;

  /// The layer at one moment. The answer refers to this and the plate.
  std::unique_ptr<LayerMotion> at(const ExampleNow& now) const;

  /// Its colours at one moment, opaque.
  Rgba film(const ExampleNow& now) const;

  int fields() const { return carried_.fields(); }

 private:
  friend class ExampleLayer;

  Rgb moving_here() const;
  Rgba unmatched(const Rgb& differences, const ExampleLook& look) const;
  double cell() const;

  const Plate& plate_;
  LookParameters parameters_;
  Rgb moving_;
  double clip_pixel_;  ///< px of the plate
  Rgba texture_;
  std::vector<Field> velocities_;
  Field mean_velocity_;
  Plane freeze_;
  CarriedResiduals carried_;
  std::shared_ptr<const void> memory_;
  bool still_;  ///< no flow moves anything
  TextureTarget target_;
  ExampleLook look_;
};

}  // namespace stillwater
