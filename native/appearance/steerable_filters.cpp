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

/// Row of a spectrum -> its frequency, and back.
int frequency(int row, int rows) { return row <= rows / 2 ? row : row - rows; }
int row_of(int frequency, int rows) { return frequency >= 0 ? frequency : frequency + rows; }

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
  for (int row = 0; row < own.height; ++row)
    for (int kx = 0; kx <= own.width / 2; ++kx) {
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

void SteerableFilters::analyse(int band, const std::complex<float>* picture, std::complex<float>* spectrum) const {
  const RealFft2& own = transform_of(band);
  const int rows = own.size().height, columns = own.columns(), all_columns = transform().columns();
  const int turns = band == 0 || band + 1 == bands() ? 0 : orientations_ - 1;
  const float* filter = filters_[band].data();
  const float scale = 1.0f / static_cast<float>(own.pixels());
  const float sign = turns % 4 < 2 ? scale : -scale;
  for (int row = 0; row < rows; ++row, filter += columns, spectrum += columns) {
    const auto* from = picture + static_cast<size_t>(row_of(frequency(row, rows), transform().size().height)) * all_columns;
    if (turns % 2 == 0)
      for (int x = 0; x < columns; ++x) spectrum[x] = {from[x].real() * (filter[x] * sign), from[x].imag() * (filter[x] * sign)};
    else
      for (int x = 0; x < columns; ++x) spectrum[x] = {from[x].imag() * (filter[x] * sign), from[x].real() * -(filter[x] * sign)};
  }
}

void SteerableFilters::analyse_quadrature(int band, const std::complex<float>* picture,
                                          std::complex<float>* spectrum) const {
  analyse(band, picture, spectrum);
  const cv::Size own = size_of(band), all = transform().size();
  const double angle = std::numbers::pi * ((band - 1) % orientations_) / orientations_;
  for (int row = 0; row < own.height; ++row)
    for (int kx = 0; kx <= own.width / 2; ++kx, ++spectrum) {
      const double along = std::cos(angle) * kx / all.width + std::sin(angle) * frequency(row, own.height) / all.height;
      *spectrum = turned(*spectrum, along < 0 ? 3 : 1);
    }
}

void SteerableFilters::synthesise(const std::vector<const std::complex<float>*>& bands, int first, int last,
                                  std::complex<float>* picture) const {
  const int all_rows = transform().size().height, all_columns = transform().columns();
  const float scale = 1.0f / static_cast<float>(transform().pixels());
  for (int row = first; row < last; ++row) {
    std::complex<float>* to = picture + static_cast<size_t>(row) * all_columns;
    std::fill_n(to, all_columns, std::complex<float>(0));
    const int ky = frequency(row, all_rows);
    for (int band = 0; band < static_cast<int>(bands.size()); ++band) {
      const int rows = size_of(band).height, columns = transform_of(band).columns();
      const int own_row = row_of(ky, rows);
      if (own_row < 0 || own_row >= rows || frequency(own_row, rows) != ky) continue;
      const int turns = band == 0 || band + 1 == this->bands() ? 0 : orientations_ - 1;
      const std::complex<float>* from = bands[band] + static_cast<size_t>(own_row) * columns;
      const float* filter = filters_[band].data() + static_cast<size_t>(own_row) * columns;
      const float sign = turns % 4 < 2 ? scale : -scale;
      if (turns % 2 == 0)
        for (int x = 0; x < columns; ++x)
          to[x] += std::complex<float>(from[x].real() * (filter[x] * sign), from[x].imag() * (filter[x] * sign));
      else
        for (int x = 0; x < columns; ++x)
          to[x] += std::complex<float>(from[x].imag() * -(filter[x] * sign), from[x].real() * (filter[x] * sign));
    }
  }
}

}  // namespace stillwater
