#pragma once

#include <memory>
#include <vector>

#include "layers/displacement.h"
#include "motion/ripmap.h"
#include "motion/view.h"

/// The waves of one moment as a displacement of the picture (what RippleMotion::at gives).
namespace stillwater {

/// One moment's waves on the plane. `heights` stands in mode height, `slopes` (right, away) in mode normal.
struct WaterSurface {
  std::shared_ptr<const Ripmap> heights, slopes_right, slopes_away;
  double samples_per_metre = 1;
  double side = 256;       ///< of the tile, samples
  double amplitude = 1;    ///< factor of all values
};

class WaterDisplacement final : public Displacement {
 public:
  /// Values are computed once a picture pixel of `region`, elsewhere when asked.
  WaterDisplacement(const WaterPlane& plane, const WaterSurface& surface, cv::Size picture, cv::Rect region);

  bool at_rest() const override { return rest_; }
  float reach() const override { return reach_; }
  void map(float* x, float* y, int count) const override;
  void unmap(float* x, float* y, int count) const override;

 private:
  /// What a node holds: kappa (mode height), or a displacement in level pixels (mode normal).
  struct Node {
    float a, b;
  };
  struct Shift {
    double x, y;
  };

  double node_x(int i) const { return offset_x_ + i; }
  double node_y(int j) const { return offset_y_ + j; }
  void fill_block(int block, int j, float* a, float* b) const;
  Node node(int i, int j) const;
  Node between(Point level) const;
  Shift displaced(Point level) const;
  void measure(cv::Size picture);
  void fill_grid(cv::Rect region);

  WaterPlane plane_;
  WaterSurface surface_;
  double picture_width_;
  double offset_x_, offset_y_;  ///< nodes lie on pixel centres where the horizon is level
  int first_block_ = 0, first_row_ = 0;
  Plane a_, b_;
  bool rest_;
  float reach_ = 0;
};

}  // namespace stillwater
