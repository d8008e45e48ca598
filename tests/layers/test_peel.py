"""Peeling a picture into layers: at rest they give the picture, and what was hidden is filled."""

import numpy as np
import pytest
from stillwater import _stillwater as engine

RNG = np.random.default_rng(8)
SIZE = (48, 64)
PUSH_PULL, NONE = engine.Fill.push_pull, engine.Fill.none


def picture(shape=SIZE):
    levels = RNG.integers(0, 256, (*shape, 3)) / 255
    return np.concatenate([levels, np.ones((*shape, 1))], axis=2).astype(np.float32)


def box_matte(top, bottom, left, right, value=1.0):
    matte = np.zeros(SIZE, np.float32)
    matte[top:bottom, left:right] = value
    return matte


def soft(matte):
    for axis in (0, 1):
        matte = sum(np.roll(matte, k, axis) for k in (-2, -1, 0, 1, 2)) / 5
    return matte.astype(np.float32)


def peel(image, mattes, fills=None, feathers=None):
    fills = fills or [PUSH_PULL] * len(mattes)
    return engine.peel(image, mattes, fills, feathers or [0.0] * len(mattes))


def whole_layer(layer, shape=SIZE):
    image = np.zeros((*shape, 4), np.float32)
    x, y, width, height = layer.box
    image[y : y + height, x : x + width] = layer.pixels
    return image


def laid_over(layers, shape=SIZE):
    whole = np.zeros((*shape, 4), np.float32)
    for layer in reversed(layers):
        front = whole_layer(layer, shape)
        whole = front + (1 - front[..., 3:]) * whole
    return whole


def test_hard_mattes_give_the_picture_bit_by_bit():
    image = picture()
    layers = peel(image, [box_matte(5, 20, 8, 30), box_matte(15, 40, 20, 64), None])
    assert np.array_equal(laid_over(layers), image)


@pytest.mark.parametrize("fill", [PUSH_PULL, NONE, picture()])
def test_soft_mattes_give_the_picture_to_rounding(fill):
    image = picture()
    mattes = [soft(box_matte(5, 20, 8, 30)), soft(box_matte(15, 40, 20, 64, 0.7)), None]
    layers = peel(image, mattes, [fill, fill, PUSH_PULL], [0, 3, 0])
    assert np.abs(laid_over(layers) - image).max() < 1e-5


def test_the_hole_is_filled_with_what_surrounds_it():
    image = np.zeros((*SIZE, 4), np.float32)
    image[...] = (0.2, 0.5, 0.8, 1)
    image[10:30, 10:30, :3] = 0
    behind = whole_layer(peel(image, [box_matte(10, 30, 10, 30), None])[1])
    assert np.allclose(behind, (0.2, 0.5, 0.8, 1), atol=1e-4)


def test_what_a_matte_left_at_its_edge_does_not_fill_the_hole():
    image = np.zeros((*SIZE, 4), np.float32)
    image[...] = (0.2, 0.5, 0.8, 1)
    image[8:32, 8:32, :3] = 0
    behind = whole_layer(peel(image, [box_matte(10, 30, 10, 30), None])[1])
    assert np.allclose(behind[10:30, 10:30], (0.2, 0.5, 0.8, 1), atol=0.02)


def test_a_painted_background_stands_behind():
    painted = picture()
    behind = whole_layer(peel(picture(), [box_matte(10, 30, 10, 30), None], [painted, PUSH_PULL])[1])
    assert np.array_equal(behind[10:30, 10:30], painted[10:30, 10:30])


def test_no_fill_is_transparent_behind():
    behind = whole_layer(peel(picture(), [box_matte(10, 30, 10, 30), None], [NONE, PUSH_PULL])[1])
    assert np.all(behind[10:30, 10:30] == 0)
    assert np.all(behind[:10, :, 3] == 1)


def test_the_old_background_does_not_move_along():
    """A dark disc over white: the disc's own colour at the soft edge is dark, not grey."""
    matte = soft(soft(box_matte(12, 36, 16, 48)))
    image = np.ones((*SIZE, 4), np.float32)
    image[..., :3] = (matte * 0.1 + (1 - matte) * 0.9)[..., None]
    front = whole_layer(peel(image, [matte, None])[0])
    edge = (matte > 0.2) & (matte < 0.8)
    colour = front[edge][:, 0] / front[edge][:, 3]
    halo = image[edge][:, 0] - 0.1
    assert np.all(np.abs(colour - 0.1) < 0.25 * halo + 0.02)


