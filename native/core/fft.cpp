#include "core/fft.h"

#include <fftw3.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/error.h"
#include "core/parallel.h"

namespace stillwater {
namespace {

// One cache line more than a line needs: lines a power of two apart would share the same cache sets.
constexpr int padding = 8;

constexpr int strip = RealFft2::most_columns;
constexpr int tile_strip = 8;  // of InverseFft2: a cache line of the rows

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

/// The plan of a contiguous line, out of place.
fftwf_plan plan_for(int n, int direction) {
  static std::map<std::pair<int, int>, fftwf_plan> kept;
  const std::lock_guard lock(planner());
  const auto found = kept.find({n, direction});
  if (found != kept.end()) return found->second;
  const Buffer from(n), to(n);
  const fftwf_plan plan = fftwf_plan_dft_1d(n, from.data, to.data, direction, FFTW_ESTIMATE);
  if (!plan) throw NotConverged("no Fourier transform can be planned for this size");
  return kept.emplace(std::pair(n, direction), plan).first->second;
}

/// Numbers from one line to the next; lines stay aligned.
int stride_of(int n) { return (n + padding - 1) / padding * padding + padding; }

/// Two complex numbers, of two columns or of two rows.
using Two = float __attribute__((vector_size(16)));

Two two_at(const float* from) {
  Two x;
  std::memcpy(&x, from, sizeof x);
  return x;
}

void put(const Two& x, float* to) { std::memcpy(to, &x, sizeof x); }

/// Numbers 2 pair and 2 pair + 1 of two columns -> (both first ones), and both second ones times i, whose real part's sign is
/// left to the caller.
struct Turned {
  Two first, second;

  Turned(const Two& a, const Two& b)
      : first(__builtin_shufflevector(a, b, 0, 1, 4, 5)), second(__builtin_shufflevector(a, b, 3, 2, 7, 6)) {}
};

constexpr Two minus_real{-1, 1, -1, 1}, minus_imaginary{1, -1, 1, -1};

/// Columns and pairs of rows of one piece of work.
constexpr int column_grain = 2 * strip, row_grain = 32;

/// parallel_rows, or all in one piece.
void pieces(int rows, int grain, RealFft2::Threads threads, const std::function<void(int first, int last)>& work) {
  parallel_rows(rows, threads == RealFft2::Threads::one ? rows : grain, work);
}

std::complex<float>* complex_of(fftwf_complex* numbers) { return reinterpret_cast<std::complex<float>*>(numbers); }
fftwf_complex* fftw_of(std::complex<float>* numbers) { return reinterpret_cast<fftwf_complex*>(numbers); }

void transform(const void* plan, std::complex<float>* from, std::complex<float>* to) {
  fftwf_execute_dft(static_cast<fftwf_plan>(const_cast<void*>(plan)), fftw_of(from), fftw_of(to));
}

/// Memory that waits for its next use, the last given back first.
class Kept {
 public:
  std::complex<float>* take(size_t count) {
    const std::lock_guard lock(mutex_);
    for (auto one = idle_.rbegin(); one != idle_.rend(); ++one)
      if (one->second == count) {
        std::complex<float>* memory = one->first;
        idle_.erase(std::next(one).base());
        all_ -= count;
        return memory;
      }
    return nullptr;
  }

  void give_back(std::complex<float>* memory, size_t count) {
    const std::lock_guard lock(mutex_);
    idle_.emplace_back(memory, count);
    for (all_ += count; all_ > most; idle_.erase(idle_.begin())) {
      all_ -= idle_.front().second;
      fftwf_free(idle_.front().first);
    }
  }

  ~Kept() {
    for (const auto& one : idle_) fftwf_free(one.first);
  }

