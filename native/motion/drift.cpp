#include "motion/drift.h"

#include <cmath>

#include "core/check.h"

namespace stillwater {
namespace {

constexpr double largest_change_of_speed = 0.1;

Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
double length(Point a) { return std::hypot(a.x, a.y); }

Point whole_turns(Point way, Point period) {
  return {std::nearbyint(way.x / period.x) * period.x, std::nearbyint(way.y / period.y) * period.y};
}

}  // namespace

DriftCopies drift(const Drift& drift, const Moment& moment, Point period) {
  check_moment(moment);
  for (const double number : {drift.offset.x, drift.offset.y, drift.loop_offset.x, drift.loop_offset.y}) {
    check::finite("drift", number);
  }
  check::positive("period", period.x, "px");
  check::positive("period", period.y, "px");
  if (moment.loop_frames == 0) return {drift.offset, drift.offset, 0, {}};

  const Point way = drift.loop_offset;
  const Point plain = travel_in_loop(drift.offset, way, moment);
  const double share_of_loop = frames_into_loop(moment) / moment.loop_frames;
  const Point missing = whole_turns(way, period) - way;
  if (length(missing) <= largest_change_of_speed * length(way)) {
    const Point place = plain + share_of_loop * missing;
    return {place, place, 0, way + missing};
  }
  const Point first = share_of_loop < 0.5 ? plain : plain - way;
  return {first, plain - 0.5 * way, 1 - std::abs(1 - 2 * share_of_loop), way};
}

}  // namespace stillwater
