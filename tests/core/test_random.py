"""Counter-based random numbers: a number depends on its seed and place alone, and is drawn from the right law."""

import numpy as np
from scipy import stats
from stillwater import _stillwater as engine

PLACES = [(a, b, c) for a in range(-8, 12) for b in range(-8, 12) for c in range(5)]


def test_a_place_gives_the_same_number_in_any_order():
    forwards = [engine.random_uniform(7, *place) for place in PLACES]
    backwards = [engine.random_uniform(7, *place) for place in reversed(PLACES)]
    assert forwards == backwards[::-1]


def test_seeds_and_places_are_independent():
    drawn = {engine.random_uniform(seed, *place) for seed in range(4) for place in PLACES}
    assert len(drawn) == 4 * len(PLACES)


def test_uniform_numbers_are_uniform():
    drawn = [engine.random_uniform(3, *place) for place in PLACES]
    assert 0 <= min(drawn) and max(drawn) < 1
    assert stats.kstest(drawn, "uniform").pvalue > 0.01


def test_neighbouring_places_do_not_correlate():
    drawn = np.array([engine.random_uniform(1, i) for i in range(20_000)]) - 0.5
    for lag in (1, 2, 16, 256):
        assert abs(np.mean(drawn[lag:] * drawn[:-lag]) / drawn.var()) < 4 / np.sqrt(len(drawn))


def test_gaussian_numbers_are_gaussian_in_both_parts():
    drawn = np.array([engine.random_gaussian(5, *place) for place in PLACES])
    assert stats.kstest(drawn.real, "norm").pvalue > 0.01
    assert stats.kstest(drawn.imag, "norm").pvalue > 0.01
    assert abs(np.corrcoef(drawn.real, drawn.imag)[0, 1]) < 4 / np.sqrt(len(drawn))
