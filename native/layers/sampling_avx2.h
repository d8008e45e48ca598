#pragma once

#include <stddef.h>

/// The AVX2 form of Source::sample for at most 64 places that lie within the framed image. Of x and y
/// up to 7 numbers behind `count` are read.
void stillwater_sample_avx2(const float* origin, ptrdiff_t stride, const float* x, const float* y,
                            const unsigned char* needed, int count, float* out);

/// The AVX2 form of Range (sampling.cpp), for at least 8 numbers.
void stillwater_range_avx2(const float* at, int count, float* low, float* high);
