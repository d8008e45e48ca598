#include "picture/colour_avx2.h"

#include <immintrin.h>

#include "picture/colour_kernel.h"

namespace {

// linear_of_srgb() of eight numbers, operation by operation.
inline __m256 linear_of_srgb_8(__m256 x) {
  const __m256 sign = _mm256_set1_ps(-0.0f), one = _mm256_set1_ps(1.0f);
  const __m256 size = _mm256_andnot_ps(sign, x);
  const __m256 y = _mm256_mul_ps(_mm256_add_ps(size, _mm256_set1_ps(0.055f)), _mm256_set1_ps(1.0f / 1.055f));
  const __m256 bits = _mm256_cvtepi32_ps(_mm256_castps_si256(y));
  const __m256 guess = _mm256_sub_ps(_mm256_set1_ps(1277900410.0f), _mm256_mul_ps(_mm256_set1_ps(0.2f), bits));
  __m256 z = _mm256_castsi256_ps(_mm256_cvttps_epi32(guess));
  for (int i = 0; i < 2; ++i) {
    const __m256 z2 = _mm256_mul_ps(z, z);
    const __m256 e = _mm256_sub_ps(one, _mm256_mul_ps(_mm256_mul_ps(_mm256_mul_ps(y, z), z2), z2));
    const __m256 series = _mm256_add_ps(_mm256_set1_ps(0.2f), _mm256_mul_ps(_mm256_set1_ps(0.12f), e));
    z = _mm256_add_ps(z, _mm256_mul_ps(_mm256_mul_ps(z, e), series));
  }
  const __m256 w = _mm256_mul_ps(y, z), curved = _mm256_mul_ps(_mm256_mul_ps(w, w), w);
  const __m256 straight = _mm256_mul_ps(size, _mm256_set1_ps(1.0f / 12.92f));
  const __m256 is_straight = _mm256_cmp_ps(size, _mm256_set1_ps(0.04045f), _CMP_LE_OQ);
  const __m256 is_number = _mm256_cmp_ps(size, _mm256_set1_ps(largest_float), _CMP_LE_OQ);
  const __m256 result = _mm256_blendv_ps(curved, straight, is_straight);
  return _mm256_or_ps(_mm256_blendv_ps(size, result, is_number), _mm256_and_ps(sign, x));
}

// straight_colour() without the division.
inline __m256 within_numbers(__m256 colour) {
  const __m256 most = _mm256_set1_ps(largest_float), least = _mm256_set1_ps(-largest_float);
  // min and max give their second argument where one is not a number: the pixel's own.
  return _mm256_max_ps(least, _mm256_min_ps(most, colour));
}

inline bool are_opaque(__m256 alphas) {
  return _mm256_movemask_ps(_mm256_cmp_ps(alphas, _mm256_set1_ps(1.0f), _CMP_NEQ_UQ)) == 0;
}

// The curve of display_to_screen(), of eight numbers. The polynomial is the curve's best within the range, by levels.
inline __m256 screen_of_srgb_8(__m256 x) {
  const __m256 low = _mm256_cmp_ps(x, _mm256_set1_ps(-0.04f), _CMP_GE_OQ);
  const __m256 high = _mm256_cmp_ps(x, _mm256_set1_ps(1.1f), _CMP_LE_OQ);
  if (_mm256_movemask_ps(_mm256_and_ps(low, high)) != 0xff) return linear_of_srgb_8(x);
  const float powers[] = {-0.27945355f, 0.64834636f, 0.52436937f, 0.0322596f, 0.00093061f};
  __m256 curved = _mm256_set1_ps(0.07341028f);
  for (int i = 0; i < 5; ++i) curved = _mm256_fmadd_ps(curved, x, _mm256_set1_ps(powers[i]));
  const __m256 straight = _mm256_mul_ps(x, _mm256_set1_ps(1.0f / 12.92f));
  return _mm256_blendv_ps(curved, straight, _mm256_cmp_ps(x, _mm256_set1_ps(0.04045f), _CMP_LE_OQ));
}

// Premultiplied pixels through a curve, two in a register.
template <__m256 (*curve)(__m256)>
inline __m256 two_pixels(__m256 pixels) {
  const __m256 one = _mm256_set1_ps(1.0f), alphas = _mm256_permute_ps(pixels, 0xff);
  const __m256 alpha = _mm256_blendv_ps(one, alphas, _mm256_cmp_ps(alphas, _mm256_setzero_ps(), _CMP_GT_OQ));
  const __m256 straight = within_numbers(_mm256_div_ps(pixels, alpha));
  return _mm256_blend_ps(_mm256_mul_ps(curve(straight), alpha), pixels, 0x88);
}

template <__m256 (*curve)(__m256)>
inline __m256 two_opaque_pixels(__m256 pixels) {
  return _mm256_blend_ps(curve(within_numbers(pixels)), pixels, 0x88);
}

// Answers how many pixels are done: a multiple of four.
template <__m256 (*curve)(__m256)>
inline size_t fours_of_pixels(const float* in, float* out, size_t pixels) {
  size_t i = 0;
  for (; i + 4 <= pixels; i += 4) {
    const __m256 first = _mm256_loadu_ps(in + 4 * i), second = _mm256_loadu_ps(in + 4 * i + 8);
    const bool opaque = are_opaque(_mm256_shuffle_ps(first, second, 0xff));
    _mm256_storeu_ps(out + 4 * i, opaque ? two_opaque_pixels<curve>(first) : two_pixels<curve>(first));
    _mm256_storeu_ps(out + 4 * i + 8, opaque ? two_opaque_pixels<curve>(second) : two_pixels<curve>(second));
  }
  return i;
}

}  // namespace

void srgb_to_linear_avx2(const float* in, float* out, size_t count) { srgb_to_linear_kernel(in, out, count); }

void linear_to_srgb_avx2(const float* in, float* out, size_t count) { linear_to_srgb_kernel(in, out, count); }

void display_to_scene_avx2(const float* rgba_in, float* rgba_out, size_t pixels) {
  const size_t i = fours_of_pixels<linear_of_srgb_8>(rgba_in, rgba_out, pixels);
  display_to_scene_kernel(rgba_in + 4 * i, rgba_out + 4 * i, pixels - i);
}

void display_to_screen_avx2(const float* rgba_in, float* rgba_out, size_t pixels) {
  const size_t i = fours_of_pixels<screen_of_srgb_8>(rgba_in, rgba_out, pixels);
  display_to_scene_kernel(rgba_in + 4 * i, rgba_out + 4 * i, pixels - i);
}

void scene_to_display_avx2(const float* rgba_in, float* rgba_out, size_t pixels) {
  scene_to_display_kernel(rgba_in, rgba_out, pixels);
}

void to_half_avx2(const float* in, uint16_t* out, size_t count) { to_half_kernel(in, out, count); }

void round_mantissa_avx2(const float* in, float* out, size_t count) { round_mantissa_kernel(in, out, count); }
