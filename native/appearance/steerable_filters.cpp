#include "appearance/steerable_filters.h"

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>
#include <numbers>
#include <string>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {
namespace {

constexpr size_t kept_sizes = 8;

/// Row of a spectrum -> its frequency.
int frequency(int row, int rows) { return row <= rows / 2 ? row : row - rows; }

/// sqrt of a raised cosine in log2 r: 0 up to r = 1/2, 1 from r = 1 on.
double rising(double r) {
  if (r <= 0.5) return 0;
  return r >= 1 ? 1 : std::cos(std::numbers::pi / 2 * std::log2(r));
}

double falling(double r) {
  if (r >= 1) return 0;
  return r <= 0.5 ? 1 : std::sin(-std::numbers::pi / 2 * std::log2(r));
}

/// The squares of all orientations' cosines, times its square, add up to 1.
double angular_scale(int orientations) {
  double square = 1.0 / orientations;  // 2^(2n) n!^2 / (o (2n)!), n = o - 1
  for (int k = 1; k < orientations; ++k) square *= 4.0 * k * k / (2.0 * k * (2.0 * k - 1));
  return std::sqrt(square);
}

/// (-i)^n x
std::complex<float> turned(std::complex<float> x, int n) {
  switch (n % 4) {
    case 1: return {x.imag(), -x.real()};
    case 2: return -x;
    case 3: return {-x.imag(), x.real()};
  }
  return x;
}

/// (-i)^turns scale x weight
void weighed(const std::complex<float>* x, const float* weights, int turns, float scale, int count, std::complex<float>* to) {
  const float signed_scale = turns % 4 < 2 ? scale : -scale;
  if (turns % 2 == 0)
    for (int i = 0; i < count; ++i) {
      const float weight = weights[i] * signed_scale;
      to[i] = {x[i].real() * weight, x[i].imag() * weight};
    }
  else
    for (int i = 0; i < count; ++i) {
      const float weight = weights[i] * signed_scale;
      to[i] = {x[i].imag() * weight, x[i].real() * -weight};
    }
}

void add_weighed(const std::complex<float>* x, const float* weights, int count, std::complex<float>* to) {
  for (int i = 0; i < count; ++i) to[i] += x[i] * weights[i];
}

void check_parameters(cv::Size size, int scales, int orientations) {
  check::size("image", size.width, size.height);
  check::in_range("scales", scales, 1, 12);
  check::in_range("orientations", orientations, 1, 16);
  if (std::min(size.width, size.height) <= 1 << scales)
    throw BadInput("scales: " + std::to_string(scales) + " is not a number of halvings that leaves 2 pixels a side of " +
                   std::to_string(size.width) + " x " + std::to_string(size.height));
}

}  // namespace

std::shared_ptr<const SteerableFilters> SteerableFilters::of(cv::Size size, int scales, int orientations) {
  static std::mutex mutex;
  static std::list<std::shared_ptr<const SteerableFilters>> kept;
  check_parameters(size, scales, orientations);
  const std::lock_guard lock(mutex);
  const auto found = std::find_if(kept.begin(), kept.end(), [&](const auto& filters) {
    return filters->transform().size() == size && filters->scales_ == scales && filters->orientations_ == orientations;
  });
  if (found != kept.end()) {
    kept.splice(kept.begin(), kept, found);
  } else {
    kept.emplace_front(new SteerableFilters(size, scales, orientations));
    if (kept.size() > kept_sizes) kept.pop_back();
  }
  return kept.front();
}

SteerableFilters::SteerableFilters(cv::Size size, int scales, int orientations)
    : scales_(scales), orientations_(orientations) {
  for (int level = 0; level <= scales; ++level) {
    levels_.emplace_back(size);
    size = {(size.width + 1) / 2, (size.height + 1) / 2};
  }
  filters_.resize(bands());
  for (int band = 0; band < bands(); ++band) sample(band);
}

int SteerableFilters::level_of(int band) const {
  return band == 0 ? 0 : std::min(scales_, (band - 1) / orientations_);
}

void SteerableFilters::sample(int band) {
  const int level = level_of(band), orientation = (band - 1) % orientations_;
  const bool oriented = band > 0 && band + 1 < bands();
  const cv::Size picture = levels_.front().size(), own = size_of(band);
  const double scale = angular_scale(orientations_), angle = std::numbers::pi * orientation / orientations_;
  const double along_x = std::cos(angle), along_y = std::sin(angle);
  std::vector<float>& filter = filters_[band];
  filter.resize(transform_of(band).numbers());
  float* to = filter.data();
  for (int kx = 0; kx <= own.width / 2; ++kx)
    for (int row = 0; row < own.height; ++row) {
      const double x = 2.0 * kx / picture.width, y = 2.0 * frequency(row, own.height) / picture.height;
      const double r = std::hypot(x, y);
      double value = band == 0 ? rising(r) : 1;
      // Coarser than level s, the lowpasses before s are 1 wherever that of s is not 0.
      if (band > 0) value = falling(r * (1 << level));
      if (oriented && r > 0)
        value *= rising(r * (2 << level)) * scale * std::pow((x * along_x + y * along_y) / r, orientations_ - 1);
      else if (oriented)
        value = 0;
      *to++ = static_cast<float>(value);
    }
}

