"""Scattered values interpolated by phi(r) = r: scipy's numbers, a subset near them, the picture filled."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import RBFInterpolator
from stillwater import _stillwater as engine

SIZE = (320, 200)


def scattered(count, seed, size=SIZE):
    """Pixel centres, no two the same."""
    rng = np.random.default_rng(seed)
    pixels = rng.choice(size[0] * size[1], count, replace=False)
    return np.stack([pixels % size[0], pixels // size[0]], axis=1) + 0.5


def curves(size=SIZE):
    """What a dozen strokes that partly cross give: points along them, three abreast, with their direction."""
    rng = np.random.default_rng(2)
    strokes = []
    for _ in range(12):
        at, turn, bend = rng.uniform([20, 20], [300, 180]), rng.uniform(-1, 1), rng.uniform(-0.02, 0.02)
        points = []
        for _ in range(40):
            points.append([*at, 1])
            at, turn = at + 4 * np.array([np.cos(turn), np.sin(turn)]), turn + 4 * bend
        strokes.append(engine.FlowStroke(points=points, width=10))
    return map(np.array, engine.stroke_pixels(strokes, size, True))


@settings(max_examples=25, deadline=None)
@given(st.integers(1, 60), st.integers(1, 2), st.integers(0, 10**6))
def test_all_places_as_centres_is_scipy_s(count, columns, seed):
    places = scattered(count, seed)
    values = np.random.default_rng(seed).standard_normal((count, columns))
    ours = engine.RadialInterpolation(places, values)
    elsewhere = np.random.default_rng(seed + 1).uniform(-100, 400, (40, 2))
    expected = RBFInterpolator(places, values, kernel="linear")(elsewhere)
    assert ours.centres == count
    assert np.abs(np.array(ours.at(elsewhere)) - expected).max() < 1e-9
    assert np.abs(np.array(ours.at(places)) - values).max() < 1e-9


@pytest.mark.parametrize("tolerance", [0.02, 0.05, 0.1])
def test_a_subset_meets_all_places_and_is_near_the_dense_solution(tolerance):
    places, values = curves()
    ours = engine.RadialInterpolation(places, values, tolerance)
    assert 96 < ours.centres < 0.85 * len(places)
    misses = np.linalg.norm(np.array(ours.at(places)) - values, axis=1)
    assert misses.max() <= tolerance * 1.002
    elsewhere = np.random.default_rng(4).uniform([0, 0], SIZE, (2000, 2))
    apart = np.linalg.norm(np.array(ours.at(elsewhere)) - RBFInterpolator(places, values, kernel="linear")(elsewhere), axis=1)
    assert apart.max() < 2 * tolerance and apart.mean() < tolerance / 2


def test_fewer_centres_than_needed_go_where_most_is_missed():
    places, values = curves()

    def missed(most):
        ours = engine.RadialInterpolation(places, values, 0.01, most)
        assert ours.centres == most
        return np.linalg.norm(np.array(ours.at(places)) - values, axis=1)

    few, more = missed(120), missed(400)
    assert more.max() < few.max() and more.mean() < few.mean() / 2


def test_equal_values_need_no_more_than_the_first_centres():
    places = scattered(500, 3)
    ours = engine.RadialInterpolation(places, np.full((500, 1), 2.5), 0.01)
    assert ours.centres == 96
    assert np.abs(np.array(ours.at([[0, 0], [1000, -50]])) - 2.5).max() < 1e-9


@pytest.mark.parametrize("columns", [1, 2])
@pytest.mark.parametrize("size", [(320, 200), (317, 195), (90, 31)])
def test_the_filled_picture_is_the_interpolation_at_its_pixels(columns, size):
    places, values = curves(size)
    values = values[:, :columns]
    ours = engine.RadialInterpolation(places, values, 0.02)
    filled = ours.fill(size).reshape(-1, columns)
    x, y = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    exact = np.array(ours.at(np.stack([x.ravel(), y.ravel()], axis=1)))
    apart = np.linalg.norm(filled - exact, axis=1)
    assert apart.max() < 2 / 100 and apart.mean() < 2 / 1500
    at_centres = filled[(places[:, 1].astype(int) * size[0] + places[:, 0].astype(int))]
    assert np.abs(at_centres - np.array(ours.at(places))).max() < 2 / 100