def test_a_matte_goes_on_behind_what_hides_it():
    sea, boat = box_matte(24, 48, 0, 64), box_matte(20, 34, 20, 36)
    layers = peel(picture(), [boat, np.where(boat > 0, 0, sea).astype(np.float32), None])
    hidden = whole_layer(layers[1])[..., 3]
    assert np.all(hidden[30:34, 22:34] > 0.8)
    assert np.all(hidden[:19] == 0)


def test_a_matte_goes_on_only_near_what_is_seen_of_it():
    """A small thing beside a wide curtain does not spread behind all of it."""
    curtain, thing = box_matte(0, 48, 20, 64), box_matte(20, 28, 10, 20)
    layer = peel(picture(), [curtain, thing, None])[1]
    assert layer.box[0] + layer.box[2] < 44


def test_a_layer_is_kept_in_its_box_only():
    layer = peel(picture(), [box_matte(10, 20, 30, 44), None])[0]
    assert layer.box == [28, 8, 18, 14]
    assert layer.pixels.shape == (14, 18, 4)


def test_an_empty_matte_is_an_empty_layer():
    layers = peel(picture(), [box_matte(0, 0, 0, 0), None])
    assert layers[0].box == [0, 0, 0, 0]


def test_a_matte_that_covers_all_leaves_the_picture_behind_it():
    image = picture()
    assert np.array_equal(laid_over(peel(image, [np.ones(SIZE, np.float32), None])[1:]), image)


def test_a_matte_in_a_box_is_that_matte():
    image, mattes = picture(), [soft(box_matte(5, 20, 8, 30)), box_matte(15, 40, 20, 64), np.zeros(SIZE, np.float32)]
    boxes = [(6, 3, 26, 19), (20, 15, 44, 25), (0, 0, 0, 0)]
    parts = [engine.MatteInBox(m[y : y + h, x : x + w].copy(), (x, y, w, h)) for m, (x, y, w, h) in zip(mattes, boxes, strict=True)]
    assert [tuple(part.box) for part in parts] == boxes
    for whole, part in zip(peel(image, [*mattes, None]), peel(image, [*parts, None]), strict=True):
        assert whole.box == part.box and np.array_equal(whole.pixels, part.pixels)


def test_a_matte_that_reaches_outside_the_picture_is_refused():
    part = engine.MatteInBox(np.ones((4, 5), np.float32), (60, 0, 5, 4))
    with pytest.raises(ValueError, match=r"layers\[0\].matte: its box does not fit its pixels and the picture"):
        peel(picture(), [part, None])


def test_a_layer_from_arrays_shares_their_memory():
    pixels = np.ones((4, 5, 4), np.float32)
    layer = engine.LayerImage(pixels, (1, 2, 5, 4))
    pixels[0, 0, 0] = 0.25
    assert layer.pixels[0, 0, 0] == 0.25


@pytest.mark.parametrize(
    "mattes, fills, feathers, sentence",
    [
        ([np.zeros((3, 4), np.float32), None], None, None, r"layers\[0\].matte: 4 x 3 is not the size of the picture, 64 x 48"),
        ([None, None], None, None, r"layers\[0\].matte: missing \(only the last layer needs none\)"),
        ([None], [np.zeros((3, 4, 4), np.float32)], None, r"layers\[0\].fill: 4 x 3 is not the size of the picture"),
        ([None], None, [-1.0], r"layers\[0\].feather: -1 is not between 0 and 1000 \(px\)"),
        ([None], [PUSH_PULL, PUSH_PULL], None, "mattes, fills, feathers: not one of each"),
    ],
)
def test_what_does_not_fit_is_refused(mattes, fills, feathers, sentence):
    with pytest.raises(ValueError, match=sentence):
        peel(picture(), mattes, fills, feathers)


@pytest.mark.parametrize("part, channels", [(engine.LayerImage, (4,)), (engine.MatteInBox, ())])
def test_a_box_that_is_not_that_of_the_pixels_is_refused(part, channels):
    with pytest.raises(ValueError, match="box: its size is not that of the pixels"):
        part(np.zeros((4, 5, *channels), np.float32), (0, 0, 4, 5))


def test_progress_is_told_and_can_cancel():
    told = []

    def listener(phase, share):
        told.append((phase, share))
        return True

    mattes, fills = [box_matte(5, 20, 8, 30), None], [PUSH_PULL] * 2
    engine.peel(picture(), mattes, fills, [0.0, 0.0], progress=listener)
    assert told[0] == ("cutting the layers", 0.0) and told[-1] == ("cutting the layers", 1.0)
    with pytest.raises(engine.Cancelled, match="cancelled"):
        engine.peel(picture(), mattes, fills, [0.0, 0.0], progress=lambda phase, share: False)
