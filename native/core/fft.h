#pragma once

#include <complex>
#include <memory>

/// Fourier transforms of real square tiles, through FFTW. Plans are made with FFTW_ESTIMATE under one mutex and
/// kept for the life of the process; buffers come from FFTW, so that their alignment, and with it every byte of
/// the result, is the same in each run. A square is transformed as 1-D plans over a padded stride, about twice as
/// fast as FFTW's estimated 2-D plan.
namespace stillwater {

/// Half spectrum -> real tile (complex to real, unnormalised: a constant spectrum c at (0, 0) gives c everywhere).
/// n is even, 4 .. 4096. Not to be used by two threads at once.
class InverseFft2 {
 public:
  explicit InverseFft2(int n);
  ~InverseFft2();
  InverseFft2(InverseFft2&&) noexcept;
  InverseFft2& operator=(InverseFft2&&) noexcept;

  int size() const;

  /// Row ky (0 .. n-1; above n/2 it is ky - n), columns kx = 0 .. n/2. To be filled before run(), which destroys it.
  std::complex<float>* spectrum_row(int ky);

  /// The tile's row y after run(), n floats, x running.
  const float* tile_row(int y) const;

  void run();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stillwater
