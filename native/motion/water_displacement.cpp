#include "motion/water_displacement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/cpu.h"
#include "core/parallel.h"
#include "motion/ripple_avx2.h"

namespace stillwater {
namespace {

/// A raised point keeps at least this share of its distance along the optical axis.
constexpr float nearest = 0.25f;

/// Columns that one sweep takes along.
constexpr int strip = 2 * Ripmap::block;

/// Lines by which the kept nodes grow until they hold all that is seen in the region.
constexpr int growth = 32;

/// Mode normal moves half as far at this distance below the horizon, of the picture's width.
constexpr float mirror_fade = 0.02f;

struct Box {
  double left, right, top, bottom;
};

Box level_box(const WaterPlane& plane, cv::Rect region) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box{far, -far, far, -far};
  for (const double x : {region.x, region.x + region.width})
    for (const double y : {region.y, region.y + region.height}) {
      const Point p = plane.level({x, y});
      box.left = std::min(box.left, p.x), box.right = std::max(box.right, p.x);
      box.top = std::min(box.top, p.y), box.bottom = std::max(box.bottom, p.y);
    }
  return box;
}

/// The whole picture pixels around a box of level coordinates.
cv::Rect picture_box(const WaterPlane& plane, const Box& box) {
  constexpr double limit = 1e6;
  double left = limit, right = -limit, top = limit, bottom = -limit;
  for (const double x : {box.left, box.right})
    for (const double y : {box.top, box.bottom}) {
      const Point p = plane.picture({x, y});
      left = std::max(-limit, std::min(left, p.x)), right = std::min(limit, std::max(right, p.x));
      top = std::max(-limit, std::min(top, p.y)), bottom = std::min(limit, std::max(bottom, p.y));
    }
  return {cv::Point(static_cast<int>(std::floor(left)) - 1, static_cast<int>(std::floor(top)) - 1),
          cv::Point(static_cast<int>(std::ceil(right)) + 1, static_cast<int>(std::ceil(bottom)) + 1)};
}

/// Calls `move(level)`, which changes it, for each point below the horizon.
template <class Move>
void for_each_level(const WaterPlane& plane, float* x, float* y, int count, const Move& move) {
  for (int i = 0; i < count; ++i) {
    Point level = plane.level({x[i], y[i]});
    if (level.y <= plane.horizon()) continue;
    move(level);
    const Point to = plane.picture(level);
    x[i] = static_cast<float>(to.x), y[i] = static_cast<float>(to.y);
  }
}

/// The kernel for batches; what it leaves out, one by one.
template <class Kernel, class One>
void in_batches(const WaterPlane& plane, float* x, float* y, int count, const Kernel& kernel, const One& one) {
  std::array<int, water_batch> left_out;
  for (int first = 0; first < count; first += water_batch) {
    const int batch = std::min<int>(water_batch, count - first);
    kernel(x + first, y + first, batch, left_out.data());
    for (int i = 0; i < batch; ++i)
      if (left_out[i]) for_each_level(plane, x + first + i, y + first + i, 1, one);
  }
}

/// Nodes that hold no place.
water_nodes no_nodes() {
  static constexpr float zeros[4] = {};
  return {zeros, 2, std::numeric_limits<float>::max(), 0, 1, 1};
}

}  // namespace

RaisedWater::RaisedWater(const WaterPlane& plane, cv::Size picture, cv::Rect region, FilteredWater heights)
    : plane_(plane), heights_(std::move(heights)) {
  const Point centre = plane.picture({0, 0}), right = plane.picture({1, 0});
  const double up = std::abs(plane.up_z());
  const double most_kappa = up > 0 ? (1 - nearest) / up : std::numeric_limits<float>::max();
  water_.centre_x = static_cast<float>(centre.x), water_.centre_y = static_cast<float>(centre.y);
  water_.along_x = static_cast<float>(right.x - centre.x), water_.along_y = static_cast<float>(right.y - centre.y);
  water_.horizon = static_cast<float>(plane.horizon());
  water_.kappa_of_height = static_cast<float>(plane.cosine() / (plane.focal() * plane.height()));
  water_.up_z = static_cast<float>(plane.up_z());
  water_.pull = static_cast<float>(plane.focal() * plane.cosine());
  water_.most_kappa = static_cast<float>(most_kappa);
  water_.heights = water_.sources = no_nodes();

  const Box box = level_box(plane, {0, 0, picture.width, picture.height});
  const double kappa = std::min(most_kappa, std::max(0.0, plane.slant(box.bottom)) * heights_.bound() / plane.height());
  const double far_x = up * std::max(std::abs(box.left), std::abs(box.right));
  const double far_y = water_.pull + up * std::max(std::abs(box.top), std::abs(box.bottom));
  reach_ = static_cast<float>(kappa / (1 - kappa * up) * std::hypot(far_x, far_y) * (1 + 1e-5));
  const cv::Rect seen = spread(region) & cv::Rect(-2, -2, picture.width + 4, picture.height + 4);
  if (!at_rest()) keep_region(seen, picture.height);
}

