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
/// real rows a and b are transformed as one complex row, a + ib.
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

/// Memory aligned as FFTW wants it, so that the same plan, and the same bytes, serve every call.
struct FftFree {
  void operator()(void* memory) const;
};
using FftFloats = std::unique_ptr<float[], FftFree>;
using FftSpectrum = std::unique_ptr<std::complex<float>[], FftFree>;
FftFloats fft_floats(size_t count);
FftSpectrum fft_spectrum(size_t count);
bool fft_aligned(const float* memory);  ///< as memory of fft_floats

/// Real plane <-> half spectrum, any size, neither way normalised: there and back multiplies by the number of pixels.
/// A spectrum has `height` rows of width / 2 + 1 numbers, kx running from 0; row ky above height / 2 is ky - height.
/// One object may serve several threads at once, each with its own memory: aligned.
class RealFft2 {
 public:
  /// Sides 1 .. largest_side. Throws BadInput.
  explicit RealFft2(cv::Size size);

  cv::Size size() const { return size_; }
  int columns() const { return size_.width / 2 + 1; }
  size_t pixels() const { return static_cast<size_t>(size_.width) * size_.height; }
  size_t numbers() const { return static_cast<size_t>(columns()) * size_.height; }

  /// `plane` stays as it is.
  void forward(float* plane, std::complex<float>* spectrum) const;

  /// `spectrum` is lost.
  void inverse(std::complex<float>* spectrum, float* plane) const;

 private:
  cv::Size size_;
  const void *forward_, *inverse_;  // FFTW's plans
};

}  // namespace stillwater
