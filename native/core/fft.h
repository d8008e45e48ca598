#pragma once

#include <complex>
#include <functional>
#include <memory>

/// Fourier transforms of real square tiles, through FFTW. Plans are made with FFTW_ESTIMATE under one mutex and
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

}  // namespace stillwater
