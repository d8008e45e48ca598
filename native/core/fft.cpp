#include "core/fft.h"

#include <fftw3.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <new>
#include <string>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

// One cache line more than a line needs: lines a power of two apart would share the same cache sets.
constexpr int padding = 8;

/// Columns that are turned together: a cache line of the rows.
constexpr int strip = 8;

struct Buffer {
  fftwf_complex* data;

  explicit Buffer(size_t count) : data(fftwf_alloc_complex(count)) {
    if (!data) throw std::bad_alloc();
  }
  ~Buffer() { fftwf_free(data); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
};

/// FFTW plans for one caller at a time.
std::mutex& planner() {
  static std::mutex mutex;
  return mutex;
}

/// The one plan of a size: a contiguous line, out of place.
fftwf_plan plan_for(int n) {
  static std::map<int, fftwf_plan> kept;
  const std::lock_guard lock(planner());
  const auto found = kept.find(n);
  if (found != kept.end()) return found->second;
  const Buffer from(n), to(n);
  const fftwf_plan plan = fftwf_plan_dft_1d(n, from.data, to.data, FFTW_BACKWARD, FFTW_ESTIMATE);
  if (!plan) throw NotConverged("no Fourier transform can be planned for this size");
  return kept.emplace(n, plan).first->second;
}

struct PlanePlans {
  fftwf_plan forward, inverse;
};

PlanePlans plane_plans(cv::Size size) {
  static std::map<std::pair<int, int>, PlanePlans> kept;
  const std::lock_guard lock(planner());
  const auto found = kept.find({size.width, size.height});
  if (found != kept.end()) return found->second;
  const size_t numbers = static_cast<size_t>(size.width / 2 + 1) * size.height;
  const Buffer plane(numbers), spectrum(numbers);
  float* reals = plane.data[0];
  const PlanePlans plans{fftwf_plan_dft_r2c_2d(size.height, size.width, reals, spectrum.data, FFTW_ESTIMATE),
                         fftwf_plan_dft_c2r_2d(size.height, size.width, spectrum.data, reals, FFTW_ESTIMATE)};
  if (!plans.forward || !plans.inverse) throw NotConverged("no Fourier transform can be planned for this size");
  return kept.emplace(std::pair(size.width, size.height), plans).first->second;
}

}  // namespace

struct InverseFft2::State {
  int n, stride;  // of the rows, complex numbers
  fftwf_plan plan;
  Buffer rows;

  explicit State(int size)
      : n(size), stride(size + padding), plan(plan_for(size)), rows(static_cast<size_t>(size) / 2 * (size + padding)) {}

  void turn(const fftwf_complex* columns, int first, int count);
  void finish(int pair, fftwf_complex* line);
};

/// X(y, kx), `count` transformed columns from `first` on, into the rows Z = X(y) + i X(y + 1) and, by the symmetry of
/// real rows, their other half.
void InverseFft2::State::turn(const fftwf_complex* columns, int first, int count) {
  for (int pair = 0; pair < n / 2; ++pair) {
    fftwf_complex* row = rows.data + static_cast<size_t>(pair) * stride;
    for (int j = 0; j < count; ++j) {
      const float* x = columns[static_cast<size_t>(j) * stride + 2 * pair];
      row[first + j][0] = x[0] - x[3];
      row[first + j][1] = x[1] + x[2];
    }
    for (int j = first == 0 ? 1 : 0; j < count; ++j) {
      const float* x = columns[static_cast<size_t>(j) * stride + 2 * pair];
      row[n - first - j][0] = x[0] + x[3];
      row[n - first - j][1] = x[2] - x[1];
    }
  }
}

/// Transforms a pair of rows and parts them.
void InverseFft2::State::finish(int pair, fftwf_complex* line) {
  fftwf_complex* row = rows.data + static_cast<size_t>(pair) * stride;
  fftwf_execute_dft(plan, row, line);
  float* upper = row[0];
  float* lower = upper + n;
  for (int x = 0; x < n; ++x) upper[x] = line[x][0];
  for (int x = 0; x < n; ++x) lower[x] = line[x][1];
}

InverseFft2::InverseFft2(int n) {
  check::in_range("resolution", n, 4, 4096);
  if (n % 2 != 0) throw BadInput("resolution: " + std::to_string(n) + " is not even");
  state_ = std::make_unique<State>(n);
}

InverseFft2::~InverseFft2() = default;
InverseFft2::InverseFft2(InverseFft2&&) noexcept = default;
InverseFft2& InverseFft2::operator=(InverseFft2&&) noexcept = default;

int InverseFft2::size() const { return state_->n; }

void InverseFft2::run(const Fill& fill) {
  const int n = state_->n, half = n / 2 + 1, stride = state_->stride;
  // The highest column stands alone and comes last: its mirror image is itself.
  parallel_rows(n / 2, 4 * strip, [&](int first, int last) {
    const Buffer column(n), columns(static_cast<size_t>(strip) * stride);
    for (int kx = first; kx < last; kx += strip) {
      const int count = std::min(strip, last - kx);
      for (int j = 0; j < count; ++j) {
        fill(kx + j, reinterpret_cast<std::complex<float>*>(column.data));
        fftwf_execute_dft(state_->plan, column.data, columns.data + static_cast<size_t>(j) * stride);
      }
      state_->turn(columns.data, kx, count);
    }
  });
  const Buffer column(n), highest(n);
  fill(half - 1, reinterpret_cast<std::complex<float>*>(column.data));
  fftwf_execute_dft(state_->plan, column.data, highest.data);
  state_->turn(highest.data, half - 1, 1);

  parallel_rows(n / 2, 32, [&](int first, int last) {
    const Buffer line(n);
    for (int pair = first; pair < last; ++pair) state_->finish(pair, line.data);
  });
}

const float* InverseFft2::tile_row(int y) const {
  return state_->rows.data[static_cast<size_t>(y / 2) * state_->stride] + static_cast<size_t>(y % 2) * state_->n;
}

void FftFree::operator()(void* memory) const { fftwf_free(memory); }

FftFloats fft_floats(size_t count) {
  FftFloats memory(fftwf_alloc_real(count));
  if (!memory) throw std::bad_alloc();
  return memory;
}

FftSpectrum fft_spectrum(size_t count) {
  FftSpectrum memory(reinterpret_cast<std::complex<float>*>(fftwf_alloc_complex(count)));
  if (!memory) throw std::bad_alloc();
  return memory;
}

bool fft_aligned(const float* memory) { return fftwf_alignment_of(const_cast<float*>(memory)) == 0; }

RealFft2::RealFft2(cv::Size size) : size_(size) {
  check::size("plane", size.width, size.height);
  const PlanePlans plans = plane_plans(size);
  forward_ = plans.forward;
  inverse_ = plans.inverse;
}

void RealFft2::forward(float* plane, std::complex<float>* spectrum) const {
  const auto plan = static_cast<fftwf_plan>(const_cast<void*>(forward_));
  fftwf_execute_dft_r2c(plan, plane, reinterpret_cast<fftwf_complex*>(spectrum));
}

void RealFft2::inverse(std::complex<float>* spectrum, float* plane) const {
  const auto plan = static_cast<fftwf_plan>(const_cast<void*>(inverse_));
  fftwf_execute_dft_c2r(plan, reinterpret_cast<fftwf_complex*>(spectrum), plane);
}

}  // namespace stillwater
