#pragma once

#include <math.h>

/// The turn of sway.h in plain loops that the compiler makes into vectors; compiled by sway.cpp and, for AVX2, by
/// sway_avx2.cpp.
/// Sine and cosine are Taylor's to the 9th and 10th power: within 3e-8 up to the largest turn of 1 rad.
namespace stillwater {

struct SwayKernel {
  float root_x, root_y;
  float axis_x, axis_y;        // unit vector from root to tip
  float inverse_length;        // 1 / px
  float tip_angle;             // d_tip / length, rad, clockwise on the screen, within 1
  float stretch, unstretch;    // scale along the axis less 1, and that of the inverse
};

// The vector (dx, dy) from the root, turned by `sign` times the angle that belongs to its length; gives the change.
static inline void sway_turn(const SwayKernel& k, float sign, float dx, float dy, float* change_x, float* change_y) {
  const float u = sqrtf(dx * dx + dy * dy) * k.inverse_length;
  const float v = u < 1.0f ? u : 1.0f;
  const float beyond = u > 1.0f ? u : 1.0f;
  const float share = v * (2.0f + v * (-4.0f / 3.0f + v * (1.0f / 3.0f))) / beyond;  // eq. 3 over u; 1/u beyond
  const float angle = sign * k.tip_angle * share;
  const float a2 = angle * angle;
  const float sine =
      angle * (1.0f + a2 * (-1.0f / 6 + a2 * (1.0f / 120 + a2 * (-1.0f / 5040 + a2 * (1.0f / 362880)))));
  const float versine =  // cosine - 1
      a2 * (-0.5f + a2 * (1.0f / 24 + a2 * (-1.0f / 720 + a2 * (1.0f / 40320 + a2 * (-1.0f / 3628800)))));
  *change_x = versine * dx - sine * dy;
  *change_y = sine * dx + versine * dy;
}

static inline void sway_map_points(const SwayKernel& kernel, float* __restrict x, float* __restrict y, int count) {
  const SwayKernel k = kernel;
  for (int i = 0; i < count; ++i) {
    const float dx = x[i] - k.root_x, dy = y[i] - k.root_y;
    const float longer = k.stretch * (dx * k.axis_x + dy * k.axis_y);
    const float stretch_x = longer * k.axis_x, stretch_y = longer * k.axis_y;
    float turn_x, turn_y;
    sway_turn(k, 1.0f, dx + stretch_x, dy + stretch_y, &turn_x, &turn_y);
    x[i] += stretch_x + turn_x;
    y[i] += stretch_y + turn_y;
  }
}

static inline void sway_unmap_points(const SwayKernel& kernel, float* __restrict x, float* __restrict y, int count) {
  const SwayKernel k = kernel;
  for (int i = 0; i < count; ++i) {
    const float dx = x[i] - k.root_x, dy = y[i] - k.root_y;
    float turn_x, turn_y;
    sway_turn(k, -1.0f, dx, dy, &turn_x, &turn_y);
    const float longer = k.unstretch * ((dx + turn_x) * k.axis_x + (dy + turn_y) * k.axis_y);
    x[i] += turn_x + longer * k.axis_x;
    y[i] += turn_y + longer * k.axis_y;
  }
}

}  // namespace stillwater
