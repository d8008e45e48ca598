#include "frame/flowing_plate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "frame/cross_fade.h"
#include "frame/flowing_layer.h"
#include "layers/extend_colours.h"

namespace stillwater {
namespace {

// Sigmas of the blurs, of the picture's width.
constexpr std::array<double, FlowingPlate::bands> sigmas{0.005, 0.016, 0.05};

// Likeness is kept for distances of 2^(i / 2) - 1 px.
constexpr int distances = 24;
// Every so many knots, along both axes, are compared for it.
constexpr int compared = 3;

float place_of_distance(float apart) { return 2 * std::log2(1 + apart); }

// As Source goes on beyond its sides.
float mirrored_inside(float at, int size) {
  const auto last = static_cast<float>(size - 1);
  if (at < -0.5f) at = -1 - at;
  if (at > last + 0.5f) at = 2 * last + 1 - at;
  return std::clamp(at, 0.0f, last);
}

float brightness(const cv::Vec4f& colour) { return colour[0] + colour[1] + colour[2]; }

}  // namespace

FlowingPlate::FlowingPlate(const Plate& plate, std::shared_ptr<const FlowPaths> paths, bool lively)
    : plate_(plate), paths_(std::move(paths)), lively_(lively) {
  if (paths_->still()) return;
  const Rgba texture = extend_colours(plate.source.pixels());
  texture_ = Source(texture);
  if (!lively) return;
  make_means(texture);
  measure_likeness();
}

std::unique_ptr<LayerMotion> FlowingPlate::at(const Flow& flow) const {
  return std::make_unique<FlowingLayer>(*this, plate_, paths_->taken(flow));
}

void FlowingPlate::make_means(const Rgba& texture) {
  for (int band = 0; band < bands; ++band) {
    const double sigma = std::max(1.0, sigmas[band] * plate_.picture_width * plate_.scale);
    const Rgba mean = CrossFade::mean_of(texture, sigma, false, false);
    means_[band] = {mean, static_cast<float>(mean.cols) / static_cast<float>(texture.cols),
                    static_cast<float>(mean.rows) / static_cast<float>(texture.rows)};
  }
}

cv::Vec4f FlowingPlate::Mean::at(float x, float y) const {
  const float column = mirrored_inside((x + 0.5f) * columns - 0.5f, pixels.cols);
  const float row = mirrored_inside((y + 0.5f) * rows - 0.5f, pixels.rows);
  const int left = static_cast<int>(column), top = static_cast<int>(row);
  const int right = std::min(left + 1, pixels.cols - 1), bottom = std::min(top + 1, pixels.rows - 1);
  const float across = column - static_cast<float>(left), down = row - static_cast<float>(top);
  const cv::Vec4f *upper = pixels[top], *lower = pixels[bottom];
  const cv::Vec4f above = upper[left] + across * (upper[right] - upper[left]);
  const cv::Vec4f below = lower[left] + across * (lower[right] - lower[left]);
  return above + down * (below - above);
}

// How much brighter the texture is than the next wider blur of it.
std::array<float, FlowingPlate::bands> FlowingPlate::bands_at(float x, float y) const {
  const auto column = static_cast<int>(std::lround(mirrored_inside(x, texture_.width())));
  const auto row = static_cast<int>(std::lround(mirrored_inside(y, texture_.height())));
  std::array<float, bands + 1> blurred{brightness(*texture_.at(column, row))};
  for (int band = 0; band < bands; ++band) blurred[band + 1] = brightness(means_[band].at(x, y));
  std::array<float, bands> beside{};
  for (int band = 0; band < bands; ++band) beside[band] = blurred[band] - blurred[band + 1];
  return beside;
}

// Correlation of each band with itself along the streamlines, 0 .. 1.
void FlowingPlate::measure_likeness() {
  struct Sums {
    double both = 0, here = 0, there = 0;
  };
  using ByDistance = std::array<std::array<Sums, distances>, bands>;
  const cv::Size knots = paths_->knots();
  const int rows = (knots.height + compared - 1) / compared;
  std::vector<ByDistance> found(rows);
  parallel_rows(rows, 1, [&](int first, int last) {
    for (int i = first; i < last; ++i)
      for (int column = 0; column < knots.width; column += compared) {
        const int row = compared * i;
        const auto x = static_cast<float>(column * Streamlines::apart), y = static_cast<float>(row * Streamlines::apart);
        const std::array<float, bands> here = bands_at(x, y);
        for (int field = 0; field < paths_->fields(); ++field)
          for (int k = 0; k < paths_->lines(field).stored(); ++k) {
            const cv::Vec2f moved = paths_->lines(field).stored_at(row, column, k);
            const float place = place_of_distance(std::hypot(moved[0], moved[1]));
            const auto bin = static_cast<int>(place + 0.5f);
            if (bin == 0 || bin >= distances) continue;
            const std::array<float, bands> there = bands_at(x + moved[0], y + moved[1]);
            for (int band = 0; band < bands; ++band) {
              Sums& sums = found[i][band][bin];
              sums.both += static_cast<double>(here[band]) * there[band];
              sums.here += static_cast<double>(here[band]) * here[band];
              sums.there += static_cast<double>(there[band]) * there[band];
            }
          }
      }
  });
  for (int band = 0; band < bands; ++band) {
    std::vector<float>& likeness = likeness_[band];
    likeness.assign(distances, 1);
    for (int bin = 1; bin < distances; ++bin) {
      Sums sums;
      for (const ByDistance& row : found) {
        sums.both += row[band][bin].both;
        sums.here += row[band][bin].here;
        sums.there += row[band][bin].there;
      }
      const double all = std::sqrt(sums.here * sums.there);
      likeness[bin] = all > 0 ? static_cast<float>(std::clamp(sums.both / all, 0.0, 1.0)) : likeness[bin - 1];
    }
  }
}

float FlowingPlate::likeness(int band, float apart) const {
  const float place = std::min(place_of_distance(apart), distances - 1.0f);
  const int left = std::min(static_cast<int>(place), distances - 2);
  const float *known = likeness_[band].data() + left;
  return known[0] + (place - static_cast<float>(left)) * (known[1] - known[0]);
}

}  // namespace stillwater
