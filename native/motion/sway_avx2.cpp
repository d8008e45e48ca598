#include "motion/sway_avx2.h"

#include "motion/sway_kernel.h"

namespace stillwater {

void sway_map_avx2(const SwayKernel& kernel, float* x, float* y, int count) { sway_map_points(kernel, x, y, count); }

void sway_unmap_avx2(const SwayKernel& kernel, float* x, float* y, int count) {
  sway_unmap_points(kernel, x, y, count);
}

}  // namespace stillwater
