#pragma once

/// waves_kernel.h compiled for AVX2.
void wave_phases_avx2(const double* turns, double time, int count, float* cosines, float* sines);
void wave_modes_avx2(const float* modes, int stride, const float* cosines, const float* sines, int count, float* out);
