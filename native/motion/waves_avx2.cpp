#include "motion/waves_avx2.h"

#include "motion/waves_kernel.h"

void wave_phases_avx2(const double* turns, double time, int count, float* cosines, float* sines) {
  wave_phases(turns, time, count, cosines, sines);
}

void wave_modes_avx2(const float* modes, int stride, const float* cosines, const float* sines, int count, float* out) {
  wave_modes(modes, stride, cosines, sines, count, out);
}
