#pragma once

#include <stddef.h>
#include <stdint.h>

// colour.h once more, to be called only where has_avx2() says so.

void srgb_to_linear_avx2(const float* in, float* out, size_t count);
void linear_to_srgb_avx2(const float* in, float* out, size_t count);
void display_to_scene_avx2(const float* rgba_in, float* rgba_out, size_t pixels);
void display_to_screen_avx2(const float* rgba_in, float* rgba_out, size_t pixels);
void scene_to_display_avx2(const float* rgba_in, float* rgba_out, size_t pixels);
void to_half_avx2(const float* in, uint16_t* out, size_t count);
void round_mantissa_avx2(const float* in, float* out, size_t count);
