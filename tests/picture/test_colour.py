"""The sRGB curve and half floats: against closed forms in double precision, and the two CPU ways against each other."""

import os
import subprocess
import sys

import numpy as np
import pytest
from stillwater import _stillwater as engine
from stillwater import linear_to_srgb, srgb_to_linear

SIZES = np.concatenate([np.geomspace(1e-30, 1e14, 400_001), np.linspace(0, 2, 200_001)]).astype(np.float32)


def exact_linear(v):
    v = np.asarray(v, np.float64)
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def exact_srgb(v):
    v = np.asarray(v, np.float64)
    return np.where(v <= 0.0031308, v * 12.92, 1.055 * v ** (1 / 2.4) - 0.055)


@pytest.mark.parametrize(("ours", "exact"), [(srgb_to_linear, exact_linear), (linear_to_srgb, exact_srgb)])
def test_the_curve_is_within_a_millionth(ours, exact):
    np.testing.assert_allclose(ours(SIZES), exact(SIZES), rtol=1e-6, atol=0)


@pytest.mark.parametrize("ours", [srgb_to_linear, linear_to_srgb])
def test_negative_values_are_mirrored_and_what_is_not_a_number_stays(ours):
    np.testing.assert_array_equal(ours(-SIZES), -ours(SIZES))
    np.testing.assert_array_equal(ours([np.nan, np.inf, -np.inf]), [np.nan, np.inf, -np.inf])


def test_any_shape_comes_back():
    assert srgb_to_linear(0.5).shape == ()
    assert srgb_to_linear(np.zeros((0, 3))).shape == (0, 3)
    assert linear_to_srgb(np.ones((2, 3, 4, 5), np.float64)).shape == (2, 3, 4, 5)
    assert linear_to_srgb(np.ones((4, 6))[:, ::2]).dtype == np.float32


def test_every_8_bit_value_survives_a_half_float_file():
    values = np.arange(256)
    halves = srgb_to_linear(values / 255).astype(np.float16)
    np.testing.assert_array_equal(np.rint(linear_to_srgb(halves.astype(np.float32)) * 255), values)


def test_every_16_bit_value_survives_a_float_file():
    values = np.arange(65536)
    np.testing.assert_array_equal(np.rint(linear_to_srgb(srgb_to_linear(values / 65535)) * 65535), values)


def test_half_floats_are_numpys_within_their_range():
    bits = np.random.default_rng(4).integers(0, 2**32, 500_003, dtype=np.uint32)
    values = bits.view(np.float32)
    values = values[np.abs(values) <= 65504]
    edges = np.array([0, -0.0, 2**-24, 2**-25, 3 * 2**-25, 2**-14, 2**-14 - 2**-26, 65504, 1 + 2**-11, 1 + 3 * 2**-11])
    values = np.concatenate([values, edges.astype(np.float32)])
    np.testing.assert_array_equal(engine.to_half(values), values.astype(np.float16).view(np.uint16))


def test_what_a_half_cannot_hold_becomes_its_largest():
    halves = engine.to_half(np.array([65505, 1e30, np.inf, -1e9, -np.inf], np.float32)).view(np.float16)
    np.testing.assert_array_equal(halves, np.array([65504, 65504, 65504, -65504, -65504], np.float16))


def test_flow_is_rounded_to_12_bits_of_mantissa():
    values = np.random.default_rng(2).normal(0, 30, 100_001).astype(np.float32)
    rounded = engine.round_mantissa(values)
    assert not (rounded.view(np.uint32) & 0x7FF).any()
    fraction, exponent = np.frexp(values.astype(np.float64))
    np.testing.assert_array_equal(rounded, np.ldexp(np.rint(fraction * 2**13) / 2**13, exponent))


PROGRAM = """
import hashlib, numpy as np
from stillwater import _stillwater as engine
v = np.concatenate([np.geomspace(1e-12, 1e9, 100_003), np.linspace(-2, 2, 100_003)]).astype(np.float32)
parts = [engine.srgb_to_linear(v), engine.linear_to_srgb(v), engine.to_half(v), engine.round_mantissa(v)]
rgba = np.random.default_rng(1).random((37, 41, 4)).astype(np.float32)
rgba[..., :3] *= rgba[..., 3:]
parts += [engine.display_to_scene(rgba), engine.scene_to_display(rgba)]
print(engine.has_avx2(), hashlib.sha256(b"".join(p.tobytes() for p in parts)).hexdigest())
"""


def test_the_sse_way_gives_the_same_bytes():
    answers = []
    for wish in ("", "sse4.2"):
        environment = {**os.environ, "STILLWATER_CPU": wish}
        command = [sys.executable, "-c", PROGRAM]
        run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=True)
        answers.append(run.stdout.split())
    assert answers[1][0] == "False"
    if answers[0][0] == "False":
        pytest.skip("this CPU has no AVX2: there is only one way")
    assert answers[0][1] == answers[1][1]


def test_pixels_are_unpremultiplied_for_the_curve():
    rng = np.random.default_rng(3)
    alpha = rng.random((50, 70, 1)).astype(np.float32)
    straight = (rng.random((50, 70, 3)) * 1.5).astype(np.float32)
    display = np.concatenate([straight * alpha, alpha], 2)
    scene = engine.display_to_scene(display)
    np.testing.assert_allclose(scene[..., :3], exact_linear(straight) * alpha, rtol=2e-6, atol=1e-7)
    np.testing.assert_array_equal(scene[..., 3:], alpha)
    np.testing.assert_allclose(engine.scene_to_display(scene), display, rtol=3e-6, atol=1e-7)


def test_for_a_screen_the_curve_is_within_a_fortieth_of_a_level():
    straight = np.concatenate([np.linspace(-0.5, 2, 300_000), np.geomspace(1e-6, 1e4, 99_999), [np.nan]], dtype=np.float32)
    for alpha in (1, 0.25, 0):
        display = np.dstack([straight * (alpha or 1)] * 3 + [np.full_like(straight, alpha)])
        screen = engine.display_to_screen(display)
        shown = linear_to_srgb(screen[..., :3] / (alpha or 1))
        exact = linear_to_srgb(engine.display_to_scene(display)[..., :3] / (alpha or 1))
        np.testing.assert_allclose(shown, exact, rtol=1e-5, atol=1 / 40 / 255)
        np.testing.assert_array_equal(screen[..., 3], display[..., 3])


def test_light_without_cover_goes_through_the_curve_as_it_is():
    pixel = np.array([[[0.5, 0.25, 0.125, 0]]], np.float32)
    np.testing.assert_allclose(engine.display_to_scene(pixel)[0, 0, :3], exact_linear(pixel[0, 0, :3]), rtol=1e-6)
    tiny = np.array([[[1e20, 1, 0, 1e-38]]], np.float32)
    assert np.isfinite(engine.scene_to_display(tiny)).all()


def test_colour_spaces_are_named():
    with pytest.raises(ValueError, match="^colour_space: rgb is not auto, srgb or linear$"):
        engine.colour_space_named("rgb")
