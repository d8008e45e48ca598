#pragma once

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined(__F16C__)
#include <immintrin.h>
#endif

// The loops behind colour.h in plain C, for the compiler to vectorise: included by colour.cpp and, once more with
// wider registers, by colour_avx2.cpp. Everything is static, so that neither copy can stand in for the other.

static const float largest_float = 3.402823466e+38f;

static inline uint32_t bits_of(float x) {
  uint32_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}

static inline float float_of(uint32_t bits) {
  float x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

// x^(-1/n) within a tenth, x > 0: the exponent divided by hand, in the number's bits.
static inline float inverse_root_guess(float x, float one_over_n, float offset) {
  return float_of((uint32_t)(int32_t)(offset - one_over_n * (float)(int32_t)bits_of(x)));
}

// Both roots: z <- z (1 - e)^(-1/n) with e = 1 - x z^n, the binomial series to e^2, twice.
static inline float inverse_fifth_root(float x) {
  float z = inverse_root_guess(x, 0.2f, 1277900410.0f);
  for (int i = 0; i < 2; ++i) {
    const float z2 = z * z;
    const float e = 1.0f - (x * z) * z2 * z2;
    z = z + z * e * (0.2f + 0.12f * e);
  }
  return z;
}

static inline float cube_root(float x) {
  float z = inverse_root_guess(x, 0.33333333f, 1419900529.0f);
  for (int i = 0; i < 2; ++i) {
    const float e = 1.0f - (x * z) * (z * z);
    z = z + z * e * (0.33333333f + 0.22222222f * e);
  }
  return (x * z) * z;
}

// ((x + 0.055) / 1.055)^2.4 = (y y^(-1/5))^3 above the straight piece.
static inline float linear_of_srgb(float x) {
  const float size = fabsf(x);
  const float y = (size + 0.055f) * (1.0f / 1.055f);
  const float w = y * inverse_fifth_root(y);
  const float curved = w * w * w;
  const float straight = size * (1.0f / 12.92f);
  const float result = size <= 0.04045f ? straight : curved;
  return copysignf(size <= largest_float ? result : size, x);
}

// x^(1/2.4) = x^(1/3) x^(1/12).
static inline float srgb_of_linear(float x) {
  const float size = fabsf(x);
  const float root = cube_root(size);
  const float curved = 1.055f * (root * sqrtf(sqrtf(root))) - 0.055f;
  const float straight = size * 12.92f;
  const float result = size <= 0.0031308f ? straight : curved;
  return copysignf(size <= largest_float ? result : size, x);
}

static void srgb_to_linear_kernel(const float* in, float* out, size_t count) {
  for (size_t i = 0; i < count; ++i) out[i] = linear_of_srgb(in[i]);
}

static void linear_to_srgb_kernel(const float* in, float* out, size_t count) {
  for (size_t i = 0; i < count; ++i) out[i] = srgb_of_linear(in[i]);
}

enum { block = 64 };  // pixels taken at a time

static inline float straight_colour(float colour, float alpha) {
  const float straight = colour / alpha;  // of tiny alphas: no further than the largest number
  return straight > largest_float ? largest_float : (straight < -largest_float ? -largest_float : straight);
}

// Whether a block's pixels have an alpha of 1: then straight and premultiplied colours are the same.
static inline int all_opaque(const float* rgba, size_t pixels) {
  uint32_t others = 0;
  for (size_t i = 0; i < pixels; ++i) others |= bits_of(rgba[4 * i + 3]) ^ 0x3f800000u;
  return others == 0;
}

// The curve is taken of all four numbers of a pixel, which costs less than to take the colours apart; then the alpha is
// put back.
#define STILLWATER_PIXELS_KERNEL(name, curve)                                                                \
  static void name(const float* rgba_in, float* rgba_out, size_t pixels) {                                   \
    float colour[4 * block], alpha[4 * block];                                                               \
    for (size_t done = 0; done < pixels; done += block) {                                                    \
      const size_t n = pixels - done < block ? pixels - done : (size_t)block;                                \
      const float* in = rgba_in + 4 * done;                                                                  \
      float* out = rgba_out + 4 * done;                                                                      \
      memcpy(colour, in, 4 * n * sizeof *in);                                                                \
      if (all_opaque(in, n)) {                                                                               \
        for (size_t i = 0; i < 4 * n; ++i) out[i] = curve(straight_colour(colour[i], 1.0f));                 \
        for (size_t i = 0; i < n; ++i) out[4 * i + 3] = 1.0f;                                                \
        continue;                                                                                            \
      }                                                                                                      \
      for (size_t i = 0; i < n; ++i)                                                                         \
        for (int c = 0; c < 4; ++c) alpha[4 * i + c] = in[4 * i + 3] > 0 ? in[4 * i + 3] : 1.0f;             \
      for (size_t i = 0; i < 4 * n; ++i) colour[i] = curve(straight_colour(colour[i], alpha[i])) * alpha[i]; \
      for (size_t i = 0; i < n; ++i) {                                                                       \
        const float a = in[4 * i + 3];                                                                       \
        for (int c = 0; c < 3; ++c) out[4 * i + c] = colour[4 * i + c];                                      \
        out[4 * i + 3] = a;                                                                                  \
      }                                                                                                      \
    }                                                                                                        \
  }

STILLWATER_PIXELS_KERNEL(display_to_scene_kernel, linear_of_srgb)
STILLWATER_PIXELS_KERNEL(scene_to_display_kernel, srgb_of_linear)

#undef STILLWATER_PIXELS_KERNEL

static inline float within_half(float x) { return x > 65504.0f ? 65504.0f : (x < -65504.0f ? -65504.0f : x); }

// Nearest even by hand: below 2^-14 a half counts in steps of 2^-24, which adding 1/2 makes the float's own.
static inline uint16_t half_of(float x) {
  const uint32_t bits = bits_of(within_half(x)), sign = (bits >> 16) & 0x8000u, size = bits & 0x7fffffffu;
  const uint32_t normal = (size - 0x38000000u + 0xfffu + ((size >> 13) & 1u)) >> 13;
  const uint32_t subnormal = bits_of(float_of(size) + 0.5f) - 0x3f000000u;
  const uint32_t not_a_number = 0x7e00u | ((size >> 13) & 0x3ffu);
  const uint32_t half = size > 0x7f800000u ? not_a_number : (size < 0x38800000u ? subnormal : normal);
  return (uint16_t)(sign | half);
}

static void to_half_kernel(const float* in, uint16_t* out, size_t count) {
  size_t i = 0;
#if defined(__F16C__)
  const __m256 most = _mm256_set1_ps(65504.0f), least = _mm256_set1_ps(-65504.0f);
  for (; i + 8 <= count; i += 8) {
    // min and max give their second argument where one is not a number: the pixel's own.
    const __m256 x = _mm256_max_ps(least, _mm256_min_ps(most, _mm256_loadu_ps(in + i)));
    _mm_storeu_si128((__m128i*)(out + i), _mm256_cvtps_ph(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
  }
#endif
  for (; i < count; ++i) out[i] = half_of(in[i]);
}

static void round_mantissa_kernel(const float* in, float* out, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    const uint32_t bits = bits_of(in[i]);
    out[i] = float_of((bits + 0x3ffu + ((bits >> 11) & 1u)) & ~0x7ffu);
  }
}
