#include "picture/colour_avx2.h"

#include "picture/colour_kernel.h"

void srgb_to_linear_avx2(const float* in, float* out, size_t count) { srgb_to_linear_kernel(in, out, count); }

void linear_to_srgb_avx2(const float* in, float* out, size_t count) { linear_to_srgb_kernel(in, out, count); }

void display_to_scene_avx2(const float* rgba_in, float* rgba_out, size_t pixels) {
  display_to_scene_kernel(rgba_in, rgba_out, pixels);
}

void scene_to_display_avx2(const float* rgba_in, float* rgba_out, size_t pixels) {
  scene_to_display_kernel(rgba_in, rgba_out, pixels);
}

void to_half_avx2(const float* in, uint16_t* out, size_t count) { to_half_kernel(in, out, count); }

void round_mantissa_avx2(const float* in, float* out, size_t count) { round_mantissa_kernel(in, out, count); }
