#include "frame/cross_fade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/parallel.h"
#include "frame/keep_variance.h"

namespace stillwater {
namespace {

// Sigma of the blur that leaves the large shapes, of the picture's width.
constexpr double mean_sigma = 0.02;
// The mean's pixels are so large that this is its sigma: what Catmull-Rom makes of them is as smooth as the blur.
constexpr double coarse_sigma = 4;
constexpr double blur_radius = 4;  // sigmas

// Every so many pixels, along both axes, are compared for the likeness.
constexpr int compared = 4;

// Blurred; endless sides go on at the other end, others with their last pixel.
Rgba blurred(const Rgba& image, double sigma, bool endless_x, bool endless_y) {
  const int radius = static_cast<int>(std::ceil(blur_radius * sigma));
  Rgba wide, all;
  cv::copyMakeBorder(image, wide, 0, 0, radius, radius, endless_x ? cv::BORDER_WRAP : cv::BORDER_REPLICATE);
  cv::copyMakeBorder(wide, all, radius, radius, 0, 0, endless_y ? cv::BORDER_WRAP : cv::BORDER_REPLICATE);
  cv::GaussianBlur(all, all, cv::Size(2 * radius + 1, 2 * radius + 1), sigma, sigma);
  return Rgba(all(cv::Rect(radius, radius, image.cols, image.rows)));
}

int around(int at, int size) { return (at % size + size) % size; }

}  // namespace

/// The two copies of one moment.
class CrossFadedLayer final : public TravellingLayer {
 public:
  CrossFadedLayer(const CrossFade& fade, const Plate& plate, const Placement& now, const Travel& travel)
      : TravellingLayer(plate, travel),
        fade_(fade),
        copies_(now),
        gain_(contrast_gain()),
        bounds_(bounds(now.first.get()) | bounds(now.second.get())) {}

  bool at_rest() const override { return false; }

  cv::Rect covered(const cv::Rect& tile) const override { return tile & bounds_; }

  const cv::Vec4f* draw(const Run& run, const unsigned char* needed, cv::Vec4f* out) const override {
    Colours second, first_mean, second_mean;
    const bool any_first = sample(copies_.first.get(), run, needed, out, first_mean.data());
    const bool any_second = sample(copies_.second.get(), run, needed, second.data(), second_mean.data());
    if (!any_first && !any_second) return nullptr;
    const auto other = static_cast<float>(copies_.second_share);
    const float one = 1 - other;
    for (int i = 0; i < run.count; ++i)
      if (needed[i]) out[i] = lively(one * out[i] + other * second[i], one * first_mean[i] + other * second_mean[i]);
    return out;
  }

 private:
  using Colours = std::array<cv::Vec4f, Run::longest>;

  // One copy and its mean; false where the copy is transparent.
  bool sample(const Displacement* displacement, const Run& run, const unsigned char* needed, cv::Vec4f* colours,
              cv::Vec4f* means) const {
    SampledRun at(plate_, displacement, run);
    SampledRun coarse = at;
    fade_.sample_mean(coarse.x, coarse.y, needed, run.count, means);
    if (plate_.source.sample(at.x, at.y, needed, run.count, colours)) return true;
    std::fill_n(colours, run.count, cv::Vec4f());
    return false;
  }

  // Straight colours are what differs from the mean; coverage dissolves.
  cv::Vec4f lively(const cv::Vec4f& plain, const cv::Vec4f& mean) const {
    if (plain[3] <= 0 || mean[3] <= 0) return plain;
    const cv::Vec4f expected = mean * (plain[3] / mean[3]);
    const cv::Vec4f colour = with_gain(plain, expected, gain_);
    return {colour[0], colour[1], colour[2], plain[3]};
  }

  // What differences from the mean are multiplied by, so that two copies, mixed, vary as much as one.
  float contrast_gain() const {
    const Point &first = copies_.drifted, &second = copies_.second_drifted;
    const cv::Point apart(static_cast<int>(std::lround((second.x - first.x) * plate_.scale)),
                          static_cast<int>(std::lround((second.y - first.y) * plate_.scale)));
    return static_cast<float>(variance_gain(copies_.second_share, fade_.likeness(plate_, apart)));
  }

