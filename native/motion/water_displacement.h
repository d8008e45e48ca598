#pragma once

#include "layers/displacement.h"
#include "motion/filtered_water.h"
#include "motion/ripple_kernel.h"
#include "motion/view.h"

/// The waves of one moment as displacements of the picture: what RippleMotion::at gives.
namespace stillwater {

/// Mode "height": points of the plane are raised.
///
/// In perspective a raised point moves along the line to the vertical vanishing point. Where the waves are steeper than
/// the line of sight, crests hide what lies behind them: several points of the still picture come to one place, and
/// unmap() gives the nearest to the eye, the one that is seen. For the nodes of the region it is found at once, by a
/// sweep of each column from near to far ("floating horizon": Anderson 1982, "Hidden line elimination in projected grid
/// surfaces").
class RaisedWater final : public Displacement {
 public:
  /// `region`, picture pixels: where map() will be asked, and unmap() within its spread(); elsewhere unmap() searches
  /// point by point.
  RaisedWater(const WaterPlane& plane, cv::Size picture, cv::Rect region, FilteredWater heights);

  bool at_rest() const override { return reach_ == 0; }
  float reach() const override { return reach_; }
  cv::Rect spread(const cv::Rect& box) const override;
  void map(float* x, float* y, int count) const override;
  void unmap(float* x, float* y, int count) const override;

 private:
  struct Raise {
    float share;  ///< of the way to the vertical vanishing point
    float down;   ///< derivative of the displacement along y
  };
  Raise raise(Point level) const;
  double lift(float share, double level_y) const;
  double furthest_source(double level_y, double rise) const;
  void keep_region(cv::Rect region, int picture_height);
  bool all_seen(int last_target) const;
  void sweep(int first_column, int columns);
  void map_level(Point& level) const;
  void unmap_level(Point& level) const;

  WaterPlane plane_;
  FilteredWater heights_;
  raised_water water_;
  float reach_ = 0;
  Plane sources_;  ///< for nodes: y of what is seen there, minus the node's
};

/// Mode "normal": the picture on the water is taken for a mirror image, which a facet shifts by its slope: sideways by
/// the slope to the right, up by the slope away; less close to the horizon, which no mirror image crosses. The facet
/// that does it is the one at the place where the image is seen, so unmap() is direct, and map() its inverse by a fixed
/// point.
class MirrorWater final : public Displacement {
 public:
  /// `region`, picture pixels: where it will mostly be asked. `pixels_per_slope`: displacement for a slope of 1.
  MirrorWater(const WaterPlane& plane, cv::Size picture, cv::Rect region, FilteredWater slopes_right,
              FilteredWater slopes_away, double pixels_per_slope);

  bool at_rest() const override { return reach_ == 0; }
  float reach() const override { return reach_; }
  void map(float* x, float* y, int count) const override;
  void unmap(float* x, float* y, int count) const override;
  /// Under a level horizon the pixels of a picture are nodes: read, not looked up.
  void unmap_row(float x0, float y0, float step, int count, float* x, float* y) const override;

 private:
  bool are_kept_nodes(float x0, float y0, float step, int count) const;
  Point displaced(Point level) const;
  void move(int rounds, float sign, float* x, float* y, int count) const;

  WaterPlane plane_;
  FilteredWater right_, away_;
  mirror_water water_;
  float reach_;
};

}  // namespace stillwater
