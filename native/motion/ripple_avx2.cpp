#include "motion/ripple_avx2.h"

#include "motion/ripple_kernel.h"

void weighted_rows_avx2(const float* const* rows, const float* near, const float* far, int taps, int count, float* sum) {
  weighted_rows(rows, near, far, taps, count, sum);
}

void spline_at_avx2(const float* coefficients, float x, float step, int count, float* values) {
  spline_at(coefficients, x, step, count, values);
}
