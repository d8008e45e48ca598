#pragma once

#include <stddef.h>

/// Catmull-Rom at many places of an RGBA image; compiled twice (sampling.cpp, sampling_avx2.cpp).
/// `origin` is the pixel that index (0, 0) stands for; rows are `stride` floats apart.

typedef float stillwater_v4 __attribute__((vector_size(16)));
typedef float stillwater_v4u __attribute__((vector_size(16), aligned(4)));

static const int sampling_run = 64;

struct SamplingWeights {
  float x[4][64], y[4][64];
  int column[64], row[64];
};

static inline void catmull_rom_weights(const float* at, int count, int* whole, float (*weights)[64]) {
  for (int i = 0; i < count; ++i) {
    const int cut = (int)at[i];
    const int floor = cut - (at[i] < (float)cut);
    const float t = at[i] - (float)floor, t2 = t * t, t3 = t2 * t;
    whole[i] = floor;
    weights[0][i] = -0.5f * t3 + t2 - 0.5f * t;
    weights[1][i] = 1.5f * t3 - 2.5f * t2 + 1.0f;
    weights[2][i] = -1.5f * t3 + 2.0f * t2 + 0.5f * t;
    weights[3][i] = 0.5f * t3 - 0.5f * t2;
  }
}

// Rows further down are sampled next: a tile's rows are too short for the processor to see that coming.
static inline void ask_for_rows_below(const float* pixel, ptrdiff_t stride) { __builtin_prefetch(pixel + 6 * stride); }

static const float coverage_error = 1e-6f;  // of the weights' sum

// Coverage as close to 1 as weights are exact is 1, so that what is opaque stays so.
static inline stillwater_v4 settled(stillwater_v4 colour) {
  const float beside = colour[3] - 1.0f;
  if (beside <= coverage_error && beside >= -coverage_error) colour[3] = 1.0f;
  return colour;
}

static inline int is_coverage(float coverage) { return coverage >= 0.0f && coverage <= 1.0f; }

static inline stillwater_v4 within_coverage(stillwater_v4 colour) {
  const float coverage = colour[3];
  if (coverage > 1.0f) return colour * (1.0f / coverage);
  if (coverage < 0.0f) return colour * 0.0f;
  return colour;
}
