#pragma once

#include <array>
#include <memory>
#include <vector>

#include "flow/flow_paths.h"
#include "frame/displaced_layer.h"

namespace stillwater {

/// A layer that flows, ready for any moment: its texture without an outline (extend_colours()), and what keeps contrast
/// where copies are mixed (keep_variance.h). Fine and coarse shapes are mixed apart, as they are not equally alike at a
/// distance: bands between ever wider blurs, the coarser ones on the knots of the streamlines alone.
///
///     colour = M3 + g2 (M2 - M3) + g1 (M1 - M2) + g0 (S - M1)        M1, M2, M3: S blurred; each a mix of the copies'
class FlowingPlate {
 public:
  static constexpr int bands = 3;

  /// `paths`: of a field in the plate's pixels, px of the plate. `lively`: contrast is kept; without it copies only
  /// dissolve (the picture's own alpha). The plate must outlive this.
  FlowingPlate(const Plate& plate, std::shared_ptr<const FlowPaths> paths, bool lively);

  /// The layer at one moment. The answer refers to this and the plate.
  std::unique_ptr<LayerMotion> at(const Flow& flow) const;

  const FlowPaths& paths() const { return *paths_; }

 private:
  friend class FlowingLayer;

  /// The texture blurred, on a coarse grid.
  struct Mean {
    Rgba pixels;
    float columns = 1, rows = 1;  ///< of it for one of the plate

    cv::Vec4f at(float x, float y) const;  ///< index coordinates of the plate
  };

  void make_means(const Rgba& texture);
  void measure_likeness();
  std::array<float, bands> bands_at(float x, float y) const;
  float likeness(int band, float apart) const;

  const Plate& plate_;
  std::shared_ptr<const FlowPaths> paths_;
  bool lively_;
  Source texture_;                                ///< opaque; beyond its sides mirrored
  std::array<Mean, bands> means_;                 ///< finest first
  std::array<std::vector<float>, bands> likeness_;  ///< by distance, see likeness()
};

}  // namespace stillwater
