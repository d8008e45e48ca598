"""Colours go on beyond a layer's outline: mirrored, so that their texture goes on, and opaque."""

import numpy as np
import pytest
from stillwater import _stillwater as engine


def layer(alpha):
    image = np.random.default_rng(2).random((24, 40, 4), np.float32)
    image[..., 3] = 1
    return image * alpha[..., None].astype(np.float32), image


def test_what_is_covered_keeps_its_straight_colour():
    alpha = np.full((24, 40), 0.8, np.float32)
    premultiplied, straight = layer(alpha)
    np.testing.assert_allclose(engine.extend_colours(premultiplied), straight, atol=1e-6)


def test_beyond_a_straight_outline_it_is_mirrored():
    alpha = np.zeros((24, 40), np.float32)
    alpha[:, :20] = 1
    premultiplied, straight = layer(alpha)
    extended = engine.extend_colours(premultiplied)
    np.testing.assert_array_equal(extended[:, 20:39], straight[:, 18:None:-1][:, :19])
    assert (extended[..., 3] > 0.999).all()


def test_nothing_has_no_colours():
    with pytest.raises(ValueError, match="layer: covers nothing"):
        engine.extend_colours(np.zeros((4, 4, 4)))
