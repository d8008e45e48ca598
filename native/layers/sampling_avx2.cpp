#include "layers/sampling_avx2.h"

#include <immintrin.h>
#include <math.h>

#include "layers/sampling_kernel.h"

namespace {

// Two neighbours of a row side by side in one register: (left rgba, right rgba), times weights.
inline __m256 pair(const float* pixels, __m256 weights) { return _mm256_mul_ps(_mm256_loadu_ps(pixels), weights); }

inline __m256 add_pair(__m256 sum, const float* pixels, __m256 weights) {
  return _mm256_fmadd_ps(_mm256_loadu_ps(pixels), weights, sum);
}

inline __m256 both(const float* left, const float* right) {
  return _mm256_set_m128(_mm_broadcast_ss(right), _mm_broadcast_ss(left));
}

// The weights of places, and where the first neighbour of each lies in the image: SamplingWeights, with its offset made
// once. Whole eights are done.
struct PlacedWeights {
  float x[4][64], y[4][64];
  int offset[64];
};

inline __m256 linear(float slope, __m256 t, float start) {
  return _mm256_fmadd_ps(_mm256_set1_ps(slope), t, _mm256_set1_ps(start));
}

// Answers the places' whole parts.
inline __m256i eight_weights(__m256 at, int i, float (*weights)[64]) {
  const __m256 whole = _mm256_floor_ps(at), t = _mm256_sub_ps(at, whole), t2 = _mm256_mul_ps(t, t);
  const __m256 one = _mm256_set1_ps(1.0f), half = _mm256_set1_ps(0.5f);
  _mm256_storeu_ps(weights[0] + i, _mm256_fmsub_ps(t2, linear(-0.5f, t, 1.0f), _mm256_mul_ps(half, t)));
  _mm256_storeu_ps(weights[1] + i, _mm256_fmadd_ps(t2, linear(1.5f, t, -2.5f), one));
  _mm256_storeu_ps(weights[2] + i, _mm256_fmadd_ps(t2, linear(-1.5f, t, 2.0f), _mm256_mul_ps(half, t)));
  _mm256_storeu_ps(weights[3] + i, _mm256_mul_ps(t2, linear(0.5f, t, -0.5f)));
  return _mm256_cvttps_epi32(whole);
}

inline void place_weights(const float* x, const float* y, int count, int stride, PlacedWeights* w) {
  for (int i = 0; i < count; i += 8) {
    const __m256i column = eight_weights(_mm256_loadu_ps(x + i), i, w->x);
    const __m256i row = eight_weights(_mm256_loadu_ps(y + i), i, w->y);
    const __m256i line = _mm256_mullo_epi32(row, _mm256_set1_epi32(stride));
    _mm256_storeu_si256((__m256i*)(w->offset + i), _mm256_add_epi32(line, _mm256_slli_epi32(column, 2)));
  }
}

// settled() of sampling_kernel.h.
inline __m128 settled_coverage(__m128 colour) {
  const __m128 one = _mm_set1_ps(1.0f), beside = _mm_andnot_ps(_mm_set1_ps(-0.0f), _mm_sub_ps(colour, one));
  const __m128 near = _mm_cmple_ps(beside, _mm_setr_ps(-1, -1, -1, coverage_error));  // of the coverage alone
  return _mm_blendv_ps(colour, one, near);
}

inline float coverage_of(__m128 colour) { return ((stillwater_v4)colour)[3]; }

inline float smallest_of(__m256 numbers) {
  __m128 half = _mm_min_ps(_mm256_castps256_ps128(numbers), _mm256_extractf128_ps(numbers, 1));
  half = _mm_min_ps(half, _mm_movehl_ps(half, half));
  return _mm_cvtss_f32(_mm_min_ss(half, _mm_movehdup_ps(half)));
}

}  // namespace

void stillwater_sample_avx2(const float* origin, ptrdiff_t stride, const float* x, const float* y,
                            const unsigned char* needed, int count, float* out) {
  PlacedWeights w;
  place_weights(x, y, count, (int)stride, &w);
  const float* first_neighbour = origin - stride - 4;
  __m128 smallest = _mm_setzero_ps(), largest = smallest;
  for (int i = 0; i < count; ++i) {
    if (!needed[i]) continue;
    const float* pixel = first_neighbour + w.offset[i];
    ask_for_rows_below(pixel, stride);
    const __m256 first = both(&w.x[0][i], &w.x[1][i]), second = both(&w.x[2][i], &w.x[3][i]);
    // Down the columns first: the weights of the rows are those of all four.
    __m256 weight = _mm256_broadcast_ss(&w.y[0][i]);
    __m256 left = pair(pixel, weight), right = pair(pixel + 8, weight);
    for (int row = 1; row < 4; ++row) {
      pixel += stride;
      weight = _mm256_broadcast_ss(&w.y[row][i]);
      left = add_pair(left, pixel, weight);
      right = add_pair(right, pixel + 8, weight);
    }
    const __m256 sum = _mm256_fmadd_ps(left, first, _mm256_mul_ps(right, second));
    const __m128 colour = settled_coverage(_mm_add_ps(_mm256_castps256_ps128(sum), _mm256_extractf128_ps(sum, 1)));
    smallest = _mm_min_ps(smallest, colour);
    largest = _mm_max_ps(largest, colour);
    _mm_storeu_ps(out + 4 * i, colour);
  }
  if (is_coverage(coverage_of(smallest)) && is_coverage(coverage_of(largest))) return;
  for (int i = 0; i < count; ++i) {
    if (!needed[i]) continue;
    stillwater_v4u* colour = (stillwater_v4u*)(out + 4 * i);
    *colour = within_coverage(*colour);
  }
}

void stillwater_range_avx2(const float* at, int count, float* low, float* high) {
  // The last eight overlap those before; x - x is 0 for numbers only.
  __m256 here = _mm256_loadu_ps(at + count - 8);
  __m256 smallest = here, largest = here, nothing = _mm256_sub_ps(here, here);
  for (int i = 0; i + 8 < count; i += 8) {
    here = _mm256_loadu_ps(at + i);
    smallest = _mm256_min_ps(smallest, here);
    largest = _mm256_max_ps(largest, here);
    nothing = _mm256_add_ps(nothing, _mm256_sub_ps(here, here));
  }
  const __m256 numbers = _mm256_cmp_ps(nothing, nothing, _CMP_ORD_Q);
  const float no_number = _mm256_movemask_ps(numbers) == 0xff ? 0.0f : NAN;
  *low = smallest_of(smallest) + no_number;
  *high = -smallest_of(_mm256_sub_ps(_mm256_setzero_ps(), largest)) + no_number;
}
