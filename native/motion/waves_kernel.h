#pragma once

/// The time factor of the waves, in plain C that compilers turn into vectors; included by waves.cpp (SSE4.2) and
/// waves_avx2.cpp.

/// cos and sin of 2 pi turns[i] time, to 2e-7. The turns are reduced in double precision.
static inline void wave_phases(const double* turns, double time, int count, float* cosines, float* sines) {
  const double to_whole = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to a whole number
  for (int i = 0; i < count; ++i) {
    const double all = turns[i] * time;
    const float x = (float)(all - ((all + to_whole) - to_whole));
    // Fold to a quarter turn on either side; half a turn away changes both signs.
    const float half = (2 * x + 12582912.0f) - 12582912.0f;  // -1, 0 or 1
    const float r = x - 0.5f * half;
    const float sign = 1 - 2 * half * half;
    const float q = r * r;
    const float s = r * (6.2831855f + q * (-41.341682f + q * (81.602478f + q * (-76.581284f + q * 39.760723f))));
    const float c = 1 + q * (-19.739208f + q * (64.939384f + q * (-85.455361f + q * (60.179092f - q * 25.218599f))));
    cosines[i] = sign * c;
    sines[i] = sign * s;
  }
}

/// One column of the half spectrum: real = m0 cos + m1 sin, imaginary = m2 cos + m3 sin, where m0 .. m3 are columns of
/// `modes`, `stride` apart: with A(k) = a + ib and A(-k) = p - iq they are a + p, b - q, b + q, p - a.
static inline void wave_modes(const float* modes, int stride, const float* cosines, const float* sines, int count, float* out) {
  const float *m0 = modes, *m1 = m0 + stride, *m2 = m1 + stride, *m3 = m2 + stride;
  for (int i = 0; i < count; ++i) {
    out[2 * i] = m0[i] * cosines[i] + m1[i] * sines[i];
    out[2 * i + 1] = m2[i] * cosines[i] + m3[i] * sines[i];
  }
}