 private:
  static constexpr size_t most = (16 << 20) / sizeof(std::complex<float>);
  std::mutex mutex_;
  std::vector<std::pair<std::complex<float>*, size_t>> idle_;
  size_t all_ = 0;
};

Kept& kept_memory() {
  static Kept kept;
  return kept;
}

}  // namespace

FftRows::FftRows(cv::Size size)
    : width_(size.width), height_(size.height), stride_(stride_of(size.width)),
      lines_(fft_spectrum(static_cast<size_t>(pairs()) * stride_)) {}

/// X(y, kx), transformed columns, into Z = X(y) + i X(y + 1) and, by the symmetry of real rows, its other half. Of an odd
/// number of rows the last one's partner is 0.
void FftRows::turn_in(const FftColumns& columns) {
  const auto mirrored = [&](int kx) { return kx > 0 && 2 * kx < width_; };
  const float* data = reinterpret_cast<const float*>(columns.data);
  for (int pair = 0; pair < pairs(); ++pair) {
    float* row = reinterpret_cast<float*>(line(pair));
    const auto pair_of = [&](int j) { return data + 2 * (j * columns.stride + 2 * pair); };
    int j = 0;
    for (; j + 1 < columns.count && mirrored(columns.first + j + 1); j += 2) {
      const int kx = columns.first + j;
      const Turned x(two_at(pair_of(j)), two_at(pair_of(j + 1)));
      put(x.first + x.second * minus_real, row + 2 * kx);
      const Two other = x.first * minus_imaginary + x.second;
      float* to = row + 2 * (width_ - kx - 1);
      if (kx > 0) put(__builtin_shufflevector(other, other, 2, 3, 0, 1), to);
      else to[0] = other[2], to[1] = other[3];
    }
    for (; j < columns.count; ++j) {
      const int kx = columns.first + j;
      const float* x = pair_of(j);
      row[2 * kx] = x[0] - x[3];
      row[2 * kx + 1] = x[1] + x[2];
      if (!mirrored(kx)) continue;
      row[2 * (width_ - kx)] = x[0] + x[3];
      row[2 * (width_ - kx) + 1] = x[2] - x[1];
    }
  }
}

/// Z -> columns, to be transformed.
void FftRows::turn_out(const FftColumns& columns) const {
  float* data = reinterpret_cast<float*>(columns.data);
  for (int pair = 0; pair < pairs(); ++pair) {
    const float* row = reinterpret_cast<const float*>(line(pair));
    const auto pair_of = [&](int j) { return data + 2 * (j * columns.stride + 2 * pair); };
    int j = columns.first == 0 ? 1 : 0;
    if (j == 1) put(Two{row[0], 0, row[1], 0}, pair_of(0));
    for (; j + 1 < columns.count; j += 2) {
      const int kx = columns.first + j;
      const Two z = 0.5f * two_at(row + 2 * kx), reversed = 0.5f * two_at(row + 2 * (width_ - kx - 1));
      const Two other = __builtin_shufflevector(reversed, reversed, 2, 3, 0, 1) * minus_imaginary;
      const Two upper = z + other, turned = other - z;
      const Two lower = __builtin_shufflevector(turned, turned, 1, 0, 3, 2) * minus_real;
      put(__builtin_shufflevector(upper, lower, 0, 1, 4, 5), pair_of(j));
      put(__builtin_shufflevector(upper, lower, 2, 3, 6, 7), pair_of(j + 1));
    }
    for (; j < columns.count; ++j) {
      const int kx = columns.first + j;
      const float *z = row + 2 * kx, *other = row + 2 * (width_ - kx);
      put(Two{0.5f * (z[0] + other[0]), 0.5f * (z[1] - other[1]), 0.5f * (z[1] + other[1]), 0.5f * (other[0] - z[0])},
          pair_of(j));
    }
  }
}

struct InverseFft2::State {
  int n;
  fftwf_plan plan;
  FftRows rows;

