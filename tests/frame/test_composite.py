"""Layers of any place and width laid over each other, against the same by the definition."""

import numpy as np
import pytest
from stillwater import _stillwater as engine

RNG = np.random.default_rng(4)
VIEW, WIND = engine.View(horizon=((0, 20), (10, 20))), engine.Wind()


def layer(size, box, coverage):
    """Noise, premultiplied; with two clear pixels on the sides that are not the picture's, as peel() gives layers."""
    x, y, width, height = box
    left, top, right, bottom = max(0, x - 2), max(0, y - 2), min(size[0], x + width + 2), min(size[1], y + height + 2)
    alpha = np.zeros((bottom - top, right - left, 1))
    alpha[y - top : y - top + height, x - left : x - left + width] = coverage
    colour = RNG.random((*alpha.shape[:2], 3))
    pixels = np.concatenate([colour * alpha, alpha], axis=2).astype(np.float32)
    return engine.LayerImage(pixels, (left, top, right - left, bottom - top))


def composed(size, layers, moving):
    """`moving`: which layers count as such in the matte; all of them are at rest."""
    setups = [engine.Layer(image, motion=engine.Drift() if moves else None, endless=(False, False))
              for image, moves in zip(layers, moving, strict=True)]
    renderer = engine.FrameRenderer(size, 1.0, VIEW, WIND, setups)
    states = [engine.LayerState(1.0, engine.Drift() if moves else None) for moves in moving]
    moment = engine.Moment(frame=1, fps=24, wind=WIND)
    return renderer.render(moment, moment, states, states)


def by_definition(size, layers, moving):
    width, height = size
    whole, matte, through = np.zeros((height, width, 4)), np.zeros((height, width)), np.ones((height, width, 1))
    for image, moves in zip(layers, moving, strict=True):
        x, y, w, h = image.box
        front = np.zeros((height, width, 4))
        front[y : y + h, x : x + w] = image.pixels
        whole += through * front
        matte += moves * (through * front[..., 3:])[..., 0]
        through = through * (1 - front[..., 3:])
    return whole, matte


@pytest.mark.parametrize("width, height", [(1, 1), (3, 2), (64, 64), (67, 5), (130, 70)])
def test_against_the_definition(width, height):
    for _ in range(5):
        layers, moving = [], [True, False, True, False]
        for _ in moving:
            x, y = RNG.integers(0, width), RNG.integers(0, height)
            w, h = RNG.integers(1, width - x + 1), RNG.integers(1, height - y + 1)
            layers.append(layer((width, height), tuple(map(int, (x, y, w, h))), RNG.choice([0.0, 0.4, 1.0], (h, w, 1))))
        frame, (whole, matte) = composed((width, height), layers, moving), by_definition((width, height), layers, moving)
        assert np.allclose(frame.combined, whole, atol=2e-6)
        assert np.allclose(frame.matte, matte, atol=2e-6)


def test_what_is_hidden_to_a_ten_thousandth_is_not_drawn():
    front, back = layer((9, 1), (0, 0, 9, 1), 0.99995), layer((9, 1), (0, 0, 9, 1), 1.0)
    frame = composed((9, 1), [front, back], [True, False])
    assert np.array_equal(frame.combined[..., 3], front.pixels[..., 3])
