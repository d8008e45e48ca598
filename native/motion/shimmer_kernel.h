#pragma once

#include <math.h>

/// The swing of shimmer.h at many points, in a plain loop that the compiler makes into vectors; compiled by shimmer.cpp
/// and, for AVX2, by shimmer_avx2.cpp.
namespace stillwater {

static const int shimmer_side = 64;  // nodes of the lattice along each axis; a power of two

struct ShimmerKernel {
  float root_x, root_y;
  float per_cell, per_length;  // 1 / px
  const float *swing_x, *swing_y;  // of the nodes, row by row, px
};

/// `count` nodes at a moment: size cos(2 pi (frequency time + phase)), to 1e-6 of the size; frequencies in Hz, phases in
/// turns, time in seconds. In a loop (of so many seconds, above 0) frequencies become whole turns, at least one, and
/// time is the share of the loop.
static inline void shimmer_swing(const float* frequency, double loop, double time, const float* phase, float size,
                                 int count, float* out) {
  const double to_whole = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to a whole number
  for (int i = 0; i < count; ++i) {
    const double whole = (frequency[i] * loop + to_whole) - to_whole;
    const double turns = loop > 0 ? (whole > 1 ? whole : 1) : frequency[i];
    const double all = turns * time + phase[i];
    const float x = (float)(all - ((all + to_whole) - to_whole));
    // Fold to a quarter turn on either side; half a turn away changes the sign.
    const float half = (2 * x + 12582912.0f) - 12582912.0f;  // -1, 0 or 1
    const float r = x - 0.5f * half, q = r * r;
    const float cosine =
        1 + q * (-19.739208f + q * (64.939384f + q * (-85.455361f + q * (60.179092f - q * 25.218599f))));
    out[i] = size * (1 - 2 * half * half) * cosine;
  }
}

// Quadratic B-spline at f from the middle node, -0.5 .. 0.5.
static inline void shimmer_weights(float f, float* w) {
  const float before = 0.5f - f, after = 0.5f + f;
  w[0] = 0.5f * before * before;
  w[1] = 0.75f - f * f;
  w[2] = 0.5f * after * after;
}

static inline void shimmer_unmap_points(const ShimmerKernel& kernel, float* __restrict x, float* __restrict y,
                                        int count) {
  const ShimmerKernel k = kernel;
  const int last = shimmer_side - 1;
  for (int p = 0; p < count; ++p) {
    const float dx = x[p] - k.root_x, dy = y[p] - k.root_y;
    const float cell_x = floorf(dx * k.per_cell + 0.5f), cell_y = floorf(dy * k.per_cell + 0.5f);
    float across[3], down[3];
    shimmer_weights(dx * k.per_cell - cell_x, across);
    shimmer_weights(dy * k.per_cell - cell_y, down);
    const int column = (int)cell_x, row = (int)cell_y;
    const int left = (column - 1) & last, middle = column & last, right = (column + 1) & last;
    float swing_x = 0, swing_y = 0;
    for (int j = 0; j < 3; ++j) {
      const int line = ((row + j - 1) & last) * shimmer_side;
      swing_x += down[j] * (across[0] * k.swing_x[line + left] + across[1] * k.swing_x[line + middle] +
                            across[2] * k.swing_x[line + right]);
      swing_y += down[j] * (across[0] * k.swing_y[line + left] + across[1] * k.swing_y[line + middle] +
                            across[2] * k.swing_y[line + right]);
    }
    const float far = sqrtf(dx * dx + dy * dy) * k.per_length;
    const float u = far < 1.0f ? far : 1.0f;
    const float growth = u * u * (3 - 2 * u);
    x[p] += growth * swing_x;
    y[p] += growth * swing_y;
  }
}

}  // namespace stillwater
