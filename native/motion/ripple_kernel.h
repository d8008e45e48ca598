#pragma once

/// The inner loops of the water in the picture, in plain C that compilers turn into vectors; included by ripmap.cpp
/// and ripple.cpp (SSE4.2) and ripple_avx2.cpp.

/// sum[i] = total over t of near[t] rows[t][i] + far[t] rows[t][i + 1].
static void weighted_rows(const float* const* rows, const float* near, const float* far, int taps, int count, float* sum) {
  for (int i = 0; i < count; ++i) sum[i] = near[0] * rows[0][i] + far[0] * rows[0][i + 1];
  for (int t = 1; t < taps; ++t) {
    const float *row = rows[t], a = near[t], b = far[t];
    for (int i = 0; i < count; ++i) sum[i] += a * row[i] + b * row[i + 1];
  }
}

/// The cubic B-spline with these coefficients at x + i step, 1 <= x; the coefficients reach 2 beyond the last place.
static void spline_at(const float* coefficients, float x, float step, int count, float* values) {
  for (int i = 0; i < count; ++i) {
    const float place = x + step * (float)i;
    const int whole = (int)place;
    const float f = place - (float)whole, g = 1 - f;
    const float* c = coefficients + whole - 1;
    const float f2 = f * f, g2 = g * g;
    values[i] = (g2 * g * c[0] + (4 - 3 * f2 * (1 + g)) * c[1] + (4 - 3 * g2 * (1 + f)) * c[2] + f2 * f * c[3]) * (1.0f / 6);
  }
}
