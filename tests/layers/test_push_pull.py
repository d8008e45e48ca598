"""Push-pull filling: what is known stays, what is not is filled smoothly from around it."""

import numpy as np
import pytest
from stillwater import _stillwater as engine


def known(colour, mask):
    return np.concatenate([colour * mask[..., None], mask[..., None]], axis=2).astype(np.float32)


def ramp(height, width):
    y, x = np.mgrid[:height, :width]
    return np.stack([x / width, y / height, np.full_like(x, 0.5, float)], axis=2)


HOLE = np.ones((60, 83))
HOLE[20:40, 25:60] = 0


def test_what_is_known_stays():
    filled = engine.push_pull(known(ramp(60, 83), HOLE))
    assert np.allclose(filled[HOLE == 1][:, :3], ramp(60, 83)[HOLE == 1], atol=1e-6)
    assert np.allclose(filled[..., 3], 1, atol=1e-5)


def test_one_colour_is_filled_with_itself():
    filled = engine.push_pull(known(np.full((60, 83, 3), 0.3), HOLE))
    assert np.allclose(filled[..., :3], 0.3, atol=1e-5)


def test_a_ramp_goes_on_through_the_hole():
    filled = engine.push_pull(known(ramp(60, 83), HOLE))
    assert np.abs(filled[..., :3] - ramp(60, 83)).max() < 0.2
    assert np.all(filled >= -1e-6) and np.all(filled <= 1 + 1e-5)


@pytest.mark.parametrize("shape", [(1, 1), (1, 17), (17, 1), (2, 2), (3, 5)])
def test_small_pictures(shape):
    mask = np.zeros(shape)
    mask[0, 0] = 1
    filled = engine.push_pull(known(np.full((*shape, 3), 0.7), mask))
    assert np.allclose(filled[..., :3], 0.7, atol=1e-5)


def test_nothing_known_is_refused():
    with pytest.raises(ValueError, match="known: nothing is known"):
        engine.push_pull(np.zeros((5, 5, 4), np.float32))