/// The point r goes to r + share (n - n_z r), share = kappa / (1 + kappa n_z).
RaisedWater::Raise RaisedWater::raise(Point level) const {
  float down;
  const float height = heights_.at(level, &down);
  const float below = static_cast<float>(level.y) - water_.horizon;
  return {raised_share(water_, height, below), -(down * below + height) * water_.kappa_of_height * water_.pull};
}

double RaisedWater::lift(float share, double level_y) const { return -share * (water_.pull + water_.up_z * level_y); }

/// The highest crest and the deepest trough lift a point in proportion to its distance from the horizon: the sides of the
/// box bound where it goes.
cv::Rect RaisedWater::spread(const cv::Rect& box) const {
  if (box.empty()) return box;
  const Box level = level_box(plane_, box);
  Box reached = level;
  for (const double y : {std::max(level.top, plane_.horizon()), std::max(level.bottom, plane_.horizon())})
    for (const double rise : {heights_.bound(), -heights_.bound()}) {
      const float below = static_cast<float>(y - plane_.horizon());
      const float share = raised_share(water_, static_cast<float>(rise), below);
      const double to_y = y + lift(share, y);
      reached.top = std::min(reached.top, to_y), reached.bottom = std::max(reached.bottom, to_y);
      for (const double x : {level.left, level.right}) {
        const double to_x = x - share * water_.up_z * x;
        reached.left = std::min(reached.left, to_x), reached.right = std::max(reached.right, to_x);
      }
    }
  return picture_box(plane_, reached);
}

/// y of the point that comes to level_y when it is raised by `rise`.
double RaisedWater::furthest_source(double level_y, double rise) const {
  const double slant = plane_.slant(level_y), eta = rise / plane_.height();
  const double shrink = std::max(1e-3, 1 - eta - slant * eta * plane_.up_z());
  return plane_.horizon() + (level_y - plane_.horizon()) / shrink;
}

void RaisedWater::keep_region(cv::Rect region, int picture_height) {
  const Box box = level_box(plane_, region);
  if (region.empty() || box.bottom <= plane_.horizon()) return;
  const double top = std::max(box.top - 1, plane_.horizon()), bottom = box.bottom + 1;
  const int first_target = heights_.line(top), last_target = heights_.line(bottom) + 1;
  const int first = heights_.line(std::max(plane_.horizon(), furthest_source(top, -heights_.bound()))) - 1;
  const int most =
      std::min(heights_.line(furthest_source(bottom, heights_.bound())) + 1, last_target + 2 * picture_height);
  // Looking down, what is seen in a column comes from a little beside it.
  const double beside = plane_.up_z() == 0 ? 1 : Ripmap::block;
  heights_.keep(heights_.column(box.left - beside), heights_.column(box.right + beside) + 1,
                std::min(first, first_target), last_target);
  while (heights_.last_line() < most && !all_seen(last_target))
    heights_.keep_more(std::min(most, heights_.last_line() + growth));
  water_.heights = heights_.kept_nodes();

  sources_.create(last_target + 1 - first_target, static_cast<int>(water_.heights.last_column) + 1);
  water_.sources = {sources_[0],
                    static_cast<int>(sources_.step1()),
                    water_.heights.x,
                    static_cast<float>(heights_.node_y(first_target)),
                    water_.heights.last_column,
                    static_cast<float>(sources_.rows - 1)};
  parallel_rows(sources_.cols, strip, [&](int begin, int end) { sweep(begin, end - begin); });
}

