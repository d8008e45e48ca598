#pragma once

/// ripple_kernel.h compiled for AVX2.
void weighted_rows_avx2(const float* const* rows, const float* near, const float* far, int taps, int count, float* sum);
void spline_at_avx2(const float* coefficients, float x, float step, int count, float* values);
