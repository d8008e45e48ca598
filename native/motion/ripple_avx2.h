#pragma once

/// ripple_kernel.h compiled for AVX2.
struct raised_water;
struct mirror_water;
void raised_map_avx2(const struct raised_water* water, float* px, float* py, int count, int* left_out);
void raised_unmap_avx2(const struct raised_water* water, float* px, float* py, int count, int* left_out);
void raised_line_avx2(const struct raised_water* water, const float* heights, float y, int count, float* to_y);
void mirror_move_avx2(const struct mirror_water* water, int rounds, float sign, float* px, float* py, int count,
                      int* left_out);
