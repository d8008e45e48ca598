#pragma once

#include "motion/shimmer_kernel.h"

namespace stillwater {

void shimmer_swing_avx2(const float* frequency, double loop, double time, const float* phase, float size, int count,
                        float* out);
/// shimmer_unmap_run().
void shimmer_unmap_avx2(const ShimmerKernel* kernel, float* x, float* y, int count);

}  // namespace stillwater
