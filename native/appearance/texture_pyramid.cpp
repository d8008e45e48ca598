#include "appearance/texture_pyramid.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "appearance/laplacian_pyramid.h"
#include "appearance/steerable_filters.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

constexpr int channels = 3;

struct Axes {
  CellAxis x, y;
};

Samples samples_of(Plane& plane) { return {plane[0], plane.cols, plane.rows, plane.step1()}; }

/// The next side that transforms fast and can be halved three times.
int padded(int side) {
  for (int wanted = (side + std::min(TexturePyramid::margin, side) + 7) / 8 * 8;; wanted += 8) {
    int rest = wanted;
    for (const int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return wanted;
  }
}

/// Where a sample beyond the side comes from: mirrored at this end and at the other, and the share of the other.
struct Beyond {
  int here, there;
  float share;
};

std::vector<Beyond> beyond(int side, int all) {
  std::vector<Beyond> samples;
  for (int i = side; i < all; ++i) {
    const float t = (static_cast<float>(i - side) + 0.5f) / static_cast<float>(all - side);
    samples.push_back({std::max(0, 2 * side - 1 - i), std::min(side - 1, all - 1 - i), t * t * (3 - 2 * t)});
  }
  return samples;
}

class SteerableTexture final : public TexturePyramid {
 public:
  SteerableTexture(cv::Size frame, cv::Size grid, int scales, int orientations)
      : TexturePyramid(frame, grid),
        filters_(SteerableFilters::of({padded(frame.width), padded(frame.height)}, scales, orientations)),
        right_(beyond(frame.width, filters_->transform().size().width)),
        below_(beyond(frame.height, filters_->transform().size().height)) {
    const cv::Size all = filters_->transform().size();
    for (int band = 0; band < bands(); ++band) {
      const cv::Size own = filters_->size_of(band);
      axes_.push_back({CellAxis(frame.width, grid.width, own.width, static_cast<double>(all.width) / own.width),
                       CellAxis(frame.height, grid.height, own.height, static_cast<double>(all.height) / own.height)});
    }
    for (Plane& plane : padded_) plane.create(all);
    for (int i = 0; i < channels * bands(); ++i) values_.emplace_back(filters_->size_of(i / channels));
    rows_.resize(values_.size());
  }

  int bands() const override { return filters_->bands(); }
  int level_of(int band) const override { return filters_->level_of(band); }

  void change_bands(const Change& change) override {
    std::array<FftSpectrum, channels> pictures;
    for (int channel = 0; channel < channels; ++channel) {
      pad(planes[channel], padded_[channel][0]);
      pictures[channel] = filters_->spectrum_of(padded_[channel][0], padded_[channel].cols);
    }
    parallel_rows(channels * bands(), 1, [&](int i, int) {
      const int band = i / channels, channel = i % channels;
      const Samples samples = samples_of(values_[i]);
      filters_->analyse(band, pictures[channel], samples.data);
      change(channel, band, samples, axes_[band].x, axes_[band].y);
      rows_[i] = filters_->transform_of(band).along(samples.data, samples.stride);
    });
    collapse();
  }

 private:
  void pad(const Plane& plane, float* to) const {
    const cv::Size all = filters_->transform().size();
    for (int y = 0; y < plane.rows; ++y) {
      float* row = to + static_cast<size_t>(y) * all.width;
      std::copy_n(plane[y], plane.cols, row);
      for (size_t i = 0; i < right_.size(); ++i)
        row[plane.cols + i] = row[right_[i].here] + right_[i].share * (row[right_[i].there] - row[right_[i].here]);
    }
    for (size_t j = 0; j < below_.size(); ++j) {
      const float* here = to + static_cast<size_t>(below_[j].here) * all.width;
      const float* there = to + static_cast<size_t>(below_[j].there) * all.width;
      float* row = to + (plane.rows + j) * all.width;
      for (int x = 0; x < all.width; ++x) row[x] = here[x] + below_[j].share * (there[x] - here[x]);
    }
  }

  void collapse() {
    for (int channel = 0; channel < channels; ++channel) {
      std::vector<const FftRows*> bands;
      for (size_t band = channel; band < rows_.size(); band += channels) bands.push_back(&rows_[band]);
      filters_->synthesise(bands, padded_[channel][0], padded_[channel].cols);
      for (int y = 0; y < frame_.height; ++y) std::copy_n(padded_[channel][y], frame_.width, planes[channel][y]);
    }
  }

  std::shared_ptr<const SteerableFilters> filters_;
  std::vector<Beyond> right_, below_;
  std::vector<Axes> axes_;  // one a band
  std::array<Plane, channels> padded_;
  std::vector<Plane> values_;  // band by band, channels within
  std::vector<FftRows> rows_;  // of them
};

class LaplacianTexture final : public TexturePyramid {
 public:
  LaplacianTexture(cv::Size frame, cv::Size grid, int scales) : TexturePyramid(frame, grid), scales_(scales) {
    cv::Size own = frame;
    for (int band = 0; band < bands(); ++band) {
      axes_.push_back({CellAxis(frame.width, grid.width, own.width, 1 << band),
                       CellAxis(frame.height, grid.height, own.height, 1 << band)});
      own = {(own.width + 1) / 2, (own.height + 1) / 2};
    }
  }

  int bands() const override { return scales_ + 1; }
  int level_of(int band) const override { return band; }

  void change_bands(const Change& change) override {
    parallel_rows(channels, 1, [&](int channel, int) {
      std::vector<Plane> levels = laplacian_pyramid(planes[channel], scales_);
      for (int band = 0; band < bands(); ++band)
        change(channel, band, samples_of(levels[band]), axes_[band].x, axes_[band].y);
      planes[channel] = stillwater::collapse(levels);
    });
  }

 private:
  int scales_;
  std::vector<Axes> axes_;
};

}  // namespace

TexturePyramid::TexturePyramid(cv::Size frame, cv::Size grid) : frame_(frame), grid_(grid) {
  for (Plane& plane : planes) plane.create(frame);
}

std::unique_ptr<TexturePyramid> TexturePyramid::steerable(cv::Size frame, cv::Size grid, int scales, int orientations) {
  return std::make_unique<SteerableTexture>(frame, grid, scales, orientations);
}

std::unique_ptr<TexturePyramid> TexturePyramid::laplacian(cv::Size frame, cv::Size grid, int scales) {
  return std::make_unique<LaplacianTexture>(frame, grid, scales);
}

void TexturePyramid::weigh(const Plane& alpha) {
  weights_.assign(1, alpha);
  while (static_cast<int>(weights_.size()) <= level_of(bands() - 1)) {
    Plane half;
    cv::pyrDown(weights_.back(), half);
    weights_.push_back(half);
  }
}

void TexturePyramid::change_pixels(const Change& change) {
  const CellAxis x(frame_.width, grid_.width, frame_.width, 1), y(frame_.height, grid_.height, frame_.height, 1);
  parallel_rows(channels, 1, [&](int channel, int) { change(channel, 0, samples_of(planes[channel]), x, y); });
}

}  // namespace stillwater