/// True where the nearest kept line comes to lie below the last target in all columns.
bool RaisedWater::all_seen(int last_target) const {
  const int j = heights_.last_line();
  std::vector<float> to_y(static_cast<size_t>(heights_.kept_nodes().last_column) + 1);
  raised_line(&water_, heights_.kept_line(j), static_cast<float>(heights_.node_y(j)), static_cast<int>(to_y.size()),
              to_y.data());
  return *std::min_element(to_y.begin(), to_y.end()) >= heights_.node_y(last_target);
}

/// One strip of columns from the nearest line to the furthest. A line shows itself in a column where it rises above the
/// highest place, `seen`, that the nearer ones have reached.
void RaisedWater::sweep(int first_column, int columns) {
  const auto line = has_avx2() ? raised_line_avx2 : raised_line;
  const int stride = water_.sources.stride;
  const float first_y = water_.sources.y;
  float* const sources = &sources_(0, first_column);
  std::array<float, strip> here, before, seen;
  std::array<int, strip> target;  // the next line of sources_, and the place that it stands for
  std::array<float, strip> place;
  target.fill(sources_.rows - 1);
  place.fill(first_y + static_cast<float>(sources_.rows - 1));
  const auto found = [&](int i, float source) {
    sources[target[i] * stride + i] = source - place[i];
    place[i] = first_y + static_cast<float>(--target[i]);
  };

  float y = static_cast<float>(heights_.node_y(heights_.last_line()));
  for (int j = heights_.last_line(); j >= heights_.first_line(); --j, --y) {
    line(&water_, heights_.kept_line(j) + first_column, y, columns, here.data());
    if (j == heights_.last_line()) {
      for (int i = 0; i < columns; ++i)  // nearer than what is kept: displaced like that
        while (target[i] >= 0 && place[i] > here[i]) found(i, place[i] + y - here[i]);
      seen = here;
    }
    for (int i = 0; i < columns; ++i) {
      if (here[i] < seen[i]) {
        const float slope = 1 / (before[i] - here[i]);
        while (target[i] >= 0 && place[i] > here[i]) found(i, y + (place[i] - here[i]) * slope);
        seen[i] = here[i];
      }
    }
    before = here;
  }
  for (int i = 0; i < columns; ++i)
    while (target[i] >= 0) found(i, place[i]);
}

void RaisedWater::map_level(Point& level) const {
  const float share = raise(level).share;
  level = {level.x - share * water_.up_z * level.x, level.y + lift(share, level.y)};
}

/// The search for one place, where no nodes are kept: from where the highest wave could come from, upwards to the first
/// line that reaches it. Steps are pixels, far below the horizon a share of the distance to it.
void RaisedWater::unmap_level(Point& level) const {
  const Point to = level;
  const auto source = [&](double y) {
    return Point{to.x * (water_.pull + water_.up_z * y) / (water_.pull + water_.up_z * to.y), y};
  };
  const auto seen_at = [&](double y) { return y + lift(raise(source(y)).share, y); };
  double nearer = furthest_source(to.y, heights_.bound()), before = seen_at(nearer);
  while (nearer > plane_.horizon()) {
    const double below = nearer - plane_.horizon();
    double y = std::max(plane_.horizon(), nearer - std::max(1.0, below / 256));
    const double here = seen_at(y);
    if (here <= to.y) {
      for (double low = y, at_low = here; nearer - low > 1e-3 && before > at_low;) {
        y = low + (to.y - at_low) / (before - at_low) * (nearer - low);
        const double at_y = seen_at(y);
        if (std::abs(at_y - to.y) < 1e-3) break;
        (at_y < to.y ? low : nearer) = y;
        (at_y < to.y ? at_low : before) = at_y;
      }
      level = source(y);
      return;
    }
    nearer = y, before = here;
  }
}

void RaisedWater::map(float* x, float* y, int count) const {
  if (at_rest()) return;
  const auto kernel = has_avx2() ? raised_map_avx2 : raised_map;
  in_batches(
      plane_, x, y, count, [&](float* a, float* b, int batch, int* out) { kernel(&water_, a, b, batch, out); },
      [&](Point& level) { map_level(level); });
}

void RaisedWater::unmap(float* x, float* y, int count) const {
  if (at_rest()) return;
  const auto kernel = has_avx2() ? raised_unmap_avx2 : raised_unmap;
  in_batches(
      plane_, x, y, count, [&](float* a, float* b, int batch, int* out) { kernel(&water_, a, b, batch, out); },
      [&](Point& level) { unmap_level(level); });
}

