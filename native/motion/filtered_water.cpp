#include "motion/filtered_water.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int block_side = Ripmap::block;

/// Standard deviation of the filter for a footprint of length 1: it keeps nearly as much of a wave of two pixels as the
/// mean over the pixel's square does, and, unlike that, nothing of shorter ones.
constexpr double footprint_deviation = 0.4;

double half_pixel(int pixels) { return pixels % 2 == 0 ? 0.5 : 0; }

int floor_div(int a, int b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

/// Values above half the ceiling bend towards it.
float below(float value, float ceiling) {
  const float share = std::abs(value) / ceiling;
  if (share <= 0.5f) return value;
  const float over = 2 * share - 1;
  return std::copysign(ceiling * (0.5f + 0.5f * over / (1 + over)), value);
}

/// Far away a pixel is longer than the tile. Of a sea that doesn't repeat itself, the waves that run across the view,
/// which no pixel's length averages out, become fewer with the distance; those of a tile stay as many, and are damped
/// instead.
double lattice_damping(double along, double side) {
  const double longest = side / (2 * std::sqrt(std::numbers::pi));
  return along <= longest ? 1 : std::sqrt(longest / along);
}

}  // namespace

LocalWind::LocalWind(const GustField& field, const Moment& moment, const WaterPlane& plane, cv::Size picture)
    : factors_(1, 1, 1.0f) {
  if (moment.wind.gusts == 0) return;
  while (spacing_ > 4 && spacing_ > moment.wind.gust_size * picture.width / 8) spacing_ /= 2;
  double left = 0, right = 0, top = 0, bottom = 0;
  for (const double x : {0, picture.width})
    for (const double y : {0, picture.height}) {
      const Point p = plane.level({x, y});
      left = std::min(left, p.x), right = std::max(right, p.x), top = std::min(top, p.y),
      bottom = std::max(bottom, p.y);
    }
  const auto before = [&](double place) { return static_cast<int>(std::floor(place / spacing_)); };
  first_column_ = before(left) - 1, first_line_ = before(top) - 1;
  factors_.create(before(bottom) + 3 - first_line_, before(right) + 3 - first_column_);
  const auto corner_at = [&](int i, int j) {
    return plane.picture({static_cast<double>((first_column_ + i) * spacing_),
                          static_cast<double>((first_line_ + j) * spacing_)});
  };
  parallel_rows(factors_.rows, 1, [&](int first, int last) {
    for (int j = first; j < last; ++j) {
      const Point left_end = corner_at(0, j), next = corner_at(1, j);
      field.factors(left_end, {next.x - left_end.x, next.y - left_end.y}, moment, factors_.cols, factors_[j]);
    }
  });
  largest_ = *std::max_element(factors_.begin(), factors_.end());
}

float LocalWind::corner(int column, int line) const {
  return factors_(std::clamp(line - first_line_, 0, factors_.rows - 1),
                  std::clamp(column - first_column_, 0, factors_.cols - 1));
}

void LocalWind::strengthen(int block, int blocks, int j, float factor, float* values) const {
  const int count = blocks * block_side;
  if (factors_.total() == 1) {
    for (int i = 0; i < count; ++i) values[i] *= factor;
    return;
  }
  const int spacing = spacing_, line = floor_div(j, spacing);
  const float share = static_cast<float>(j - line * spacing) / static_cast<float>(spacing);
  const auto at = [&](int column) {
    const float above = corner(column, line);
    return factor * (above + share * (corner(column, line + 1) - above));
  };
  int column = block * block_side / spacing;
  float left = at(column);
  for (int first = 0; first < count; first += spacing) {
    const float right = at(++column), step = (right - left) / static_cast<float>(spacing);
    for (int i = 0; i < spacing; ++i) values[first + i] *= left + step * static_cast<float>(i);
    left = right;
  }
}

