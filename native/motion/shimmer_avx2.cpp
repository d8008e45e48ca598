#include "motion/shimmer_avx2.h"

namespace stillwater {

void shimmer_unmap_avx2(const ShimmerKernel& kernel, float* x, float* y, int count) {
  shimmer_unmap_points(kernel, x, y, count);
}

}  // namespace stillwater
