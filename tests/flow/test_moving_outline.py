"""An outline carried by what it encloses: its area, what it keeps, where it goes."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter, map_coordinates
from scipy.optimize import brentq
from stillwater import _stillwater as engine

HEIGHT, WIDTH = 90, 120


def disc(centre, radius=20.0, soft=2.0):
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    return np.clip((radius - np.hypot(x - centre[0], y - centre[1])) / soft + 0.5, 0, 1).astype(np.float32)


def swirls(size=2.0):
    noise = np.random.default_rng(2).normal(size=(HEIGHT, WIDTH, 2))
    field = gaussian_filter(noise, (6, 6, 0))
    return (size * field / np.abs(field).max()).astype(np.float32)


def everywhere(x, y):
    return np.full((HEIGHT, WIDTH, 2), (x, y), np.float32)


def expected(outline, matte, motion, persistence):
    """The formula, with scipy."""
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    before = map_coordinates(outline, [y - motion[..., 1], x - motion[..., 0]], order=1, mode="nearest")
    mixed = np.clip(persistence * before + (1 - persistence) * matte, 0, 1).astype(np.float64)
    gamma = brentq(lambda gamma: (mixed**gamma).sum() - matte.sum(), 1 / 16, 16, xtol=1e-9)
    return mixed**gamma


@pytest.mark.parametrize("persistence", [0.3, 0.9, 0.97])
def test_a_step_is_the_formula(persistence):
    matte, outline, motion = disc((60, 50)), disc((57, 46)), swirls(5)
    found = engine.moved_outline(outline, matte, motion, persistence)
    assert np.abs(found - expected(outline, matte, motion, persistence)).max() < 2e-4


def test_the_area_is_kept_over_a_hundred_steps():
    matte = disc((60, 50))
    outline, motion = matte, swirls(3) + everywhere(0.5, -1)
    for _ in range(100):
        outline = engine.moved_outline(outline, matte, motion, 0.9)
        assert abs(outline.sum() / matte.sum() - 1) < 1e-3
    assert np.abs(outline - matte).max() > 0.5


@pytest.mark.parametrize(("motion", "persistence"), [(everywhere(0, 0), 0.9), (swirls(), 0)], ids=["nothing moves", "nothing lasts"])
def test_the_outline_is_the_matte_where(motion, persistence):
    matte = disc((60, 50))
    assert np.abs(engine.moved_outline(matte, matte, motion, persistence) - matte).max() < 1e-4


def test_what_lasts_for_ever_goes_with_the_motion():
    matte = disc((40, 50))
    outline = matte
    for _ in range(12):
        outline = engine.moved_outline(outline, matte, everywhere(3, -1), 1.0)
    assert np.abs(outline - disc((76, 38))).mean() < 0.002


def test_it_forgets_how_it_began():
    matte, motion = disc((60, 50)), swirls(3)
    one, other = matte, disc((50, 40), 25)
    for _ in range(106):
        one, other = (engine.moved_outline(each, matte, motion, 0.9) for each in (one, other))
    assert np.abs(one - other).max() < 2 / 255


def test_covered_and_clear_stay_so():
    matte = disc((60, 50))
    found = engine.moved_outline(matte, matte, everywhere(1, 0), 0.9)
    assert found[50, 60] == 1 and found[5, 5] == 0 and found.min() >= 0 and found.max() <= 1
    for level in (0.0, 1.0):
        plain = np.full((HEIGHT, WIDTH), level, np.float32)
        assert (engine.moved_outline(plain, plain, swirls(), 0.9) == level).all()


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_any_number_of_threads(threads):
    matte, motion = disc((60, 50)), swirls(4)
    first = engine.moved_outline(matte, matte, motion, 0.9)
    engine.set_threads(threads)
    again = engine.moved_outline(matte, matte, motion, 0.9)
    engine.set_threads(0)
    assert np.array_equal(first, again)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"outline": disc((0, 0))[:-1]}, "matte: 120 x 90 is not the size of outline, 120 x 89"),
        ({"motion": swirls()[:, 1:]}, "motion: 119 x 90 is not the size of outline, 120 x 90"),
        ({"matte": 2 * disc((60, 50))}, r"matte\[31, 54\]: 1.07514 is not between 0 and 1"),
        ({"outline": disc((60, 50)) - 0.5}, r"outline\[0, 0\]: -0.5 is not between 0 and 1"),
        ({"motion": np.full((HEIGHT, WIDTH, 2), np.nan, np.float32)}, "motion: not finite everywhere"),
        ({"persistence": 1.5}, "persistence: 1.5 is not between 0 and 1"),
    ],
)
def test_what_is_refused(change, sentence):
    right = {"outline": disc((60, 50)), "matte": disc((60, 50)), "motion": swirls(), "persistence": 0.9}
    with pytest.raises(engine.BadInput, match=sentence):
        engine.moved_outline(**(right | change))
