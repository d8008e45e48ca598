"""Mattes solved on half the picture first, and enlarged."""

import numpy as np
import pytest
import scipy.ndimage
from stillwater import _stillwater as engine


def scene(height=121, width=158, seed=4):
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[:height, :width]
    radius = np.hypot(y - height / 2, x - width / 2)
    alpha = np.clip((40 - radius) / 8 + 0.5, 0, 1)
    texture = [scipy.ndimage.gaussian_filter(rng.standard_normal((height, width)), 2) for _ in range(6)]
    front = [0.8, 0.6, 0.2] + 0.3 * np.stack(texture[:3], axis=2)
    back = [0.2, 0.3, 0.5] + 0.3 * np.stack(texture[3:], axis=2)
    picture = alpha[..., None] * front + (1 - alpha[..., None]) * back
    trimap = np.full((height, width), 0.5, np.float32)
    trimap[radius < 12], trimap[radius > 70] = 1, 0
    return np.dstack([picture, np.ones((height, width))]).astype(np.float32), alpha.astype(np.float32), trimap


def matte(picture, trimap, **changes):
    options = engine.MatteOptions()
    for name, value in changes.items():
        setattr(options, name, value)
    return engine.matte(picture, trimap, options)


def test_coarse_to_fine_comes_near_to_all_at_once():
    picture, truth, trimap = scene()
    at_once, stepwise = matte(picture, trimap), matte(picture, trimap, at_once=1000)
    assert not np.array_equal(at_once, stepwise)
    assert np.abs(at_once - stepwise).sum() < 0.05 * truth.sum()
    assert np.abs(stepwise - truth).sum() < 0.05 * truth.sum()


@pytest.mark.parametrize("finest", [2, 4, 8])
def test_a_preview_comes_near_too(finest):
    picture, _, trimap = scene()
    final, preview = matte(picture, trimap), matte(picture, trimap, finest=finest)
    assert 0 < np.abs(final - preview).sum() < (0.02 if finest == 2 else 0.06) * final.sum()
    assert np.array_equal(preview[trimap != 0.5], trimap[trimap != 0.5])
    assert preview.min() >= 0 and preview.max() <= 1


def test_previews_are_for_powers_of_two():
    picture, _, trimap = scene()
    with pytest.raises(ValueError, match="finest: 3 is not a power of two between 1 and 8"):
        matte(picture, trimap, finest=3)
    with pytest.raises(ValueError, match=r"at_once: 0 is not between 1 and 1e\+09"):
        matte(picture, trimap, at_once=0)


def test_small_pictures_are_solved_at_once():
    picture, _, trimap = scene()
    small = np.s_[50:55, :90]
    assert np.array_equal(matte(picture[small], trimap[small], finest=8), matte(picture[small], trimap[small]))


@pytest.mark.parametrize("shape", [(6, 8), (7, 9)])
def test_half_a_picture_holds_means(shape):
    picture = np.random.default_rng(1).random((*shape, 4)).astype(np.float32)
    even = np.pad(picture, ((0, shape[0] % 2), (0, shape[1] % 2), (0, 0)), mode="edge")
    means = (even[::2, ::2] + even[::2, 1::2] + even[1::2, ::2] + even[1::2, 1::2]) / 4
    assert np.allclose(engine.half_of(picture), means, atol=1e-6)


def test_half_a_trimap_keeps_thin_scribbles():
    trimap = np.full((5, 6), 0.5, np.float32)
    trimap[0, 0], trimap[3, 4], trimap[2, 0], trimap[3, 1] = 1, 0, 1, 0
    expected = np.full((3, 3), 0.5)
    expected[0, 0], expected[1, 2] = 1, 0  # and where both are, nothing is known
    assert np.array_equal(engine.half_of_trimap(trimap), expected)


def test_a_matte_that_follows_colour_is_enlarged_with_the_colours_detail():
    rng = np.random.default_rng(5)
    picture = np.dstack([scipy.ndimage.gaussian_filter(rng.random((40, 50)), 1)] * 3 + [np.ones((40, 50))]).astype(np.float32)
    half = engine.half_of(picture)
    enlarged = engine.enlarge_matte(1.2 * half[..., 0] - 0.1, half, picture)
    assert np.abs(enlarged - (1.2 * picture[..., 0] - 0.1)).max() < 0.02
