#include "picture/colour.h"

#include "core/cpu.h"
#include "core/error.h"
#include "picture/colour_avx2.h"
#include "picture/colour_kernel.h"

namespace stillwater {

ColourSpace colour_space_named(const std::string& name) {
  if (name == "auto") return ColourSpace::automatic;
  if (name == "srgb") return ColourSpace::srgb;
  if (name == "linear") return ColourSpace::linear;
  throw BadInput("colour_space: " + name + " is not auto, srgb or linear");
}

void srgb_to_linear(const float* in, float* out, std::size_t count) {
  has_avx2() ? srgb_to_linear_avx2(in, out, count) : srgb_to_linear_kernel(in, out, count);
}

void linear_to_srgb(const float* in, float* out, std::size_t count) {
  has_avx2() ? linear_to_srgb_avx2(in, out, count) : linear_to_srgb_kernel(in, out, count);
}

void display_to_scene(const float* rgba_in, float* rgba_out, std::size_t pixels) {
  has_avx2() ? display_to_scene_avx2(rgba_in, rgba_out, pixels) : display_to_scene_kernel(rgba_in, rgba_out, pixels);
}

void display_to_screen(const float* rgba_in, float* rgba_out, std::size_t pixels) {
  has_avx2() ? display_to_screen_avx2(rgba_in, rgba_out, pixels) : display_to_scene_kernel(rgba_in, rgba_out, pixels);
}

void scene_to_display(const float* rgba_in, float* rgba_out, std::size_t pixels) {
  has_avx2() ? scene_to_display_avx2(rgba_in, rgba_out, pixels) : scene_to_display_kernel(rgba_in, rgba_out, pixels);
}

void to_half(const float* in, std::uint16_t* out, std::size_t count) {
  has_avx2() ? to_half_avx2(in, out, count) : to_half_kernel(in, out, count);
}

void round_mantissa(const float* in, float* out, std::size_t count) {
  has_avx2() ? round_mantissa_avx2(in, out, count) : round_mantissa_kernel(in, out, count);
}

}  // namespace stillwater
