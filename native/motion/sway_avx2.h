#pragma once

namespace stillwater {

struct SwayKernel;

void sway_map_avx2(const SwayKernel& kernel, float* x, float* y, int count);
void sway_unmap_avx2(const SwayKernel& kernel, float* x, float* y, int count);

}  // namespace stillwater