MirrorWater::MirrorWater(const WaterPlane& plane, cv::Size picture, cv::Rect region, FilteredWater slopes_right,
                         FilteredWater slopes_away, double pixels_per_slope)
    : plane_(plane),
      right_(std::move(slopes_right)),
      away_(std::move(slopes_away)),
      reach_(static_cast<float>(pixels_per_slope * std::hypot(right_.bound(), away_.bound()) * (1 + 1e-5))) {
  if (level_box(plane, {0, 0, picture.width, picture.height}).bottom <= plane.horizon()) reach_ = 0;
  const Point centre = plane.picture({0, 0}), right = plane.picture({1, 0});
  water_.centre_x = static_cast<float>(centre.x), water_.centre_y = static_cast<float>(centre.y);
  water_.along_x = static_cast<float>(right.x - centre.x), water_.along_y = static_cast<float>(right.y - centre.y);
  water_.horizon = static_cast<float>(plane.horizon());
  water_.pixels = static_cast<float>(pixels_per_slope);
  water_.fade = mirror_fade * static_cast<float>(picture.width);
  water_.right = water_.away = no_nodes();
  const cv::Rect seen = spread(region) & cv::Rect(-2, -2, picture.width + 4, picture.height + 4);
  const Box box = level_box(plane, seen);
  if (at_rest() || region.empty() || box.bottom <= plane.horizon()) return;
  for (FilteredWater* slopes : {&right_, &away_})
    slopes->keep(slopes->column(box.left - 1), slopes->column(box.right + 1) + 1,
                 slopes->line(std::max(plane.horizon(), box.top - 1)), slopes->line(box.bottom + 1) + 1);
  water_.right = right_.kept_nodes(), water_.away = away_.kept_nodes();
}

Point MirrorWater::displaced(Point level) const {
  const double below = std::max(0.0, level.y - plane_.horizon());
  const double scale = water_.pixels * below / (below + water_.fade);
  return {scale * right_.at(level), -scale * away_.at(level)};
}

void MirrorWater::move(int rounds, float sign, float* x, float* y, int count) const {
  if (at_rest()) return;
  const auto kernel = has_avx2() ? mirror_move_avx2 : mirror_move;
  in_batches(
      plane_, x, y, count,
      [&](float* a, float* b, int batch, int* out) { kernel(&water_, rounds, sign, a, b, batch, out); },
      [&](Point& level) {
        const Point from = level;
        for (int round = 0; round < rounds; ++round) {
          const Point d = displaced(level);
          level = {from.x + sign * d.x, from.y + sign * d.y};
        }
      });
}

void MirrorWater::map(float* x, float* y, int count) const { move(mirror_rounds, 1, x, y, count); }

void MirrorWater::unmap(float* x, float* y, int count) const { move(1, -1, x, y, count); }

bool MirrorWater::are_kept_nodes(float x0, float y0, float step, int count) const {
  const water_nodes& kept = water_.right;
  const float column = x0 - water_.centre_x - kept.x, line = y0 - water_.centre_y - kept.y;
  const bool level = water_.along_x == 1 && water_.along_y == 0;
  return level && step == 1 && column == std::floor(column) && line == std::floor(line) && column >= 0 && line >= 0 &&
         column + static_cast<float>(count - 1) <= kept.last_column && line <= kept.last_line;
}

void MirrorWater::unmap_row(float x0, float y0, float step, int count, float* x, float* y) const {
  if (at_rest() || !are_kept_nodes(x0, y0, step, count)) {
    Displacement::unmap_row(x0, y0, step, count, x, y);
    return;
  }
  for (int i = 0; i < count; ++i) x[i] = x0 + static_cast<float>(i);
  std::fill_n(y, count, y0);
  const water_nodes& kept = water_.right;
  const float level_x = x0 - water_.centre_x, level_y = y0 - water_.centre_y;
  const ptrdiff_t line = static_cast<ptrdiff_t>(level_y - kept.y), column = static_cast<ptrdiff_t>(level_x - kept.x);
  const ptrdiff_t first = line * kept.stride + column;
  mirror_row(&water_, water_.right.values + first, water_.away.values + first, level_y, count, x, y);
}

}  // namespace stillwater
