#include "motion/ripple_avx2.h"

#include "motion/ripple_kernel.h"

void raised_map_avx2(const struct raised_water* water, float* px, float* py, int count, int* left_out) {
  raised_map(water, px, py, count, left_out);
}

void raised_unmap_avx2(const struct raised_water* water, float* px, float* py, int count, int* left_out) {
  raised_unmap(water, px, py, count, left_out);
}

void raised_line_avx2(const struct raised_water* water, const float* heights, float y, int count, float* to_y) {
  raised_line(water, heights, y, count, to_y);
}

void mirror_move_avx2(const struct mirror_water* water, int rounds, float sign, float* px, float* py, int count,
                      int* left_out) {
  mirror_move(water, rounds, sign, px, py, count, left_out);
}
