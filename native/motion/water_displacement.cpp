#include "motion/water_displacement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/parallel.h"

namespace stillwater {
namespace {

/// A raised point keeps at least this share of its distance along the optical axis.
constexpr float nearest = 0.25f;

/// Columns that one sweep takes along.
constexpr int strip = Ripmap::block;

/// Lines by which the kept nodes grow until they hold all that is seen in the region.
constexpr int growth = 32;

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

/// Calls `move(level_x, level_y)`, which changes them, for each point below the horizon.
template <class Move>
void for_each_level(const WaterPlane& plane, float* x, float* y, int count, const Move& move) {
  for (int i = 0; i < count; ++i) {
    const Point p = plane.level({x[i], y[i]});
    if (p.y <= plane.horizon()) continue;
    float level_x = static_cast<float>(p.x), level_y = static_cast<float>(p.y);
    const float from_x = level_x, from_y = level_y;
    move(level_x, level_y);
    const Point q = plane.picture({p.x + (level_x - from_x), p.y + (level_y - from_y)});
    x[i] = static_cast<float>(q.x), y[i] = static_cast<float>(q.y);
  }
}

}  // namespace

RaisedWater::RaisedWater(const WaterPlane& plane, cv::Size picture, cv::Rect region, FilteredWater heights)
    : plane_(plane),
      heights_(std::move(heights)),
      eye_(static_cast<float>(plane.height())),
      to_slant_(static_cast<float>(plane.cosine() / plane.focal())),
      horizon_(static_cast<float>(plane.horizon())),
      up_z_(static_cast<float>(plane.up_z())),
      pull_(static_cast<float>(plane.focal() * plane.cosine())) {
  const Box box = level_box(plane, {0, 0, picture.width, picture.height});
  const double slant = std::max(0.0, plane.slant(box.bottom)), up = std::abs(plane.up_z());
  double kappa = slant * heights_.bound() / plane.height();
  if (up > 0) kappa = std::min(kappa, (1 - nearest) / up);
  const double far_x = up * std::max(std::abs(box.left), std::abs(box.right));
  const double far_y = pull_ + up * std::max(std::abs(box.top), std::abs(box.bottom));
  reach_ = static_cast<float>(kappa / (1 - kappa * up) * std::hypot(far_x, far_y) * (1 + 1e-5));
  if (reach_ > 0) keep_region(region, picture.height);
}

/// kappa / (1 + kappa n_z): the point r goes to r + share (n - n_z r) along the line to the vertical vanishing point n / n_z.
RaisedWater::Raise RaisedWater::raise(float level_x, float level_y) const {
  float down;
  const float height = heights_.at(level_x, level_y, &down);
  const float slant = (level_y - horizon_) * to_slant_;
  float kappa = height * slant / eye_;
  if (up_z_ != 0) kappa = std::clamp(kappa * up_z_, nearest - 1, 1 - nearest) / up_z_;
  const float slope = (down * slant + height * to_slant_) / eye_;
  return {kappa / (1 + kappa * up_z_), -slope * pull_};
}

float RaisedWater::lift(float share, float level_y) const { return -share * (pull_ + up_z_ * level_y); }

/// y of the point that comes to level_y when it is raised by `rise`.
double RaisedWater::lowest_source(double level_y, double rise) const {
  const double slant = plane_.slant(level_y), eta = rise / plane_.height();
  const double shrink = std::max(1e-3, 1 - eta - slant * eta * plane_.up_z());
  return plane_.horizon() + (level_y - plane_.horizon()) / shrink;
}

void RaisedWater::keep_region(cv::Rect region, int picture_height) {
  const Box box = level_box(plane_, region);
  if (region.empty() || box.bottom <= plane_.horizon()) return;
  const double top = std::max(box.top - 1, plane_.horizon());
  first_line_ = heights_.line(top);
  const int last_target = heights_.line(box.bottom + 1) + 1;
  const int top_source = heights_.line(std::max(plane_.horizon(), lowest_source(top, -heights_.bound()))) - 1;
  const int most = std::min(heights_.line(lowest_source(box.bottom + 1, heights_.bound())) + 1, last_target + 2 * picture_height);
  // Looking down, what is seen in a column comes from a little beside it.
  const double beside = plane_.up_z() == 0 ? 1 : strip;
  heights_.keep(heights_.column(box.left - beside), heights_.column(box.right + beside) + 1, std::min(top_source, first_line_), last_target);
  const auto all_seen = [&] {
    const int j = heights_.last_line();
    const float y = static_cast<float>(heights_.node_y(j));
    for (int i = heights_.first_column(); i <= heights_.last_column(); ++i)
      if (y + lift(raise(static_cast<float>(heights_.node_x(i)), y).share, y) < heights_.node_y(last_target)) return false;
    return true;
  };
  while (heights_.last_line() < most && !all_seen()) heights_.keep_more(std::min(most, heights_.last_line() + growth));

  sources_.create(last_target + 1 - first_line_, heights_.last_column() + 1 - heights_.first_column());
  parallel_rows(sources_.cols / strip, 1, [&](int first, int last) {
    for (int s = first; s < last; ++s) sweep(s * strip);
  });
}

/// One strip of columns from the nearest line to the furthest. `seen` is the highest place in the picture that the nearer
/// lines have reached; a line shows itself where it rises above that.
void RaisedWater::sweep(int first_column) {
  std::array<float, strip> seen, before;
  std::array<int, strip> target;
  target.fill(sources_.rows - 1);
  const float first_y = static_cast<float>(heights_.node_y(first_line_));
  for (int j = heights_.last_line(); j >= heights_.first_line(); --j) {
    const float* heights = heights_.kept_line(j) + first_column;
    const float y = static_cast<float>(heights_.node_y(j));
    const float slant = std::max(0.0f, (y - horizon_) * to_slant_);
    for (int i = 0; i < strip; ++i) {
      float kappa = heights[i] * slant / eye_;
      if (up_z_ != 0) kappa = std::clamp(kappa * up_z_, nearest - 1, 1 - nearest) / up_z_;
      const float here = y + lift(kappa / (1 + kappa * up_z_), y);
      float* source = &sources_(0, first_column + i);
      const auto rest = [&](float place) {  // beyond the kept lines: displaced like the last one
        for (; target[i] >= 0 && first_y + static_cast<float>(target[i]) > place; --target[i])
          source[target[i] * static_cast<int>(sources_.step1())] = y - here;
      };
      if (j == heights_.last_line()) {
        rest(here);
      } else if (here < seen[i]) {
        for (; target[i] >= 0; --target[i]) {
          const float place = first_y + static_cast<float>(target[i]);
          if (place <= here) break;
          source[target[i] * static_cast<int>(sources_.step1())] = y + (place - here) / (before[i] - here) - place;
        }
      }
      seen[i] = j == heights_.last_line() ? here : std::min(seen[i], here);
      before[i] = here;
      if (j == heights_.first_line()) rest(-std::numeric_limits<float>::infinity());
    }
  }
}

void RaisedWater::map(float* x, float* y, int count) const {
  if (at_rest()) return;
  for_each_level(plane_, x, y, count, [&](float& level_x, float& level_y) {
    const float share = raise(level_x, level_y).share;
    const float to_y = level_y + lift(share, level_y);
    level_x -= share * up_z_ * level_x;
    level_y = to_y;
  });
}

void RaisedWater::unmap(float* x, float* y, int count) const {
  if (at_rest()) return;
  for_each_level(plane_, x, y, count, [&](float& level_x, float& level_y) {
    const float to_x = level_x, to_y = level_y;
    // Where it would come from along its column; x along the line to the vanishing point; then one step of Newton's, but
    // for the pixels in which a crest ends, where the two sides have nothing to do with each other.
    float from = to_y + source_offset(to_x, to_y);
    const auto x_of = [&](float from_y) { return to_x * (pull_ + up_z_ * from_y) / (pull_ + up_z_ * to_y); };
    const Raise at = raise(x_of(from), from);
    const float missed = from + lift(at.share, from) - to_y, steepness = 1 + at.down;
    if (steepness > 0.5f && std::abs(missed) < 0.5f) from -= missed / steepness;
    level_x = x_of(from), level_y = from;
  });
}

float RaisedWater::source_offset(float level_x, float level_y) const {
  const float x = level_x - static_cast<float>(heights_.node_x(heights_.first_column()));
  const float y = level_y - static_cast<float>(heights_.node_y(first_line_));
  if (x < 0 || y < 0 || x >= static_cast<float>(sources_.cols - 1) || y >= static_cast<float>(sources_.rows - 1))
    return searched_offset(level_x, level_y);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
  const float *a = sources_[j] + i, *b = sources_[j + 1] + i;
  const float above = a[0] + u * (a[1] - a[0]), beneath = b[0] + u * (b[1] - b[0]);
  return above + v * (beneath - above);
}

/// The same for one place: down to where the highest wave could come from, then upwards to the first line that reaches it.
float RaisedWater::searched_offset(float level_x, float level_y) const {
  float y = static_cast<float>(lowest_source(level_y, heights_.bound()));
  float before = y + lift(raise(level_x, y).share, y);
  while (y > horizon_) {
    const float higher = std::max(horizon_, y - 1);
    const float here = higher + lift(raise(level_x, higher).share, higher);
    if (here <= level_y) return higher + (before > here ? (level_y - here) / (before - here) * (y - higher) : 0) - level_y;
    y = higher, before = here;
  }
  return 0;
}

MirrorWater::MirrorWater(const WaterPlane& plane, cv::Size picture, cv::Rect region, FilteredWater slopes_right,
                         FilteredWater slopes_away, double pixels_per_slope)
    : plane_(plane),
      right_(std::move(slopes_right)),
      away_(std::move(slopes_away)),
      pixels_(static_cast<float>(pixels_per_slope)),
      fade_(0.02f * static_cast<float>(picture.width)),
      horizon_(static_cast<float>(plane.horizon())),
      reach_(static_cast<float>(pixels_per_slope * std::hypot(right_.bound(), away_.bound()) * (1 + 1e-5))) {
  if (level_box(plane, {0, 0, picture.width, picture.height}).bottom <= plane.horizon()) reach_ = 0;
  Box box = level_box(plane, region);
  if (at_rest() || region.empty() || box.bottom <= plane.horizon()) return;
  for (FilteredWater* slopes : {&right_, &away_})
    slopes->keep(slopes->column(box.left - reach_), slopes->column(box.right + reach_) + 1,
                 slopes->line(std::max(plane.horizon(), box.top - reach_)), slopes->line(box.bottom + reach_) + 1);
}

cv::Vec2f MirrorWater::displaced(float level_x, float level_y) const {
  const float below = std::max(0.0f, level_y - horizon_);
  const float scale = pixels_ * below / (below + fade_);
  return {scale * right_.at(level_x, level_y), -scale * away_.at(level_x, level_y)};
}

void MirrorWater::map(float* x, float* y, int count) const {
  if (at_rest()) return;
  for_each_level(plane_, x, y, count, [&](float& level_x, float& level_y) {
    const cv::Vec2f d = displaced(level_x, level_y);
    level_x += d[0], level_y += d[1];
  });
}

void MirrorWater::unmap(float* x, float* y, int count) const {
  constexpr int rounds = 3;
  if (at_rest()) return;
  for_each_level(plane_, x, y, count, [&](float& level_x, float& level_y) {
    const float to_x = level_x, to_y = level_y;
    for (int round = 0; round < rounds; ++round) {
      const cv::Vec2f d = displaced(level_x, level_y);
      level_x = to_x - d[0], level_y = to_y - d[1];
    }
  });
}

}  // namespace stillwater
