#include "core/fft.h"

#include <fftw3.h>

#include <map>
#include <mutex>
#include <utility>

#include "core/check.h"
#include "core/error.h"

namespace stillwater {
namespace {

// One cache line more than a row needs: rows a power of two apart would share the same cache sets.
constexpr int padding = 8;

int complex_stride(int n) { return n / 2 + padding; }

struct Plans {
  fftwf_plan columns, rows;
};

Plans plans_for(int n, fftwf_complex* buffer) {
  static std::mutex mutex;
  static std::map<int, Plans> kept;
  const std::lock_guard lock(mutex);
  const auto found = kept.find(n);
  if (found != kept.end()) return found->second;
  const int half = n / 2 + 1, stride = complex_stride(n);
  const Plans plans{
      fftwf_plan_many_dft(1, &n, half, buffer, nullptr, stride, 1, buffer, nullptr, stride, 1, FFTW_BACKWARD,
                          FFTW_ESTIMATE),
      fftwf_plan_many_dft_c2r(1, &n, n, buffer, nullptr, 1, stride, reinterpret_cast<float*>(buffer), nullptr, 1,
                              2 * stride, FFTW_ESTIMATE)};
  if (!plans.columns || !plans.rows) throw NotConverged("no Fourier transform can be planned for this size");
  return kept.emplace(n, plans).first->second;
}

}  // namespace

struct InverseFft2::State {
  int n;
  fftwf_complex* buffer;
  Plans plans;

  explicit State(int size) : n(size), buffer(fftwf_alloc_complex(static_cast<size_t>(size) * complex_stride(size))) {
    if (!buffer) throw std::bad_alloc();
    plans = plans_for(n, buffer);
  }
  ~State() { fftwf_free(buffer); }
};

InverseFft2::InverseFft2(int n) {
  check::in_range("resolution", n, 4, 4096);
  if (n % 2 != 0) throw BadInput("resolution: " + std::to_string(n) + " is not even");
  state_ = std::make_unique<State>(n);
}

InverseFft2::~InverseFft2() = default;
InverseFft2::InverseFft2(InverseFft2&&) noexcept = default;
InverseFft2& InverseFft2::operator=(InverseFft2&&) noexcept = default;

int InverseFft2::size() const { return state_->n; }

std::complex<float>* InverseFft2::spectrum_row(int ky) {
  return reinterpret_cast<std::complex<float>*>(state_->buffer + static_cast<size_t>(ky) * complex_stride(state_->n));
}

const float* InverseFft2::tile_row(int y) const {
  return reinterpret_cast<const float*>(state_->buffer + static_cast<size_t>(y) * complex_stride(state_->n));
}

void InverseFft2::run() {
  fftwf_execute_dft(state_->plans.columns, state_->buffer, state_->buffer);
  fftwf_execute_dft_c2r(state_->plans.rows, state_->buffer, reinterpret_cast<float*>(state_->buffer));
}

}  // namespace stillwater
