#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/image.h"
#include "motion/gusts.h"
#include "motion/ripmap.h"
#include "motion/ripple_kernel.h"
#include "motion/view.h"
#include "motion/wind.h"

/// One quantity of the water's surface (height or slope) as the pixels of a picture see it at one moment: averaged over
/// each pixel's footprint, on a lattice of nodes one level pixel apart, linear between them. The lattice does not
/// depend on the region for which nodes are kept, so a value is a function of its place alone.
namespace stillwater {

/// How the tile lies on the plane.
struct TileOnPlane {
  double samples_per_metre = 1;
  double side = 256;  ///< samples
};

/// Strength of the wind over the picture against its mean, on corners an eighth of a gust apart, linear between them.
class LocalWind {
 public:
  /// Covers the picture; elsewhere the nearest corner counts.
  LocalWind(const GustField& field, const Moment& moment, const WaterPlane& plane, cv::Size picture);

  /// Multiplies the values of the nodes of some blocks in line j, by `factor` too.
  void strengthen(int block, int blocks, int j, float factor, float* values) const;
  float largest() const { return largest_; }

 private:
  float corner(int column, int line) const;

  int spacing_ = Ripmap::block;  ///< level pixels, divides a block
  int first_column_ = 0, first_line_ = 0;
  Plane factors_;
  float largest_ = 1;
};

class FilteredWater {
 public:
  /// `factor` multiplies what the tile holds; `ceiling`, where above 0, is what values approach but never reach.
  FilteredWater(const WaterPlane& plane, cv::Size picture, std::shared_ptr<const Ripmap> tile, TileOnPlane on_plane,
                double factor, double ceiling, std::shared_ptr<const LocalWind> wind);

  /// No value lies further from 0.
  double bound() const { return bound_; }

  double node_x(int i) const { return offset_x_ + i; }
  double node_y(int j) const { return offset_y_ + j; }
  int column(double level_x) const;  ///< of the node at or left of it
  int line(double level_y) const;    ///< of the node at or above it

  /// Keeps the nodes of these lines, and of the whole blocks around these columns, to answer faster. Once only.
  void keep(int first_column, int last_column, int first_line, int last_line);
  /// More lines below those that are kept.
  void keep_more(int last_line);
  int first_line() const { return first_line_; }
  int last_line() const { return first_line_ + kept_.rows - 1; }
  const float* kept_line(int j) const { return kept_[j - first_line_]; }
  water_nodes kept_nodes() const;

  /// At a place in level coordinates; `down` is its derivative along y.
  float at(Point level, float* down = nullptr) const;

 private:
  void fill_blocks(int j, int first, int blocks, float* values) const;
  float node(int i, int j) const;

  WaterPlane plane_;
  std::shared_ptr<const Ripmap> tile_;
  TileOnPlane on_plane_;
  double factor_, ceiling_, bound_;
  bool bends_;  ///< some value may come near the ceiling
  std::shared_ptr<const LocalWind> wind_;
  double offset_x_, offset_y_;  ///< nodes lie on pixel centres where the horizon is level
  int first_block_ = 0, first_line_ = 0;
  Plane kept_;
};

}  // namespace stillwater
