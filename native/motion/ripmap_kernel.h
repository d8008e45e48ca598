#pragma once

/// The inner loops of the ripmap, in plain C that compilers turn into vectors; included by ripmap.cpp (SSE4.2). The
/// AVX2 forms are in ripmap_avx2.cpp.

enum { ripmap_block = 64 };

/// sum[i] = total over t of near[t] rows[t][i] + far[t] rows[t][i + 1].
static inline void weighted_rows(const float* const* rows, const float* near, const float* far, int taps, int count,
                                 float* sum) {
  for (int i = 0; i < count; ++i) sum[i] = near[0] * rows[0][i] + far[0] * rows[0][i + 1];
  for (int t = 1; t < taps; ++t) {
    const float *row = rows[t], a = near[t], b = far[t];
    for (int i = 0; i < count; ++i) sum[i] += a * row[i] + b * row[i + 1];
  }
}

/// One pass of smoothing: each number gives the share `side` to both neighbours. The ends stay.
static inline void smoothed_line(const float* line, float side, int count, float* smooth) {
  smooth[0] = line[0];
  for (int i = 1; i + 1 < count; ++i) smooth[i] = line[i] + side * (line[i - 1] + line[i + 1] - 2 * line[i]);
  smooth[count - 1] = line[count - 1];
}

/// The cubic B-spline with these coefficients at x + i step, 1 <= x, for a block of places; the coefficients reach 2
/// beyond the last one.
static inline void spline_at(const float* coefficients, float x, float step, float* values) {
  float result[ripmap_block];
  for (int i = 0; i < ripmap_block; ++i) {
    const float place = x + step * (float)i;
    const int whole = (int)place;
    const float f = place - (float)whole, g = 1 - f;
    const float f2 = f * f, g2 = g * g;
    result[i] = (g2 * g * coefficients[whole - 1] + (4 - 3 * f2 * (1 + g)) * coefficients[whole] +
                 (4 - 3 * g2 * (1 + f)) * coefficients[whole + 1] + f2 * f * coefficients[whole + 2]) *
                (1.0f / 6);
  }
  for (int i = 0; i < ripmap_block; ++i) values[i] = result[i];
}
