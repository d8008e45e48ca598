#include "flow/flow_paths.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "flow/streamline.h"

namespace stillwater {
namespace {

// No copy is carried further than this share of the layer's longer side.
constexpr double largest_way = 0.25;
constexpr int most_turns = 1 << 16;

// Phases are smooth noise: cells so large that what is seen moves no more than this share faster or slower for it.
constexpr double change_of_speed = 0.35;
constexpr double largest_phase = 0.5;    // to both sides: one whole period
constexpr double finest_cells = 1.0 / 12, coarsest_cells = 0.5;  // of the longer side
constexpr std::uint64_t noise_seed = 2003;

// A life is as long as the picture is stretched, half way through it, no more than this ...
constexpr double calm = 1.8;
constexpr double torn = 2.8;  // ... and shorter wherever it is stretched as much as this.
constexpr int lives_blur = 9;  // knots

double smooth_step(double t) {
  const double held = std::clamp(t, 0.0, 1.0);
  return held * held * (3 - 2 * held);
}

double largest_square(const Field& velocity) {
  float square = 0;
  for (const cv::Vec2f& v : velocity) square = std::max(square, v.dot(v));
  return square;
}

// Value noise, -1 .. 1, of a place in cells.
double noise(double x, double y) {
  const auto left = static_cast<std::int64_t>(std::floor(x)), top = static_cast<std::int64_t>(std::floor(y));
  const auto at = [](std::int64_t column, std::int64_t row) { return 2 * random_uniform(noise_seed, {column, row}) - 1; };
  const double across = smooth_step(x - static_cast<double>(left)), down = smooth_step(y - static_cast<double>(top));
  const double upper = at(left, top) + across * (at(left + 1, top) - at(left, top));
  const double lower = at(left, top + 1) + across * (at(left + 1, top + 1) - at(left, top + 1));
  return upper + down * (lower - upper);
}

// By how much the picture is stretched, or squeezed, along its worst direction where places move by `way`.
double stretch(const Streamlines& lines, int row, int column, double frames) {
  const int left = std::max(0, column - 1), right = std::min(lines.size().width - 1, column + 1);
  const int top = std::max(0, row - 1), bottom = std::min(lines.size().height - 1, row + 1);
  const auto along = [](const cv::Vec2f& from, const cv::Vec2f& to, int knots) {
    return knots == 0 ? cv::Vec2d() : cv::Vec2d(to - from) / (knots * Streamlines::apart);
  };
  const cv::Vec2d x = along(lines.displaced(row, left, frames), lines.displaced(row, right, frames), right - left);
  const cv::Vec2d y = along(lines.displaced(top, column, frames), lines.displaced(bottom, column, frames), bottom - top);
  const double a = 1 + x[0], b = y[0], c = x[1], d = 1 + y[1];  // singular values of a 2 x 2 matrix
  const double sum = std::hypot(a + d, c - b), difference = std::hypot(a - d, c + b);
  const double larger = (sum + difference) / 2, smaller = std::abs(sum - difference) / 2;
  return std::max(larger, 1 / std::max(smaller, 1e-3));
}

}  // namespace

FlowPaths::FlowPaths(std::vector<Field> velocities, double longest) : velocities_(std::move(velocities)), longest_(longest) {
  if (velocities_.empty()) throw BadInput("velocities: none is not at least one field");
  check::in_range("longest", longest, 0, 1e12, "frames");
  double square = 0;
  for (const Field& velocity : velocities_) {
    check::same_size("velocity", velocity, "the first velocity", velocities_.front());
    square = std::max(square, largest_square(velocity));
  }
  knots_ = Streamlines::knots_of(pixels());
  if (square == 0 || longest == 0) return;
  const double way = longest * std::sqrt(square), held = largest_way * std::max(pixels().width, pixels().height);
  while (way / turns_ > std::max(held, 1.0) && turns_ < most_turns) turns_ *= 2;
  longest_ /= turns_;
  for (const Field& velocity : velocities_) lines_.emplace_back(velocity, longest_);
  moves_.create(pixels());
  parallel_pixels(pixels(), [&](int y, int x) {
    moves_(y, x) = std::any_of(velocities_.begin(), velocities_.end(),
                               [&](const Field& velocity) { return velocity(y, x) != cv::Vec2f(); });
  });
  set_phases();
  set_lives();
}

// Root of the mean square of what moves, over half a period, px.
double FlowPaths::typical_way() const {
  double largest = 0;
  for (const Field& velocity : velocities_) {
    double sum = 0;
    int count = 0;
    for (const cv::Vec2f& v : velocity) {
      sum += v.dot(v);
      count += v != cv::Vec2f();
    }
    if (count > 0) largest = std::max(largest, sum / count);
  }
  return std::sqrt(largest) * longest_;
}

void FlowPaths::set_phases() {
  // The phase may change by change_of_speed over a period's way; noise is as steep as 3 over a cell.
  const double side = std::max(pixels().width, pixels().height), way = 2 * typical_way();
  const double cell = std::clamp(largest_phase * 3 * way / change_of_speed, finest_cells * side, coarsest_cells * side);
  const double size = std::min(largest_phase, change_of_speed * cell / (3 * std::max(way, 1e-6)));
  phases_.create(knots_);
  parallel_pixels(knots_, [&](int row, int column) {
    const double x = column * Streamlines::apart / cell, y = row * Streamlines::apart / cell;
    phases_(row, column) = static_cast<float>(1 + size * noise(x, y));
  });
}

void FlowPaths::set_lives() {
  for (int life = 0; life + 1 < flow_lives; ++life) {
    const double half_way = longest_ / (2 << life);
    Plane& shorter = shorter_.emplace_back(knots_);
    parallel_pixels(knots_, [&](int row, int column) {
      double most = 1;
      for (const Streamlines& lines : lines_)
        for (const double frames : {-half_way, half_way}) most = std::max(most, stretch(lines, row, column, frames));
      shorter(row, column) = static_cast<float>(smooth_step((most - calm) / (torn - calm)));
    });
    cv::blur(shorter, shorter, cv::Size(lives_blur, lives_blur), cv::Point(-1, -1), cv::BORDER_REPLICATE);
    for (const float share : shorter) short_lives_ = short_lives_ || share > 0;
  }
}

std::array<float, flow_lives> FlowPaths::lives_at(int row, int column) const {
  std::array<float, flow_lives> lives;
  float left = 1;
  for (int life = 0; life + 1 < flow_lives; ++life) {
    lives[life] = left * (1 - shorter_[life](row, column));
    left -= lives[life];
  }
  lives.back() = left;
  return lives;
}

cv::Vec2f FlowPaths::origin(const Flow& flow, int row, int column, double way) const {
  const cv::Vec2f first = lines_[flow.field].displaced(row, column, -way);
  if (flow.next_share == 0) return first;
  return first + static_cast<float>(flow.next_share) * (lines_[flow.next_field].displaced(row, column, -way) - first);
}

cv::Vec2d FlowPaths::to_next(const Flow& flow, cv::Vec2d place) const {
  const auto moved = [&](int field) { return SteadyFlow(velocities_[field], SteadyFlow::checked).carried(place, flow.step) - place; };
  const cv::Vec2d first = moved(flow.field);
  return flow.next_share == 0 ? first : first + flow.next_share * (moved(flow.next_field) - first);
}

}  // namespace stillwater
