"""The public read and write: straight alpha at Python's border, warnings, types."""

import warnings

import numpy as np
import pytest
import stillwater
from PIL import Image
from stillwater import _stillwater as engine

RNG = np.random.default_rng(31)


def test_colours_are_straight(tmp_path):
    stored = RNG.integers(0, 256, (9, 13, 4), np.uint8)
    stored[0, 0, 3] = 0
    Image.fromarray(stored).save(tmp_path / "p.png")
    image = stillwater.read(tmp_path / "p.png")
    assert image.dtype == np.float32
    expected = stored / np.float32(255)
    expected[0, 0] = 0
    np.testing.assert_allclose(image, expected, atol=1e-6)


@pytest.mark.parametrize(
    ("name", "bits", "step"), [("p.png", None, 255), ("p.png", 16, 65535), ("p.tif", 8, 255), ("p.tif", 16, 65535)]
)
@pytest.mark.parametrize("channels", [3, 4])
def test_what_is_written_comes_back(tmp_path, name, bits, step, channels):
    stored = RNG.integers(0, step + 1, (9, 13, channels))
    if channels == 4:
        stored[..., 3] = np.maximum(stored[..., 3], step // 8)
    stillwater.write(tmp_path / name, stored / step, bits=bits)
    back = stillwater.read(tmp_path / name)
    np.testing.assert_array_equal(np.rint(back[..., :channels] * step), stored)
    assert engine.inspect_picture(str(tmp_path / name)).channels == channels
    assert engine.inspect_picture(str(tmp_path / name)).pixel_type == ("uint8" if step == 255 else "uint16")


def test_others_read_a_png(tmp_path):
    stored = RNG.integers(0, 256, (9, 13, 4), np.uint8)
    stored[..., 3] |= 128
    stillwater.write(tmp_path / "p.png", stored / 255)
    np.testing.assert_array_equal(np.asarray(Image.open(tmp_path / "p.png")), stored)


def test_a_jpeg_lies_over_black(tmp_path):
    stillwater.write(tmp_path / "p.jpg", np.full((16, 16, 4), 0.5))
    with Image.open(tmp_path / "p.jpg") as image:
        np.testing.assert_allclose(np.asarray(image), 64, atol=2)


@pytest.mark.parametrize(("bits", "tolerance"), [(None, 2**-10), (16, 2**-10), (32, 3e-6)])
def test_an_exr_keeps_what_is_above_white(tmp_path, bits, tolerance):
    image = RNG.random((9, 13, 4)).astype(np.float32) * [3, 3, 3, 1]
    image[..., 3] = image[..., 3] * 0.9 + 0.1
    stillwater.write(tmp_path / "p.exr", image, bits=bits)
    np.testing.assert_allclose(stillwater.read(tmp_path / "p.exr"), image, rtol=tolerance, atol=tolerance)


def test_a_float_tiff_keeps_what_is_above_white(tmp_path):
    image = RNG.random((9, 13, 3)).astype(np.float32) * 3
    stillwater.write(tmp_path / "p.tif", image, bits=32)
    np.testing.assert_array_equal(stillwater.read(tmp_path / "p.tif")[..., :3], image)


def test_values_outside_are_clamped_in_8_bits(tmp_path):
    stillwater.write(tmp_path / "p.png", np.array([[[-1, 0.5, 7]]]))
    np.testing.assert_array_equal(np.asarray(Image.open(tmp_path / "p.png")), [[[0, 128, 255]]])


def test_pixels_that_are_no_numbers_are_counted_in_a_warning(tmp_path):
    image = np.ones((4, 5, 3), np.float32)
    image[1, 2, 0] = np.nan
    stillwater.write(tmp_path / "p.tif", image, bits=32)
    with pytest.warns(UserWarning) as caught:
        read = stillwater.read(tmp_path / "p.tif")
    assert str(caught[0].message) == f"{tmp_path / 'p.tif'}: 1 pixel is not a finite number and counts as 0"
    np.testing.assert_array_equal(read[1, 2], [0, 0, 0, 1])
    image[0] = np.inf
    stillwater.write(tmp_path / "p.tif", image, bits=32)
    with pytest.warns(UserWarning, match="p.tif: 6 pixels are not finite numbers and count as 0$"):
        stillwater.read(tmp_path / "p.tif")


def test_a_good_picture_gives_no_warning(tmp_path):
    stillwater.write(tmp_path / "p.png", np.zeros((3, 3, 3)))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        stillwater.read(tmp_path / "p.png")


@pytest.mark.parametrize(
    ("name", "image", "bits", "sentence"),
    [
        ("p.xyz", np.zeros((2, 2, 3)), None, "{}: its extension is not .png, .jpg, .jpeg, .tif, .tiff or .exr"),
        ("p.jpg", np.zeros((2, 2, 3)), 16, "bits: 16 is not what JPEG has (8)"),
        ("p.exr", np.zeros((2, 2, 3)), 8, "bits: 8 is not what OpenEXR has (16, 32)"),
        ("p.png", np.zeros((2, 2, 2)), None, "image: an array of 2 x 2 x 2 is not height x width x 4"),
        ("p.png", np.zeros((2, 2)), None, "image: an array of 2 x 2 is not height x width x 4"),
        ("p.png", np.zeros((0, 2, 3)), None, "image: an array of 0 x 2 x 4 is not height x width x 4"),
        ("p.png", np.zeros((1, 16385, 3)), None, "image: 16385 x 1 is not between 1 and 16384 pixels a side"),
    ],
)
def test_what_cannot_be_written(tmp_path, name, image, bits, sentence):
    with pytest.raises(ValueError) as caught:
        stillwater.write(tmp_path / name, image, bits=bits)
    assert str(caught.value) == sentence.format(tmp_path / name)
    assert list(tmp_path.iterdir()) == []


def test_a_colour_space_that_is_not(tmp_path):
    with pytest.raises(ValueError, match="^colour_space: rgb is not auto, srgb or linear$"):
        stillwater.read(tmp_path / "p.png", "rgb")