  State(int size, FftRows lines) : n(size), plan(plan_for(size, FFTW_BACKWARD)), rows(std::move(lines)) {}
};

InverseFft2::InverseFft2(int n) {
  check::in_range("resolution", n, 4, 4096);
  if (n % 2 != 0) throw BadInput("resolution: " + std::to_string(n) + " is not even");
  state_ = std::make_unique<State>(n, FftRows({n, n}));
}

InverseFft2::~InverseFft2() = default;
InverseFft2::InverseFft2(InverseFft2&&) noexcept = default;
InverseFft2& InverseFft2::operator=(InverseFft2&&) noexcept = default;

int InverseFft2::size() const { return state_->n; }

void InverseFft2::run(const Fill& fill) {
  const int n = state_->n, half = n / 2 + 1, stride = state_->rows.stride_;
  const auto turn_in = [&](int first, int count, const Buffer& columns) {
    state_->rows.turn_in({first, count, complex_of(columns.data), static_cast<size_t>(stride)});
  };
  // The highest column stands alone and comes last: its mirror image is itself.
  parallel_rows(n / 2, 4 * tile_strip, [&](int first, int last) {
    const Buffer column(n), columns(static_cast<size_t>(tile_strip) * stride);
    for (int kx = first; kx < last; kx += tile_strip) {
      const int count = std::min(tile_strip, last - kx);
      for (int j = 0; j < count; ++j) {
        fill(kx + j, complex_of(column.data));
        fftwf_execute_dft(state_->plan, column.data, columns.data + static_cast<size_t>(j) * stride);
      }
      turn_in(kx, count, columns);
    }
  });
  const Buffer column(n), highest(n);
  fill(half - 1, complex_of(column.data));
  fftwf_execute_dft(state_->plan, column.data, highest.data);
  turn_in(half - 1, 1, highest);

  // Each pair of rows is transformed, and parted into the place of its line.
  parallel_rows(n / 2, 32, [&](int first, int last) {
    const Buffer line(n);
    for (int pair = first; pair < last; ++pair) {
      transform(state_->plan, state_->rows.line(pair), complex_of(line.data));
      float* upper = reinterpret_cast<float*>(state_->rows.line(pair));
      float* lower = upper + n;
      for (int x = 0; x < n; ++x) upper[x] = line.data[x][0];
      for (int x = 0; x < n; ++x) lower[x] = line.data[x][1];
    }
  });
}

const float* InverseFft2::tile_row(int y) const {
  return reinterpret_cast<const float*>(state_->rows.line(y / 2)) + static_cast<size_t>(y % 2) * state_->n;
}

void FftFree::operator()(std::complex<float>* memory) const { kept_memory().give_back(memory, count); }

FftSpectrum fft_spectrum(size_t count) {
  std::complex<float>* memory = kept_memory().take(count);
  if (!memory) memory = complex_of(fftwf_alloc_complex(count));
  if (!memory) throw std::bad_alloc();
  return {memory, FftFree{count}};
}

RealFft2::RealFft2(cv::Size size) : size_(size) {
  check::size("plane", size.width, size.height);
  along_forward_ = plan_for(size.width, FFTW_FORWARD);
  along_inverse_ = plan_for(size.width, FFTW_BACKWARD);
  down_forward_ = plan_for(size.height, FFTW_FORWARD);
  down_inverse_ = plan_for(size.height, FFTW_BACKWARD);
}

size_t RealFft2::column_stride() const { return stride_of(size_.height); }

void RealFft2::rows_forward(const float* plane, size_t stride, int first, int last, FftRows& rows) const {
  const Buffer line(size_.width);
  for (int pair = first; pair < last; ++pair) {
    const float* upper = plane + 2 * pair * stride;
    const float* lower = upper + stride;
    if (2 * pair + 1 < size_.height)
      for (int x = 0; x < size_.width; ++x) line.data[x][0] = upper[x], line.data[x][1] = lower[x];
    else
      for (int x = 0; x < size_.width; ++x) line.data[x][0] = upper[x], line.data[x][1] = 0;
    transform(along_forward_, complex_of(line.data), rows.line(pair));
  }
}

FftRows RealFft2::along(const float* plane, size_t stride) const {
  FftRows rows(size_);
  rows_forward(plane, stride, 0, rows.pairs(), rows);
  return rows;
}

void RealFft2::down(const FftRows& rows, const FftColumns& columns) const {
  const size_t stride = column_stride();
  const Buffer turned(strip * stride);
  const FftColumns lines{columns.first, columns.count, complex_of(turned.data), stride};
  rows.turn_out(lines);
  for (int j = 0; j < columns.count; ++j) transform(down_forward_, lines[j], columns[j]);
}

void RealFft2::forward(const float* plane, size_t stride, const Take& take, Threads threads) const {
  FftRows rows(size_);
  pieces(rows.pairs(), row_grain, threads, [&](int first, int last) { rows_forward(plane, stride, first, last, rows); });
  pieces(columns(), column_grain, threads, [&](int first, int last) {
    const Buffer transformed(strip * column_stride());
    for (int kx = first; kx < last; kx += strip) {
      const FftColumns some{kx, std::min(strip, last - kx), complex_of(transformed.data), column_stride()};
      down(rows, some);
      take(some);
    }
  });
}

void RealFft2::inverse(const Fill& fill, float* plane, size_t stride, Threads threads) const {
  const int width = size_.width, height = size_.height;
  FftRows rows(size_);
  pieces(columns(), column_grain, threads, [&](int first, int last) {
    const Buffer filled(strip * column_stride()), turned(strip * column_stride());
    for (int kx = first; kx < last; kx += strip) {
      const int count = std::min(strip, last - kx);
      const FftColumns given{kx, count, complex_of(filled.data), column_stride()};
      const FftColumns lines{kx, count, complex_of(turned.data), column_stride()};
      fill(given);
      for (int j = 0; j < count; ++j) {
        transform(down_inverse_, given[j], lines[j]);
        lines[j][height] = 0;
      }
      rows.turn_in(lines);
    }
  });
  pieces(rows.pairs(), row_grain, threads, [&](int first, int last) {
    const Buffer line(width);
    for (int pair = first; pair < last; ++pair) {
      transform(along_inverse_, rows.line(pair), complex_of(line.data));
      float* upper = plane + 2 * pair * stride;
      float* lower = upper + stride;
      for (int x = 0; x < width; ++x) upper[x] = line.data[x][0];
      if (2 * pair + 1 < height)
        for (int x = 0; x < width; ++x) lower[x] = line.data[x][1];
    }
  });
}

}  // namespace stillwater
