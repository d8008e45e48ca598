#include "example/carried_residuals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"
#include "example/sample_differences.h"

namespace stillwater {
namespace {

constexpr int run = 64;
constexpr double turned_on = 0.381966;  // of the clip, from one turn to the next: no two turns begin near each other

int modulo(int a, int b) { return ((a % b) + b) % b; }

cv::Vec2f moved(const std::vector<Streamlines>& lines, const ExampleNow& now, double frames, int row, int column) {
  const cv::Vec2f first = lines[now.field].displaced(row, column, frames);
  if (now.next_share == 0) return first;
  return first + static_cast<float>(now.next_share) * (lines[now.next_field].displaced(row, column, frames) - first);
}

// Displacements of one row of pixels, between the knots of the streamlines.
class RowOfPlaces {
 public:
  RowOfPlaces(const std::vector<Streamlines>& lines, const ExampleNow& now, double frames, int row) {
    constexpr float spacing = 1.0f / Streamlines::apart;
    const cv::Size knots = lines.front().size();
    const int top = std::min(row / Streamlines::apart, std::max(0, knots.height - 2));
    const int bottom = std::min(top + 1, knots.height - 1);
    const float down = static_cast<float>(row) * spacing - static_cast<float>(top);
    knots_.resize(knots.width);
    for (int column = 0; column < knots.width; ++column) {
      const cv::Vec2f upper = moved(lines, now, frames, top, column), lower = moved(lines, now, frames, bottom, column);
      knots_[column] = upper + down * (lower - upper);
    }
  }

  cv::Vec2f at(int column) const {
    const int left = std::min(column / Streamlines::apart, std::max(0, static_cast<int>(knots_.size()) - 2));
    const int right = std::min(left + 1, static_cast<int>(knots_.size()) - 1);
    const float across = static_cast<float>(column - left * Streamlines::apart) / Streamlines::apart;
    return knots_[left] + across * (knots_[right] - knots_[left]);
  }

 private:
  std::vector<cv::Vec2f> knots_;
};

}  // namespace

int ResidualSequence::at(int step, int count) const {
  if (!endless) return step >= 0 && step < count ? step : -1;
  const int own = count - 1;
  if (own < 1) return -1;
  if (period == 0) return 1 + modulo(step, own);
  const int inside = modulo(step, period), turns = (period + own - 1) / own, turn = inside * turns / period;
  return 1 + modulo(inside + static_cast<int>(turn * turned_on * own), own);
}

void check_example(const ExampleNow& now, int fields) {
  check::finite("moment", now.moment);
  check::finite("step", now.step);
  check::in_range("field", now.field, 0, fields - 1);
  check::in_range("next_field", now.next_field, 0, fields - 1);
  check::in_range("next_share", now.next_share, 0, 1);
}

CarriedResiduals::CarriedResiduals(HalfFrames residuals, SourceMap map, const std::vector<Field>& velocities,
                                   const Parameters& parameters)
    : residuals_(residuals), map_(std::move(map)), parameters_(parameters) {
  check::in_range("life", parameters.life, 1, 1000, "frames");
  check::in_range("fade", parameters.fade, 0, 1);
  check::in_range("period", parameters.sequence.period, 0, 1e6, "frames");
  if (velocities.empty()) throw BadInput("velocities: none is not at least one");
  for (const Field& velocity : velocities) {
    if (velocity.size() != map_.size()) throw BadInput("velocity: not of the picture's size");
    lines_.emplace_back(velocity, std::max(1.0, static_cast<double>(parameters.life)));
  }
}

double CarriedResiduals::share(double age) const {
  if (age < 0) return std::max(0.0, 1 + age);
  const double life = parameters_.life, fading = std::max(1.0, parameters_.fade * life);
  const double left = std::clamp((life - age) / fading, 0.0, 1.0);
  return parameters_.fade > 0 ? left * left * (3 - 2 * left) : left;
}

Rgb CarriedResiduals::at(const ExampleNow& now) const {
  check_example(now, fields());
  Rgb sum(map_.size(), cv::Vec3f());
  const int newest = static_cast<int>(std::floor(now.moment)) + 1;
  for (int step = newest - parameters_.life; step <= newest; ++step) {
    const double age = now.moment - step, counts = share(age);
    const int residual = parameters_.sequence.at(step, residuals_.count());
    if (residual >= 0 && counts > 0) add(residual, age, static_cast<float>(counts), now, sum);
  }
  return sum;
}

void CarriedResiduals::add(int residual, double age, float share, const ExampleNow& now, Rgb& sum) const {
  const Source laid(map_.gather(residuals_.read(residual)), parameters_.beyond, parameters_.beyond);
  parallel_rows(sum.rows, 16, [&](int first, int last) {
    std::array<float, run> x, y;
    std::array<cv::Vec4f, run> colours;
    std::array<unsigned char, run> needed;
    needed.fill(1);
    for (int row = first; row < last; ++row) {
      const RowOfPlaces places(lines_, now, -age, row);
      for (int begin = 0; begin < sum.cols; begin += run) {
        const int count = std::min(run, sum.cols - begin);
        for (int i = 0; i < count; ++i) {
          const cv::Vec2f moved = places.at(begin + i);
          x[i] = static_cast<float>(begin + i) + moved[0];
          y[i] = static_cast<float>(row) + moved[1];
        }
        laid.sample(x.data(), y.data(), needed.data(), count, colours.data());
        cv::Vec3f* out = sum[row] + begin;
        for (int i = 0; i < count; ++i)
          out[i] += share * cv::Vec3f(colours[i][0], colours[i][1], colours[i][2]);
      }
    }
  });
}

}  // namespace stillwater
