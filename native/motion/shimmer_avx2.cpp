#include "motion/shimmer_avx2.h"

namespace stillwater {

void shimmer_swing_avx2(const float* frequency, double loop, double time, const float* phase, float size, int count,
                        float* out) {
  shimmer_swing(frequency, loop, time, phase, size, count, out);
}

void shimmer_unmap_avx2(const ShimmerKernel& kernel, float* x, float* y, int count) {
  shimmer_unmap_points(kernel, x, y, count);
}

}  // namespace stillwater