FilteredWater::FilteredWater(const WaterPlane& plane, cv::Size picture, std::shared_ptr<const Ripmap> tile,
                             TileOnPlane on_plane, double factor, double ceiling, std::shared_ptr<const LocalWind> wind)
    : plane_(plane),
      tile_(std::move(tile)),
      on_plane_(on_plane),
      factor_(factor),
      ceiling_(ceiling),
      wind_(std::move(wind)),
      offset_x_(half_pixel(picture.width)),
      offset_y_(half_pixel(picture.height)) {
  bound_ = factor * tile_->bound() * wind_->largest();
  bends_ = ceiling > 0 && bound_ > ceiling / 2;
  if (bends_) bound_ = below(static_cast<float>(bound_), static_cast<float>(ceiling));
}

int FilteredWater::column(double level_x) const { return static_cast<int>(std::floor(level_x - offset_x_)); }

int FilteredWater::line(double level_y) const { return static_cast<int>(std::floor(level_y - offset_y_)); }

void FilteredWater::keep(int first_column, int last_column, int first_line, int last_line) {
  first_block_ = floor_div(first_column, block_side);
  first_line_ = first_line;
  kept_.create(1, (floor_div(last_column, block_side) + 1 - first_block_) * block_side);
  kept_.resize(0);
  kept_.reserve((last_line + 1 - first_line) * 3 / 2);  // what keep_more() usually adds fits
  keep_more(last_line);
}

void FilteredWater::keep_more(int last_line) {
  const int before = kept_.rows, rows = last_line + 1 - first_line_;
  kept_.resize(rows);
  parallel_rows(rows - before, 8, [&](int first, int last) {
    for (int j = before + first; j < before + last; ++j)
      fill_blocks(first_line_ + j, first_block_, kept_.cols / block_side, kept_[j]);
  });
}

void FilteredWater::fill_blocks(int j, int first, int blocks, float* values) const {
  const double y = node_y(j), slant = plane_.slant(y);
  if (slant <= 0) {
    std::fill_n(values, blocks * block_side, 0.0f);
    return;
  }
  const double samples = on_plane_.samples_per_metre;
  const double lambda = plane_.height() / slant;
  const double away = lambda * (plane_.cosine() + plane_.up_z() * y / plane_.focal());
  const double width = lambda / plane_.focal() * samples, length = std::max(1.0, 1 / slant) * width;
  const FootprintLine footprint{.step = width,
                                .y = away * samples,
                                .across = footprint_deviation * width,
                                .along = footprint_deviation * length,
                                .shear_step = plane_.cosine() / plane_.focal()};
  const Ripmap::Line line(*tile_, footprint);
  const float factor = static_cast<float>(factor_ * lattice_damping(footprint.along, on_plane_.side));
  for (int i = 0; i < blocks; ++i) {
    const double x = node_x((first + i) * block_side);
    line.filtered(x * width, footprint.shear_step * x, values + i * block_side);
  }
  wind_->strengthen(first, blocks, j, factor, values);
  if (bends_)
    for (int i = 0; i < blocks * block_side; ++i) values[i] = below(values[i], static_cast<float>(ceiling_));
}

water_nodes FilteredWater::kept_nodes() const {
  return {kept_[0],
          static_cast<int>(kept_.step1()),
          static_cast<float>(node_x(first_block_ * block_side)),
          static_cast<float>(node_y(first_line_)),
          static_cast<float>(kept_.cols - 1),
          static_cast<float>(kept_.rows - 1)};
}

float FilteredWater::node(int i, int j) const {
  const int block = floor_div(i, block_side);
  const int column = i - first_block_ * block_side, line = j - first_line_;
  if (column >= 0 && column < kept_.cols && line >= 0 && line < kept_.rows) return kept_(line, column);
  std::array<float, block_side> values;
  fill_blocks(j, block, 1, values.data());
  return values[i - block * block_side];
}

float FilteredWater::at(Point level, float* down) const {
  const int i = column(level.x), j = line(level.y);
  const float u = static_cast<float>(level.x - node_x(i)), v = static_cast<float>(level.y - node_y(j));
  const float a = node(i, j), b = node(i + 1, j), c = node(i, j + 1), d = node(i + 1, j + 1);
  const float above = a + u * (b - a), beneath = c + u * (d - c);
  if (down) *down = beneath - above;
  return above + v * (beneath - above);
}

}  // namespace stillwater
