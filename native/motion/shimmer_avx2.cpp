#include "motion/shimmer_avx2.h"

#include <immintrin.h>

namespace stillwater {

void shimmer_swing_avx2(const float* frequency, double loop, double time, const float* phase, float size, int count,
                        float* out) {
  shimmer_swing(frequency, loop, time, phase, size, count, out);
}

// Three nodes of a row stand side by side: (x, y, x, y, x, y) and two numbers that count nothing.
void shimmer_unmap_avx2(const ShimmerKernel* kernel, float* x, float* y, int count) {
  ShimmerPlaces places;
  shimmer_places(kernel, x, y, count, &places);
  // The weights of shimmer_weights() by powers of f.
  const __m256 constant = _mm256_setr_ps(0.125f, 0.125f, 0.75f, 0.75f, 0.125f, 0.125f, 0, 0);
  const __m256 linear = _mm256_setr_ps(-0.5f, -0.5f, 0, 0, 0.5f, 0.5f, 0, 0);
  const __m256 square = _mm256_setr_ps(0.5f, 0.5f, -1, -1, 0.5f, 0.5f, 0, 0);
  float swing[2 * shimmer_run];
  for (int p = 0; p < count; ++p) {
    const float* nodes = kernel->swing + places.first[p];
    __m256 sum = _mm256_mul_ps(_mm256_broadcast_ss(&places.down[0][p]), _mm256_loadu_ps(nodes));
    for (int j = 1; j < 3; ++j) {
      nodes += 2 * shimmer_stride;
      sum = _mm256_fmadd_ps(_mm256_broadcast_ss(&places.down[j][p]), _mm256_loadu_ps(nodes), sum);
    }
    const __m256 f = _mm256_broadcast_ss(&places.across[p]);
    sum = _mm256_mul_ps(sum, _mm256_fmadd_ps(_mm256_fmadd_ps(square, f, linear), f, constant));
    const __m128 half = _mm_add_ps(_mm256_castps256_ps128(sum), _mm256_extractf128_ps(sum, 1));
    _mm_storel_pi((__m64*)(swing + 2 * p), _mm_add_ps(half, _mm_movehl_ps(half, half)));
  }
  for (int p = 0; p < count; ++p) {
    x[p] += places.growth[p] * swing[2 * p];
    y[p] += places.growth[p] * swing[2 * p + 1];
  }
}

}  // namespace stillwater
