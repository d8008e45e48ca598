#pragma once

#include <complex>
#include <functional>
#include <memory>
#include <opencv2/core/types.hpp>

/// Fourier transforms of real planes, through FFTW. Plans are made with FFTW_ESTIMATE under one mutex and
/// kept for the life of the process; buffers come from FFTW, so that their alignment, and with it every byte of
/// the result, is the same in each run.
///
///     spectrum, column by column --fill, transform down--> 8 columns --turned, two rows as one complex--> n/2 rows
///     --transform along--> real rows
///
/// FFTW's estimated plans are good at one thing, complex lines that are contiguous: so everything is made of those. Two
/// real rows a and b are transformed as one complex row, a + ib. The other way the same steps run backwards.
namespace stillwater {

/// Half spectrum -> real tile (complex to real, unnormalised: a constant spectrum c at (0, 0) gives c everywhere).
/// n is even, 4 .. 4096. Not to be used by two threads at once; run() itself uses several.
class InverseFft2 {
 public:
  explicit InverseFft2(int n);
  ~InverseFft2();
  InverseFft2(InverseFft2&&) noexcept;
  InverseFft2& operator=(InverseFft2&&) noexcept;

  int size() const;

  /// `fill(kx, column)` gives the column kx (0 .. n/2) of the spectrum, n numbers, ky running (above n/2 it is ky - n);
  /// it is called by several threads. The spectrum is that of a real tile: H(0, -ky) = conj H(0, ky), the same at n/2.
  using Fill = std::function<void(int kx, std::complex<float>* column)>;
  void run(const Fill& fill);

  /// The tile's row y after run(), n floats, x running.
  const float* tile_row(int y) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Memory aligned as FFTW wants it, so that the same plan, and the same bytes, serve every call. What is given back is kept for
/// the next one (16 MB at most): fresh pages cost as much as the transform.
struct FftFree {
  size_t count = 0;
  void operator()(std::complex<float>* memory) const;
};
using FftSpectrum = std::unique_ptr<std::complex<float>[], FftFree>;
FftSpectrum fft_spectrum(size_t count);

/// Columns of a spectrum: `count` of them from kx = `first` on, `stride` numbers apart.
struct FftColumns {
  int first, count;
  std::complex<float>* data;
  size_t stride;

  std::complex<float>* operator[](int i) const { return data + i * stride; }
};

/// A plane half way: its rows are transformed, in pairs as one complex line, its columns are not.
class FftRows {
 public:
  FftRows() = default;

 private:
  friend class RealFft2;
  friend class InverseFft2;
  explicit FftRows(cv::Size size);
  int pairs() const { return (height_ + 1) / 2; }
  std::complex<float>* line(int pair) const { return lines_.get() + pair * static_cast<size_t>(stride_); }
  void turn_in(const FftColumns& columns);
  void turn_out(const FftColumns& columns) const;

  int width_ = 0, height_ = 0, stride_ = 0;
  FftSpectrum lines_;
};

/// Real plane <-> half spectrum, any size, neither way normalised: there and back multiplies by the number of pixels.
/// A spectrum has width / 2 + 1 columns of `height` numbers, kx running from 0; number ky above height / 2 is ky - height.
/// It comes and goes a few columns at a time, so that what is done to them is done while they are near.
/// One object may serve several threads at once.
class RealFft2 {
 public:
  /// Sides 1 .. largest_side. Throws BadInput.
  explicit RealFft2(cv::Size size);

  cv::Size size() const { return size_; }
  int columns() const { return size_.width / 2 + 1; }
  size_t pixels() const { return static_cast<size_t>(size_.width) * size_.height; }
  size_t numbers() const { return static_cast<size_t>(columns()) * size_.height; }

  /// Together they take each column once; called by several threads, each with its own columns.
  using Take = std::function<void(const FftColumns& columns)>;

  /// Who calls may be one of several threads already.
  enum class Threads { one, several };

  /// `stride`: numbers from one row to the next.
  void forward(const float* plane, size_t stride, const Take& take, Threads threads = Threads::several) const;

  /// Its two steps, for one thread: the rows, then any of the columns, up to most_columns at a time.
  FftRows along(const float* plane, size_t stride) const;
  void down(const FftRows& rows, const FftColumns& columns) const;
  static constexpr int most_columns = 16;  ///< two cache lines of the rows
  size_t column_stride() const;           ///< that suits FFTW and the cache

  /// `fill` is to write the columns that it is given of the spectrum of a real plane: H(0, -ky) = conj H(0, ky), the same at
  /// width / 2.
  using Fill = std::function<void(const FftColumns& columns)>;
  void inverse(const Fill& fill, float* plane, size_t stride, Threads threads = Threads::several) const;

 private:
  void rows_forward(const float* plane, size_t stride, int first, int last, FftRows& rows) const;

  cv::Size size_;
  const void *along_forward_, *along_inverse_, *down_forward_, *down_inverse_;  // FFTW's plans of a row and a column
};

}  // namespace stillwater
