"""Mattes from a trimap: what is known stays, the rest lies between, and bad input is a sentence."""

import numpy as np
import pytest
import stillwater
from stillwater import _stillwater as engine


def scene(height=60, width=80, seed=4):
    """A disc with a soft edge over another texture: picture, true alpha, trimap."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[:height, :width]
    radius = np.hypot(y - height / 2, x - width / 2)
    alpha = np.clip((height / 3 - radius) / 8 + 0.5, 0, 1).astype(np.float32)
    front = [0.9, 0.6, 0.2] + 0.05 * rng.standard_normal((height, width, 3))
    back = [0.1, 0.3, 0.5] + 0.05 * rng.standard_normal((height, width, 3))
    picture = np.clip(alpha[..., None] * front + (1 - alpha[..., None]) * back, 0, 1).astype(np.float32)
    trimap = np.where(radius < height / 3 - 7, 1, np.where(radius > height / 3 + 7, 0, 0.5)).astype(np.float32)
    return picture, alpha, trimap


def test_it_is_near_the_truth():
    picture, truth, trimap = scene()
    alpha = stillwater.matte(picture, trimap)
    assert np.abs(alpha - truth)[trimap == 0.5].mean() < 0.04


def test_what_is_known_stays_and_all_is_within_0_and_1():
    picture, _, trimap = scene()
    alpha = stillwater.matte(picture, trimap)
    assert np.array_equal(alpha[trimap != 0.5], trimap[trimap != 0.5])
    assert alpha.min() >= 0 and alpha.max() <= 1 and alpha.dtype == np.float32


def islands(height=80, width=110, seed=4):
    """Islands of a patchwork of foreground colours in one of background colours, which no scribble touches."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[:height, :width]
    alpha = np.clip((np.sin(y / 2.5) * np.sin(x / 2.5) - 0.2) * 4 + 0.5, 0, 1) * (abs(x - 55) < 25)
    alpha[:, :30] = 1

    def patchwork(*colours):
        squares = np.array(colours)[rng.integers(0, 3, (height // 4 + 1, width // 4 + 1))]
        return squares.repeat(4, axis=0).repeat(4, axis=1)[:height, :width]

    front = patchwork([0.9, 0.6, 0.2], [0.5, 0.2, 0.1], [0.9, 0.9, 0.6])
    back = patchwork([0.1, 0.3, 0.7], [0.1, 0.6, 0.6], [0.3, 0.1, 0.5])
    picture = alpha[..., None] * front + (1 - alpha[..., None]) * back + rng.normal(0, 0.01, front.shape)
    trimap = np.where(x < 30, 1, np.where(x < 80, 0.5, 0)).astype(np.float32)
    return np.dstack([picture, np.ones((height, width))]).astype(np.float32), alpha, trimap


def test_colour_decides_what_the_laplacian_leaves_open():
    picture, truth, trimap = islands()
    told, plain = engine.MatteOptions(), engine.MatteOptions()
    plain.colour = 0
    error, plain_error = (np.abs(engine.matte(picture, trimap, options) - truth).mean() for options in (told, plain))
    assert error < 0.6 * plain_error


def test_haze_is_taken_off():
    picture, _, trimap = scene()
    rgba = np.dstack([picture, np.ones(trimap.shape, np.float32)])
    with_haze, without = engine.MatteOptions(), engine.MatteOptions()
    with_haze.haze, without.haze = 0, 0.02
    soft, clear = engine.matte(rgba, trimap, with_haze), engine.matte(rgba, trimap, without)
    assert np.allclose(clear, np.clip((soft - 0.02) / 0.96, 0, 1), atol=1e-6)


@pytest.mark.parametrize("value", [0.0, 1.0])
def test_nothing_unknown_is_the_hard_matte(value):
    trimap = np.full((20, 30), value, np.float32)
    trimap[5:9, 5:9] = 1
    assert np.array_equal(stillwater.matte(np.random.default_rng(0).random((20, 30, 3)), trimap), trimap)


@pytest.mark.parametrize("shape", [(1, 40), (40, 1), (2, 40), (40, 2), (1, 3), (3, 1)])
def test_pictures_of_one_or_two_pixels_width(shape):
    trimap = np.full(shape, 0.5, np.float32)
    trimap.flat[0], trimap.flat[-1] = 1, 0
    picture = np.linspace(0.9, 0.1, trimap.size).reshape(shape)[..., None].repeat(3, axis=2)
    alpha = stillwater.matte(picture, trimap)
    assert alpha.shape == shape and alpha.flat[0] == 1 and alpha.flat[-1] == 0
    assert alpha.min() >= 0 and alpha.max() <= 1


def test_unknown_pixels_that_touch_one_kind_only_belong_to_it():
    picture, _, trimap = scene()
    trimap[:] = 0
    trimap[:30] = 1
    trimap[5:10, 5:10] = 0.5
    alpha = stillwater.matte(picture, trimap)
    assert np.all(alpha[:30] > 0.99)


def test_alpha_of_the_picture_is_not_read():
    picture, _, trimap = scene()
    opaque = np.dstack([picture, np.ones(trimap.shape, np.float32)])
    assert np.array_equal(stillwater.matte(picture, trimap), stillwater.matte(opaque, trimap))


def test_the_same_bytes_for_any_number_of_threads():
    picture, _, trimap = scene(90, 120)
    alphas = []
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        alphas.append(stillwater.matte(picture, trimap))
    engine.set_threads(0)
    assert np.array_equal(alphas[0], alphas[1]) and np.array_equal(alphas[0], alphas[2])


def changed(array, place, value):
    array = array.copy()
    array[place] = value
    return array


@pytest.mark.parametrize(
    "change, sentence",
    [
        (lambda p, t: (p, t * 0 + 0.5), r"trimap: all of it is unknown \(some pixels must be foreground, and some background\)"),
        (lambda p, t: (p, np.minimum(t, 0.5)), r"trimap: no pixel is foreground \(some must be\)"),
        (lambda p, t: (p, np.maximum(t, 0.5)), r"trimap: no pixel is background \(some must be\)"),
        (lambda p, t: (p, t[:, 1:]), r"trimap: 79 x 60 is not the size of the picture, 80 x 60"),
        (lambda p, t: (p, changed(t, (3, 7), 1.5)), r"trimap\[3, 7\]: 1.5 is not between 0 and 1"),
        (lambda p, t: (p, changed(t, (3, 7), np.nan)), r"trimap\[3, 7\]: -?nan is not between 0 and 1"),
        (lambda p, t: (changed(p, (2, 5), np.nan), t), r"picture\[2, 5\]: -?nan is not a finite number"),
        (lambda p, t: (p[..., :2], t), r"picture|image: an array of 60 x 80 x 2 is not height x width x 3 or 4"),
        (lambda p, t: (p, t[0]), r"trimap: an array of 80 is not height x width"),
    ],
)
def test_what_does_not_fit_is_a_sentence(change, sentence):
    picture, _, trimap = scene()
    with pytest.raises(ValueError, match=sentence):
        stillwater.matte(*change(picture, trimap))


def test_an_unknown_method():
    with pytest.raises(ValueError, match="method: 'magic' is not one of closed-form, bayesian"):
        stillwater.matte(*scene()[::2], "magic")


@pytest.mark.parametrize("option, value, allowed", [("colour", -1, "0 and 1e"), ("haze", 0.6, "0 and 0.49"), ("tolerance", 0, "1e-12 and 1")])
def test_options_out_of_range(option, value, allowed):
    picture, _, trimap = scene()
    options = engine.MatteOptions()
    setattr(options, option, value)
    with pytest.raises(ValueError, match=f"{option}: {value} is not between {allowed}"):
        engine.matte(np.dstack([picture, trimap]), trimap, options)


def test_progress_is_told_and_can_cancel():
    told = []
    stillwater.matte(*scene()[::2], progress=lambda phase, share: told.append((phase, share)) or True)
    shares = [share for _, share in told]
    assert shares == sorted(shares) and shares[-1] == 1.0
    assert {phase for phase, _ in told} == {"solving the matte"}
    for last in (0.0, 0.3):
        with pytest.raises(stillwater.Cancelled):
            stillwater.matte(*scene()[::2], progress=lambda phase, share, last=last: share < last)
