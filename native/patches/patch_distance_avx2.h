#pragma once

#include <stddef.h>

/// The AVX2 form of PatchDistance; the first pixels of both patches are given. Behind each row of a patch 32 bytes may
/// be read.
int stillwater_patch_distance_avx2(const unsigned char* target, ptrdiff_t target_stride, const unsigned char* source,
                                   ptrdiff_t source_stride, int patch, int limit);
