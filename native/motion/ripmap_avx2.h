#pragma once

/// The loops of ripmap_kernel.h for AVX2. The first writes, and reads of the rows, up to 15 numbers behind `count` (and
/// the one behind them); the last reads up to 15 behind the last coefficient that it needs.
void weighted_rows_avx2(const float* const* rows, const float* near, const float* far, int taps, int count, float* sum);
void smoothed_line_avx2(const float* line, float side, int count, float* smooth);
void spline_at_avx2(const float* coefficients, float x, float step, float* values);
