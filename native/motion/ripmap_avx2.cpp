#include "motion/ripmap_avx2.h"

#include <immintrin.h>

#include "motion/ripmap_kernel.h"

namespace {

struct SplineTaps {
  __m256 before, here, after, last;
};

// Eight places within 5 coefficients, the first of them at first[1]: `from` counts from there.
inline SplineTaps taps_within_8(const float* first, __m256i from) {
  const __m256 window = _mm256_loadu_ps(first);
  const __m256i one = _mm256_set1_epi32(1), two = _mm256_set1_epi32(2), three = _mm256_set1_epi32(3);
  return {_mm256_permutevar8x32_ps(window, from), _mm256_permutevar8x32_ps(window, _mm256_add_epi32(from, one)),
          _mm256_permutevar8x32_ps(window, _mm256_add_epi32(from, two)),
          _mm256_permutevar8x32_ps(window, _mm256_add_epi32(from, three))};
}

inline SplineTaps taps_anywhere(const float* coefficients, __m256i whole) {
  return {_mm256_i32gather_ps(coefficients - 1, whole, 4), _mm256_i32gather_ps(coefficients, whole, 4),
          _mm256_i32gather_ps(coefficients + 1, whole, 4), _mm256_i32gather_ps(coefficients + 2, whole, 4)};
}

// The spline at a share f between the two inner coefficients.
inline __m256 spline_of(const SplineTaps& taps, __m256 f) {
  const __m256 one = _mm256_set1_ps(1), three = _mm256_set1_ps(3), four = _mm256_set1_ps(4);
  const __m256 g = _mm256_sub_ps(one, f), f2 = _mm256_mul_ps(f, f), g2 = _mm256_mul_ps(g, g);
  const __m256 here = _mm256_fnmadd_ps(_mm256_mul_ps(three, f2), _mm256_add_ps(one, g), four);
  const __m256 after = _mm256_fnmadd_ps(_mm256_mul_ps(three, g2), _mm256_add_ps(one, f), four);
  __m256 sum = _mm256_mul_ps(_mm256_mul_ps(g2, g), taps.before);
  sum = _mm256_fmadd_ps(here, taps.here, sum);
  sum = _mm256_fmadd_ps(after, taps.after, sum);
  sum = _mm256_fmadd_ps(_mm256_mul_ps(f2, f), taps.last, sum);
  return _mm256_mul_ps(sum, _mm256_set1_ps(1.0f / 6));
}

}  // namespace

void weighted_rows_avx2(const float* const* rows, const float* near, const float* far, int taps, int count,
                        float* sum) {
  for (int i = 0; i < count; i += 16) {
    __m256 near_low = _mm256_setzero_ps(), near_high = near_low, far_low = near_low, far_high = near_low;
    for (int t = 0; t < taps; ++t) {
      const float* row = rows[t] + i;
      const __m256 a = _mm256_broadcast_ss(near + t), b = _mm256_broadcast_ss(far + t);
      near_low = _mm256_fmadd_ps(a, _mm256_loadu_ps(row), near_low);
      far_low = _mm256_fmadd_ps(b, _mm256_loadu_ps(row + 1), far_low);
      near_high = _mm256_fmadd_ps(a, _mm256_loadu_ps(row + 8), near_high);
      far_high = _mm256_fmadd_ps(b, _mm256_loadu_ps(row + 9), far_high);
    }
    _mm256_storeu_ps(sum + i, _mm256_add_ps(near_low, far_low));
    _mm256_storeu_ps(sum + i + 8, _mm256_add_ps(near_high, far_high));
  }
}

void smoothed_line_avx2(const float* line, float side, int count, float* smooth) {
  smoothed_line(line, side, count, smooth);
}

void spline_at_avx2(const float* coefficients, float x, float step, float* values) {
  const __m256 lanes = _mm256_setr_ps(0, 1, 2, 3, 4, 5, 6, 7);
  const int close = step <= 0.5f;
  for (int i = 0; i < ripmap_block; i += 8) {
    const __m256 place = _mm256_fmadd_ps(_mm256_set1_ps(step), _mm256_add_ps(lanes, _mm256_set1_ps((float)i)),
                                         _mm256_set1_ps(x));
    const __m256i whole = _mm256_cvttps_epi32(place);
    const __m256 f = _mm256_sub_ps(place, _mm256_cvtepi32_ps(whole));
    SplineTaps taps;
    if (close) {
      const int first = _mm256_cvtsi256_si32(whole);
      taps = taps_within_8(coefficients + first - 1, _mm256_sub_epi32(whole, _mm256_set1_epi32(first)));
    } else {
      taps = taps_anywhere(coefficients, whole);
    }
    _mm256_storeu_ps(values + i, spline_of(taps, f));
  }
}
