"""A layer whose outline is given for each moment: only what is covered changes."""

import numpy as np
import pytest
from stillwater import _stillwater as engine

SIZE = (48, 40)
BOX = (8, 6, 32, 24)


def opaque():
    pixels = np.random.default_rng(1).uniform(0.1, 1, (BOX[3], BOX[2], 4)).astype(np.float32)
    pixels[..., 3] = 1
    return pixels


def outlines(count=3):
    return np.random.default_rng(2).integers(0, 256, (count, BOX[3], BOX[2]), np.uint8)


def renderer(given, pixels=None, scale=1.0, alpha=None):
    image = engine.LayerImage(opaque() if pixels is None else pixels, BOX)
    plates = engine.make_plates(image, alpha, SIZE, scale, None, outlines=given)
    view, wind = engine.View(horizon=None, fov=50, height=1.7), engine.Wind()
    return engine.FrameRenderer(SIZE, scale, view, wind, [engine.Layer(plates, None)], has_alpha=alpha is not None)


def frame(given, outline, **setup):
    state = [engine.LayerState(1.0, None, outline)]
    return renderer(given, **setup).render(engine.Moment(), engine.Moment(), state, state, layers=True)


@pytest.mark.parametrize("spans", [[3], [2, 1], [1, 1, 1]])
def test_each_moment_has_its_own_coverage(spans):
    every = outlines()
    ends = np.cumsum(spans)
    given = [every[end - count : end] for count, end in zip(spans, ends, strict=True)]
    for moment in range(3):
        found = frame(given, moment).combined[6:30, 8:40]
        coverage = every[moment][..., None] / np.float32(255)
        assert np.abs(found - opaque() * coverage).max() < 1e-6


def test_beside_the_layer_nothing_is_covered():
    found = frame([np.full((1, BOX[3], BOX[2]), 255, np.uint8)], 0).combined
    found[6:30, 8:40] = 0
    assert not found.any()


def test_the_layer_alone_has_it_too():
    found = frame([outlines()], 1)
    assert np.array_equal(found.layers[0], found.combined)


def test_twice_as_large_it_lies_between():
    ramp = np.broadcast_to(np.arange(BOX[2], dtype=np.uint8) * 8, (1, BOX[3], BOX[2])).copy()
    found = frame([ramp], 0, pixels=np.ones((BOX[3], BOX[2], 4), np.float32), scale=2.0).combined[30, 18:78, 3]
    expected = (np.arange(60) / 2 + 0.25) * 8 / 255 + 0.25 * 8 / 255
    assert np.abs(found - expected).max() < 0.01


def test_the_picture_s_own_alpha_has_the_same_outline():
    grey = np.ones((BOX[3], BOX[2], 4), np.float32)
    grey[..., :3] = 0.5
    found = frame([outlines()], 2, alpha=engine.LayerImage(grey, BOX)).combined[6:30, 8:40, 3]
    assert np.abs(found - 0.5 * outlines()[2] / np.float32(255)).max() < 1e-6


def test_any_number_of_threads():
    first = frame([outlines()], 1).combined
    engine.set_threads(3)
    again = frame([outlines()], 1).combined
    engine.set_threads(0)
    assert np.array_equal(first, again)


@pytest.mark.parametrize(
    ("given", "outline", "sentence"),
    [
        ([outlines()], 3, "outline: 3 is not between 0 and 2"),
        ([outlines()], -1, "outline: -1 is not between 0 and 2"),
        ([outlines()[:, 1:]], 0, "outlines: made for another layer or scale"),
        ([outlines()[0]], 0, "outlines: not arrays of moments x height x width"),
    ],
)
def test_what_is_refused(given, outline, sentence):
    with pytest.raises(engine.BadInput, match=sentence):
        frame(given, outline)