FftSpectrum SteerableFilters::spectrum_of(const float* picture, size_t stride) const {
  FftSpectrum spectrum = fft_spectrum(transform().numbers());
  const size_t height = transform().size().height;
  transform().forward(picture, stride, [&](const FftColumns& columns) {
    for (int j = 0; j < columns.count; ++j) std::copy_n(columns[j], height, &spectrum[(columns.first + j) * height]);
  });
  return spectrum;
}

void SteerableFilters::weigh(int band, const FftSpectrum& picture, const FftColumns& columns) const {
  const int rows = size_of(band).height, all_rows = transform().size().height;
  const int positive = rows / 2 + 1, negative = rows - positive;
  const int turns = band > 0 && band + 1 < bands() ? orientations_ - 1 : 0;
  const float scale = 1.0f / static_cast<float>(transform_of(band).pixels());
  for (int j = 0; j < columns.count; ++j) {
    const float* weights = filter(band, columns.first + j);
    const std::complex<float>* from = &picture[static_cast<size_t>(columns.first + j) * all_rows];
    weighed(from, weights, turns, scale, positive, columns[j]);
    weighed(from + (all_rows - negative), weights + positive, turns, scale, negative, columns[j] + positive);
  }
}

void SteerableFilters::analyse(int band, const FftSpectrum& picture, float* coefficients) const {
  transform_of(band).inverse([&](const FftColumns& columns) { weigh(band, picture, columns); }, coefficients,
                             size_of(band).width, RealFft2::Threads::one);
}

void SteerableFilters::analyse_quadrature(int band, const FftSpectrum& picture, float* coefficients) const {
  const cv::Size own = size_of(band), all = transform().size();
  const double angle = std::numbers::pi * ((band - 1) % orientations_) / orientations_;
  transform_of(band).inverse(
      [&](const FftColumns& columns) {
        weigh(band, picture, columns);
        for (int j = 0; j < columns.count; ++j)
          for (int row = 0; row < own.height; ++row) {
            const double along = std::cos(angle) * (columns.first + j) / all.width +
                                 std::sin(angle) * frequency(row, own.height) / all.height;
            columns[j][row] = turned(columns[j][row], along < 0 ? 3 : 1);
          }
      },
      coefficients, own.width, RealFft2::Threads::one);
}

void SteerableFilters::add(int band, const FftRows& rows, const FftColumns& picture) const {
  const RealFft2& own = transform_of(band);
  const int count = std::min(picture.count, own.columns() - picture.first);
  if (count <= 0) return;
  const FftSpectrum memory = fft_spectrum(RealFft2::most_columns * own.column_stride());
  const FftColumns columns{picture.first, count, memory.get(), own.column_stride()};
  own.down(rows, columns);
  const int all_rows = transform().size().height;
  const int positive = own.size().height / 2 + 1, negative = own.size().height - positive;
  for (int j = 0; j < count; ++j) {
    const float* weights = filter(band, picture.first + j);
    add_weighed(columns[j], weights, positive, picture[j]);
    add_weighed(columns[j] + positive, weights + positive, negative, picture[j] + (all_rows - negative));
  }
}

void SteerableFilters::synthesise(const std::vector<const FftRows*>& bands, const FftColumns& picture) const {
  const int rows = transform().size().height, lowpass = this->bands() - 1;
  const int back = 3 * (orientations_ - 1);  // i^n = (-i)^(3n)
  const float scale = 1.0f / static_cast<float>(transform().pixels());
  for (int j = 0; j < picture.count; ++j) std::fill_n(picture[j], rows, std::complex<float>(0));
  for (int band = 1; band < lowpass; ++band) add(band, *bands[band], picture);
  for (int j = 0; j < picture.count; ++j)
    for (int row = 0; row < rows; ++row) picture[j][row] = turned(picture[j][row], back);
  for (const int band : {0, lowpass}) add(band, *bands[band], picture);
  for (int j = 0; j < picture.count; ++j)
    for (int row = 0; row < rows; ++row) picture[j][row] *= scale;
}

void SteerableFilters::synthesise(const std::vector<const FftRows*>& bands, float* picture, size_t stride) const {
  transform().inverse([&](const FftColumns& columns) { synthesise(bands, columns); }, picture, stride);
}

}  // namespace stillwater
