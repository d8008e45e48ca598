#pragma once

#include "motion/shimmer_kernel.h"

namespace stillwater {

void shimmer_unmap_avx2(const ShimmerKernel& kernel, float* x, float* y, int count);

}  // namespace stillwater
