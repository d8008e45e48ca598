#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

/// The sRGB curve (IEC 61966-2-1:1999, equations of section 5.2) both ways, and rows of pixels through it.
///
/// The curve is not clamped: above 1 it goes on, and a negative value is the mirror image of its positive one.
/// Results lie within 1e-6 of the exact value, relatively; not-a-number stays so. The powers are computed with
/// multiplications and square roots alone, each rounded as IEEE 754 says: the bytes are the same with and without
/// AVX2.
///
/// `in` and `out` may be the same memory, but must not overlap otherwise.
namespace stillwater {

/// How the numbers of a picture's file are meant.
enum class ColourSpace {
  automatic,  ///< linear for OpenEXR and Radiance HDR files, sRGB else
  srgb,
  linear,
};

/// "auto", "srgb" or "linear". Throws BadInput for any other name.
ColourSpace colour_space_named(const std::string& name);

void srgb_to_linear(const float* in, float* out, std::size_t count);
void linear_to_srgb(const float* in, float* out, std::size_t count);

/// One row of premultiplied display-referred pixels to premultiplied scene-linear ones, or back: un-premultiply,
/// curve, premultiply. Where alpha is 0 (light without cover), the colour goes through the curve as it is.
void display_to_scene(const float* rgba_in, float* rgba_out, std::size_t pixels);
void scene_to_display(const float* rgba_in, float* rgba_out, std::size_t pixels);

/// The same as display_to_scene() for what a screen shows and nobody keeps: straight colours lie within 1/40 of one
/// level of 256, with AVX2 by a polynomial between -0.04 and 1.1.
void display_to_screen(const float* rgba_in, float* rgba_out, std::size_t pixels);

/// To half floats, rounded to nearest even. What a half can't hold becomes the largest it can (65504), so that no
/// infinity comes into a picture; not-a-number stays so.
void to_half(const float* in, std::uint16_t* out, std::size_t count);

/// Rounds to 12 bits of mantissa, nearest even: numbers that compress, within 1/8192 of what they were.
void round_mantissa(const float* in, float* out, std::size_t count);

}  // namespace stillwater
