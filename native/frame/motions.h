#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "example/carried_residuals.h"
#include "flow/flow_cycle.h"
#include "layers/displacement.h"
#include "motion/bob.h"
#include "motion/drift.h"
#include "motion/ripple.h"
#include "motion/sway.h"
#include "motion/view.h"
#include "motion/wind.h"

namespace stillwater {

/// What moves one layer, with the numbers of one moment; monostate: nothing. A Flow and an ExampleNow displace
/// nothing: frame/flowing_layer.h and frame/example_layer.h make their colours.
using MotionNumbers = std::variant<std::monostate, Sway, Ripple, Bob, Drift, Flow, ExampleNow>;

/// What is fixed about one layer's motion.
struct MotionSetup {
  MotionNumbers numbers;  ///< animated fields are replaced at each moment
  int water = -1;         ///< of a bob: index of the ripple layer that carries it
  int follows = -1;       ///< index of the layer that this one goes with
  bool mirror = false;    ///< ... as its reflection
  cv::Rect box;           ///< where the layer is, picture pixels
  Point period;           ///< of a drift: length of the endless layer along x and y, picture pixels
};

/// The one or two copies of a layer at a moment. Null stands for no displacement.
struct Placement {
  std::shared_ptr<const Displacement> first, second;
  double second_share = 0;  ///< above 0 where two copies are cross-faded
  Point drifted, second_drifted;  ///< of a drift: offset of each copy
};

/// A layer's way from one frame to the next, without the jumps of an endless layer that starts over: what flow is read
/// from. Null stands for no displacement.
struct Travel {
  std::shared_ptr<const Displacement> now, after;
};

/// The motions of all layers of one picture, and how they hang together: a bob reads its water, a follower goes with
/// its layer first and moves by itself then. A reflection is mirrored about the waterline of a bob at rest, else about
/// the line through an armature's root parallel to the horizon (to the x axis without one).
class Motions {
 public:
  /// Throws BadInput for indices that are no layers, a cycle, or `water` that is no ripple.
  Motions(std::vector<MotionSetup> layers, const View& view, const Wind& wind, cv::Size picture);

  /// One Placement a layer. `numbers`: one a layer, of the kind it was set up with.
  std::vector<Placement> at(const Moment& moment, const std::vector<MotionNumbers>& numbers) const;

  /// One Travel a layer, from where `now` (of at()) has it to the moment after.
  std::vector<Travel> travel(const std::vector<Placement>& now, const Moment& after,
                             const std::vector<MotionNumbers>& numbers_after) const;

  /// True where the layer, or one that it follows, has a motion.
  bool moves(int layer) const;

 private:
  friend class MomentOfMotions;

  void check(const std::vector<MotionNumbers>& numbers) const;
  void order_layers();
  Segment mirror_axis(int layer) const;
  cv::Rect water_region(int layer) const;

  std::vector<MotionSetup> layers_;
  std::vector<int> order_;  ///< each layer after those that it needs
  std::vector<std::unique_ptr<SwayMotion>> sways_;
  std::vector<std::unique_ptr<RippleMotion>> ripples_;
  View view_;
  cv::Size picture_;
};

}  // namespace stillwater
