#include "layers/sampling_avx2.h"

#include <immintrin.h>

#include "layers/sampling_kernel.h"

namespace {

// Two neighbours of a row side by side in one register: (left rgba, right rgba) times (left weight, right weight).
inline __m256 pair(const float* pixels, __m256 weights) { return _mm256_mul_ps(_mm256_loadu_ps(pixels), weights); }

inline __m256 add_pair(__m256 sum, const float* pixels, __m256 weights) {
  return _mm256_fmadd_ps(_mm256_loadu_ps(pixels), weights, sum);
}

inline __m256 both(const float* left, const float* right) {
  return _mm256_set_m128(_mm_broadcast_ss(right), _mm_broadcast_ss(left));
}

}  // namespace

void stillwater_sample_avx2(const float* origin, ptrdiff_t stride, const float* x, const float* y,
                            const unsigned char* needed, int count, float* out) {
  SamplingWeights w;
  catmull_rom_weights(x, count, w.column, w.x);
  catmull_rom_weights(y, count, w.row, w.y);
  for (int i = 0; i < count; ++i) {
    if (!needed[i]) continue;
    const float* pixel = origin + (ptrdiff_t)(w.row[i] - 1) * stride + (ptrdiff_t)(w.column[i] - 1) * 4;
    ask_for_rows_below(pixel, stride);
    const __m256 first = both(&w.x[0][i], &w.x[1][i]), second = both(&w.x[2][i], &w.x[3][i]);
    __m256 sum = _mm256_mul_ps(_mm256_broadcast_ss(&w.y[0][i]), add_pair(pair(pixel, first), pixel + 8, second));
    for (int row = 1; row < 4; ++row) {
      pixel += stride;
      sum = _mm256_fmadd_ps(_mm256_broadcast_ss(&w.y[row][i]), add_pair(pair(pixel, first), pixel + 8, second), sum);
    }
    const __m128 colour = _mm_add_ps(_mm256_castps256_ps128(sum), _mm256_extractf128_ps(sum, 1));
    _mm_storeu_ps(out + 4 * i, (__m128)within_coverage((stillwater_v4)colour));
  }
}
