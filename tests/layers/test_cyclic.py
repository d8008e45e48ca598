"""An endless layer: the picture itself, and a strip that leads from its end to its beginning."""

import numpy as np
from stillwater import _stillwater as engine

RNG = np.random.default_rng(4)
SMOOTH = np.cumsum(np.cumsum(RNG.normal(0, 1, (41, 60, 4)), 0), 1).astype(np.float32)
SMOOTH /= np.abs(SMOOTH).max()


def step(a, b):
    return np.abs(a - b).max()


def test_the_picture_itself_is_kept():
    whole = engine.make_cyclic(SMOOTH, True, True)
    assert whole.shape == (41 + 11, 60 + 15, 4)
    assert np.array_equal(whole[:41, :60], SMOOTH)


def test_both_ends_of_the_strip_go_on_without_a_step():
    whole = engine.make_cyclic(SMOOTH, True, False)
    inner = max(step(SMOOTH[:, i], SMOOTH[:, i + 1]) for i in range(59))
    assert step(whole[:, 59], whole[:, 60]) < 2 * inner
    assert step(whole[:, -1], whole[:, 0]) < 2 * inner


def test_along_y_is_along_x_turned():
    turned = engine.make_cyclic(np.ascontiguousarray(SMOOTH.transpose(1, 0, 2)), False, True)
    assert np.array_equal(turned.transpose(1, 0, 2), engine.make_cyclic(SMOOTH, True, False))


def test_neither_axis_changes_nothing():
    assert np.array_equal(engine.make_cyclic(SMOOTH, False, False), SMOOTH)


def test_one_pixel():
    assert engine.make_cyclic(SMOOTH[:1, :1], True, True).shape == (2, 2, 4)


def test_the_strip_keeps_the_contrast_of_the_picture():
    """Two mirror images laid over each other would have 0.7 of it, and show."""
    noise = RNG.normal(0.5, 0.1, (40, 256, 4)).astype(np.float32)
    strip = engine.make_cyclic(noise, True, False)[:, 256:]
    assert strip[:, 16:-16].std() > 0.95 * noise.std()
    assert strip[:, :16].std() > 0.7 * noise.std()


def test_the_tone_of_the_strip_leads_from_the_end_to_the_beginning():
    ramp = np.linspace(0.2, 0.8, 240, dtype=np.float32)[None, :, None].repeat(20, 0).repeat(4, 2)
    means = engine.make_cyclic(ramp, True, False)[:, 240:].mean(axis=(0, 2))
    assert np.all(np.diff(means[15:-15]) < 0)
    assert means.max() < 0.81 and means.min() > 0.19
