#pragma once

#include <math.h>

/// The swing of shimmer.h at many points, in plain loops; included by shimmer.cpp (SSE4.2) and shimmer_avx2.cpp.
namespace stillwater {

static const int shimmer_side = 64;  // nodes of the lattice along each axis; a power of two
static const int shimmer_stride = shimmer_side + 3;  // ... and as they are kept: the first few again at the end

struct ShimmerKernel {
  float root_x, root_y;
  float per_cell, per_length;  // 1 / px
  const float* swing;  // of shimmer_side + 2 rows of shimmer_stride nodes, x and y of each, px
};

/// `count` nodes at a moment: size cos(2 pi (frequency time + phase)), to 1e-6 of the size; frequencies in Hz, phases
/// in turns, time in seconds. In a loop (of so many seconds, above 0) frequencies become whole turns, at least one,
/// and time is the share of the loop.
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

static const int shimmer_run = 64;

// Where points lie on the lattice.
struct ShimmerPlaces {
  float across[64], down[3][64];  // from the middle node, -0.5 .. 0.5; weights of the rows
  int first[64];                  // of the nine nodes around: index of its x
  float growth[64];
};

static inline void shimmer_places(const ShimmerKernel* kernel, const float* x, const float* y, int count,
                                  ShimmerPlaces* places) {
  const ShimmerKernel k = *kernel;
  const int last = shimmer_side - 1;
  for (int p = 0; p < count; ++p) {
    const float dx = x[p] - k.root_x, dy = y[p] - k.root_y;
    const float cell_x = floorf(dx * k.per_cell + 0.5f), cell_y = floorf(dy * k.per_cell + 0.5f);
    float down[3];
    shimmer_weights(dy * k.per_cell - cell_y, down);
    places->across[p] = dx * k.per_cell - cell_x;
    for (int j = 0; j < 3; ++j) places->down[j][p] = down[j];
    const int column = ((int)cell_x - 1) & last, row = ((int)cell_y - 1) & last;
    places->first[p] = 2 * (row * shimmer_stride + column);
    const float far = sqrtf(dx * dx + dy * dy) * k.per_length;
    const float u = far < 1.0f ? far : 1.0f;
    places->growth[p] = u * u * (3 - 2 * u);
  }
}

static inline void shimmer_unmap_run(const ShimmerKernel* kernel, float* x, float* y, int count) {
  ShimmerPlaces places;
  shimmer_places(kernel, x, y, count, &places);
  for (int p = 0; p < count; ++p) {
    float across[3], swing_x = 0, swing_y = 0;
    shimmer_weights(places.across[p], across);
    for (int j = 0; j < 3; ++j) {
      const float* nodes = kernel->swing + places.first[p] + 2 * shimmer_stride * j;
      swing_x += places.down[j][p] * (across[0] * nodes[0] + across[1] * nodes[2] + across[2] * nodes[4]);
      swing_y += places.down[j][p] * (across[0] * nodes[1] + across[1] * nodes[3] + across[2] * nodes[5]);
    }
    x[p] += places.growth[p] * swing_x;
    y[p] += places.growth[p] * swing_y;
  }
}

}  // namespace stillwater
