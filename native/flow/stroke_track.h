#pragma once

#include <string>
#include <vector>

#include "flow/flow_stroke.h"

/// A drawn stroke as the flow brushes read it: evenly spaced stations with a direction each.
namespace stillwater {

/// A place on a stroke's centre line.
struct Station {
  double x = 0, y = 0;
  double radius = 0;   ///< half the width there, px
  cv::Vec2d tangent;   ///< unit vector the way the pen went; (0, 0) where the pen never moved
};

struct StrokeTrack {
  std::vector<Station> stations;  ///< one or more, at most half a width (at least 1 px) apart along the line
  cv::Rect2d box;                 ///< around all that lies under the stroke
};

/// The tangent is the chord from a width before to a width behind a place (at least 4 px): a pen's trembling,
/// which is finer than the brush, turns nothing. At the ends it is the chord of what there is.
///
/// Throws BadInput, with `name` in its sentence: no points, a place that is not finite or further out than 1e6 px, a pressure
/// or an alpha outside 0..1, a width that is not above 0 and at most 16384, a speed outside 0..1000, and a stroke shorter than
/// 1 px that is to say a direction.
StrokeTrack track_of(const FlowStroke& stroke, const std::string& name);

/// What of a stroke is nearest to a place.
struct Nearest {
  double distance = 0;  ///< px, to the centre line
  double radius = 0;    ///< half the stroke's width there
  cv::Vec2d tangent;
};

/// From the piece between stations `piece` and `piece` + 1 (of a stroke with one station: from that).
Nearest nearest_on_piece(const StrokeTrack& track, std::size_t piece, double x, double y);

/// Number of pieces: at least 1.
std::size_t pieces(const StrokeTrack& track);

/// From the whole stroke; of pieces equally near the later, which was painted over the earlier.
Nearest nearest_on(const StrokeTrack& track, double x, double y);

}  // namespace stillwater
