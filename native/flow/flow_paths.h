#pragma once

#include <array>
#include <vector>

#include "core/image.h"
#include "flow/flow_cycle.h"
#include "flow/streamlines.h"

namespace stillwater {

/// All that an endless flow (flow_cycle.h) reads of a layer's fields, whatever the moment.
class FlowPaths {
 public:
  /// `velocities`: the fields between which the flow changes, px per frame, at least one, all of one size. `longest`: the
  /// longest way that a Flow of this layer has, frames at speed 1; 0: it stands still.
  /// Throws BadInput as Streamlines does, and where there is no field or one of another size.
  FlowPaths(std::vector<Field> velocities, double longest);

  int fields() const { return static_cast<int>(velocities_.size()); }
  cv::Size pixels() const { return velocities_.front().size(); }
  cv::Size knots() const { return knots_; }

  /// No field moves anything.
  bool still() const { return lines_.empty(); }

  /// The flow of a moment as these paths take it: where a period would carry the picture over a large part of itself, it is
  /// cut into whole pieces.
  Flow taken(const Flow& flow) const { return faster(flow, turns_); }

  /// Where copies of a moment are sampled at a knot whose way since their birth is `way`, minus the knot, px.
  cv::Vec2f origin(const Flow& flow, int row, int column, double way) const;

  /// Where what is seen at a place (index coordinates) goes until the next frame, minus here, px.
  cv::Vec2d to_next(const Flow& flow, cv::Vec2d place) const;

  const Streamlines& lines(int field) const { return lines_[field]; }
  float phase(int row, int column) const { return phases_(row, column); }
  std::array<float, flow_lives> lives(int row, int column) const { return short_lives_ ? lives_at(row, column) : whole_lives; }
  bool short_lives() const { return short_lives_; }
  /// 1 for each pixel of a row that some field moves, else 0.
  const unsigned char* moving_row(int row) const { return moves_[row]; }

 private:
  static constexpr std::array<float, flow_lives> whole_lives{1, 0, 0};

  std::array<float, flow_lives> lives_at(int row, int column) const;
  double typical_way() const;
  void set_phases();
  void set_lives();

  std::vector<Field> velocities_;
  double longest_;
  int turns_ = 1;
  cv::Size knots_;
  std::vector<Streamlines> lines_;
  Plane phases_;                    ///< of each knot
  std::vector<Plane> shorter_;      ///< of each knot: share of the lives so long that goes to shorter ones
  bool short_lives_ = false;
  cv::Mat_<unsigned char> moves_;   ///< of each pixel
};

}  // namespace stillwater
