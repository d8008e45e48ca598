#include "motion/water_displacement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.h"
#include "motion/ripple.h"

namespace stillwater {
namespace {

/// Standard deviation of the filter for a footprint of length 1: as much as the pixel's square keeps of a wave of
/// two pixels.
constexpr double footprint_deviation = 0.4;

/// A raised point keeps at least this share of its distance along the optical axis.
constexpr double nearest = 0.25;

constexpr int rounds = 3;

/// No wave reaches the eye, however high the amplitude: above half its height the crests flatten.
double below_the_eye(double height, double eye) {
  const double share = std::abs(height) / eye;
  if (share <= 0.5) return height;
  const double over = 2 * share - 1;
  return std::copysign(eye * (0.5 + 0.5 * over / (1 + over)), height);
}

/// Far away a pixel is longer than the tile. Of a sea that doesn't repeat itself, the waves that run across the
/// view and so are not averaged out would then become fewer with the distance.
double lattice_damping(double along, double side) {
  const double longest = side / (2 * std::sqrt(std::numbers::pi));
  return along <= longest ? 1 : std::sqrt(longest / along);
}

}  // namespace

WaterDisplacement::WaterDisplacement(const WaterPlane& plane, const WaterSurface& surface, cv::Size picture,
                                     cv::Rect region)
    : plane_(plane),
      surface_(surface),
      picture_width_(picture.width),
      offset_x_(picture.width % 2 == 0 ? 0.5 : 0),
      offset_y_(picture.height % 2 == 0 ? 0.5 : 0) {
  measure(picture);
  if (!rest_) fill_grid(region);
}

/// The largest displacement of any point of the picture, from the largest value of the tile.
void WaterDisplacement::measure(cv::Size picture) {
  const auto largest = [&](const std::shared_ptr<const Ripmap>& values) { return surface_.amplitude * values->bound(); };
  double slant = 0, side = 0;
  for (const double x : {0, picture.width})
    for (const double y : {0, picture.height}) {
      const Point p = plane_.level({x, y});
      slant = std::max(slant, plane_.slant(p.y));
      const double u = -plane_.up_z() * p.x, v = -plane_.focal() * plane_.cosine() - plane_.up_z() * p.y;
      side = std::max(side, std::hypot(u, v));
    }
  if (surface_.heights) {
    const double height = below_the_eye(largest(surface_.heights), plane_.height());
    const double up = std::abs(plane_.up_z());
    double kappa = slant * height / plane_.height();
    if (up > 0) kappa = std::min(kappa, (1 - nearest) / up);
    reach_ = static_cast<float>(side * kappa / (1 - kappa * up) * (1 + 1e-5));
  } else {
    reach_ = static_cast<float>(std::hypot(largest(surface_.slopes_right), largest(surface_.slopes_away)) *
                                pixels_per_slope * picture_width_ * (1 + 1e-5));
  }
  rest_ = slant <= 0 || reach_ == 0;
  if (rest_) reach_ = 0;
}

void WaterDisplacement::fill_block(int block, int j, float* a, float* b) const {
  constexpr int count = Ripmap::block;
  const double y = node_y(j), x = node_x(block * count);
  const double slant = plane_.slant(y);
  if (slant <= 0) {
    std::fill_n(a, count, 0.0f);
    std::fill_n(b, count, 0.0f);
    return;
  }
  const double samples = surface_.samples_per_metre;
  const double lambda = plane_.height() / slant;
  const double away = lambda * (plane_.cosine() + plane_.up_z() * y / plane_.focal());
  const double width = lambda / plane_.focal() * samples, length = std::max(1.0, lambda / plane_.height()) * width;
  FootprintRow row;
  row.x = x * width, row.step = width, row.y = away * samples;
  row.across = footprint_deviation * width, row.along = footprint_deviation * length;
  row.shear_step = plane_.cosine() / plane_.focal(), row.shear_first = row.shear_step * x;
  const double damping = surface_.amplitude * lattice_damping(row.along, surface_.side);
  if (surface_.heights) {
    surface_.heights->filtered(row, a);
    for (int i = 0; i < count; ++i)
      a[i] = static_cast<float>(below_the_eye(damping * a[i], plane_.height()) * slant / plane_.height());
  } else {
    surface_.slopes_right->filtered(row, a);
    surface_.slopes_away->filtered(row, b);
    const float scale = static_cast<float>(damping * pixels_per_slope * picture_width_);
    for (int i = 0; i < count; ++i) a[i] *= scale, b[i] *= -scale;
  }
}

void WaterDisplacement::fill_grid(cv::Rect region) {
  constexpr double far = std::numeric_limits<double>::infinity();
  double left = far, right = -far, top = far, bottom = -far;
  for (const double x : {region.x, region.x + region.width})
    for (const double y : {region.y, region.y + region.height}) {
      const Point p = plane_.level({x, y});
      left = std::min(left, p.x), right = std::max(right, p.x);
      top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    }
  top = std::max(top, plane_.horizon());
  if (region.empty() || bottom <= top) return;
  constexpr int count = Ripmap::block;
  first_block_ = static_cast<int>(std::floor((left - offset_x_ - 1) / count));
  const int blocks = static_cast<int>(std::floor((right - offset_x_ + 1) / count)) + 1 - first_block_;
  first_row_ = static_cast<int>(std::floor(top - offset_y_));
  const int rows = static_cast<int>(std::ceil(bottom - offset_y_)) + 1 - first_row_;
  a_.create(rows, blocks * count);
  if (!surface_.heights) b_.create(rows, blocks * count);
  parallel_rows(rows, 8, [&](int first, int last) {
    std::array<float, count> unused;
    for (int j = first; j < last; ++j)
      for (int i = 0; i < blocks; ++i)
        fill_block(first_block_ + i, first_row_ + j, &a_(j, i * count),
                   b_.empty() ? unused.data() : &b_(j, i * count));
  });
}

WaterDisplacement::Node WaterDisplacement::node(int i, int j) const {
  constexpr int count = Ripmap::block;
  const int column = i - first_block_ * count, line = j - first_row_;
  if (column >= 0 && column < a_.cols && line >= 0 && line < a_.rows)
    return {a_(line, column), b_.empty() ? 0 : b_(line, column)};
  std::array<float, count> a, b;
  const int block = static_cast<int>(std::floor(static_cast<double>(i) / count));
  fill_block(block, j, a.data(), b.data());
  const int k = i - block * count;
  return {a[k], surface_.heights ? 0 : b[k]};
}

WaterDisplacement::Node WaterDisplacement::between(Point level) const {
  const double x = level.x - offset_x_, y = level.y - offset_y_;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const float u = static_cast<float>(x - i), v = static_cast<float>(y - j);
  const Node p = node(i, j), q = node(i + 1, j), r = node(i, j + 1), s = node(i + 1, j + 1);
  const auto mix = [&](float a, float b, float c, float d) { return (1 - v) * (a + u * (b - a)) + v * (c + u * (d - c)); };
  return {mix(p.a, q.a, r.a, s.a), mix(p.b, q.b, r.b, s.b)};
}

WaterDisplacement::Shift WaterDisplacement::displaced(Point level) const {
  if (plane_.slant(level.y) <= 0) return {0, 0};
  const Node n = between(level);
  if (!surface_.heights) return {n.a, n.b};
  const double bent = std::max(nearest - 1, std::min(1 - nearest, n.a * plane_.up_z()));
  const double kappa = plane_.up_z() != 0 ? bent / plane_.up_z() : n.a;
  const double share = kappa / (1 + bent);
  return {-share * plane_.up_z() * level.x, -share * (plane_.focal() * plane_.cosine() + plane_.up_z() * level.y)};
}

void WaterDisplacement::map(float* x, float* y, int count) const {
  if (rest_) return;
  for (int i = 0; i < count; ++i) {
    const Point p = plane_.level({x[i], y[i]});
    const Shift d = displaced(p);
    if (d.x == 0 && d.y == 0) continue;
    const Point q = plane_.picture({p.x + d.x, p.y + d.y});
    x[i] = static_cast<float>(q.x), y[i] = static_cast<float>(q.y);
  }
}

void WaterDisplacement::unmap(float* x, float* y, int count) const {
  if (rest_) return;
  for (int i = 0; i < count; ++i) {
    const Point p = plane_.level({x[i], y[i]});
    if (plane_.slant(p.y) <= 0) continue;
    Point q = p;
    for (int round = 0; round < rounds; ++round) {
      const Shift d = displaced(q);
      q = {p.x - d.x, p.y - d.y};
    }
    q = plane_.picture(q);
    x[i] = static_cast<float>(q.x), y[i] = static_cast<float>(q.y);
  }
}

}  // namespace stillwater