  const CrossFade& fade_;
  Placement copies_;
  float gain_;
  cv::Rect bounds_;
};

double CrossFade::mean_sigma_of(int picture_width, double scale) {
  return std::max(1.0, mean_sigma * picture_width * scale);
}

Rgba CrossFade::mean_of(const Rgba& pixels, double sigma, bool endless_x, bool endless_y) {
  if (pixels.empty()) return {};
  const double coarser = std::max(1.0, sigma / coarse_sigma);
  const cv::Size size(std::max(1, static_cast<int>(std::lround(pixels.cols / coarser))),
                      std::max(1, static_cast<int>(std::lround(pixels.rows / coarser))));
  Rgba small;
  cv::resize(pixels, small, size, 0, 0, cv::INTER_AREA);
  return blurred(small, sigma / coarser, endless_x, endless_y);
}

CrossFade::CrossFade(const Plate& plate, const Rgba& mean) {
  if (plate.source.empty()) return;
  mean_ = Source(mean, plate.source.across(), plate.source.down());
  columns_ = static_cast<float>(mean.cols) / static_cast<float>(plate.source.width());
  rows_ = static_cast<float>(mean.rows) / static_cast<float>(plate.source.height());
}

// Places in the plate's index coordinates.
void CrossFade::sample_mean(float* x, float* y, const unsigned char* needed, int count, cv::Vec4f* out) const {
  for (int i = 0; i < count; ++i) {
    x[i] = (x[i] + 0.5f) * columns_ - 0.5f;
    y[i] = (y[i] + 0.5f) * rows_ - 0.5f;
  }
  if (!mean_.sample(x, y, needed, count, out)) std::fill_n(out, count, cv::Vec4f());
}

// How much brighter each pixel of a row is than the mean.
std::vector<float> CrossFade::beside_mean(const Plate& plate, int row) const {
  std::vector<float> beside(plate.source.width());
  std::array<float, Run::longest> x, y;
  std::array<unsigned char, Run::longest> needed;
  std::array<cv::Vec4f, Run::longest> means;
  needed.fill(1);
  for (int first = 0; first < plate.source.width(); first += Run::longest) {
    const int count = std::min(Run::longest, plate.source.width() - first);
    std::iota(x.begin(), x.end(), static_cast<float>(first));
    y.fill(static_cast<float>(row));
    sample_mean(x.data(), y.data(), needed.data(), count, means.data());
    for (int i = 0; i < count; ++i) {
      const cv::Vec4f &colour = *plate.source.at(first + i, row), &mean = means[i];
      if (colour[3] <= 0 || mean[3] <= 0) continue;
      const float share = colour[3] / mean[3];
      beside[first + i] = (colour[0] + colour[1] + colour[2]) - share * (mean[0] + mean[1] + mean[2]);
    }
  }
  return beside;
}

// Correlation of the differences from the mean, 0 .. 1.
double CrossFade::measured_likeness(const Plate& plate, cv::Point apart) const {
  const int width = plate.source.width(), height = plate.source.height(), rows = (height + compared - 1) / compared;
  std::vector<double> both(rows), square(rows);
  parallel_rows(rows, 8, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const std::vector<float> here = beside_mean(plate, compared * i);
      const std::vector<float> there = beside_mean(plate, around(compared * i + apart.y, height));
      for (int x = 0; x < width; x += compared) {
        both[i] += static_cast<double>(here[x]) * there[around(x + apart.x, width)];
        square[i] += static_cast<double>(here[x]) * here[x];
      }
    }
  });
  const double all = std::accumulate(square.begin(), square.end(), 0.0);
  return all > 0 ? std::clamp(std::accumulate(both.begin(), both.end(), 0.0) / all, 0.0, 1.0) : 0.0;
}

double CrossFade::likeness(const Plate& plate, cv::Point apart) const {
  const std::lock_guard lock(mutex_);
  const std::pair key(apart.x, apart.y);
  const auto known = likeness_.find(key);
  return known != likeness_.end() ? known->second : likeness_[key] = measured_likeness(plate, apart);
}

std::unique_ptr<LayerMotion> CrossFade::at(const Plate& plate, const Placement& now, const Travel& travel) const {
  return std::make_unique<CrossFadedLayer>(*this, plate, now, travel);
}

}  // namespace stillwater
