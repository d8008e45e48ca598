"""The figures tell good fillings from bad ones."""

import numpy as np
from fill_figures import figures_of
from scipy.ndimage import gaussian_filter

RNG = np.random.default_rng(2)
TRUTH = np.stack([gaussian_filter(RNG.random((110, 180)), 1.5) for _ in range(3)], axis=2)
TRUTH = ((TRUTH - TRUTH.min()) / np.ptp(TRUTH)).astype(np.float32)
HOLE = np.zeros((110, 180), bool)
HOLE[25:85, 55:115] = True


def filled(values):
    picture = TRUTH.copy()
    picture[HOLE] = values
    return picture


COPY = filled(np.roll(TRUTH, 62, axis=1)[HOLE])
FLAT = filled(TRUTH[~HOLE].mean(axis=0))
NOISE = filled(RNG.random((HOLE.sum(), 3)))
TILED = filled(np.tile(TRUTH[5:17, 5:17], (16, 26, 1))[:110, :180][HOLE])


def test_a_copy_is_coherent_but_at_its_edge():
    assert figures_of(COPY, HOLE).coherence < 0.4 * figures_of(NOISE, HOLE).coherence


def test_a_flat_filling_and_one_of_tiles_repeat():
    repeated = [figures_of(picture, HOLE).repetition for picture in (FLAT, TILED)]
    assert min(repeated) > 2 * figures_of(COPY, HOLE).repetition


def test_the_error_is_that_to_the_truth():
    assert figures_of(TRUTH, HOLE, TRUTH).error < 0.002
    assert np.isclose(figures_of(FLAT, HOLE, TRUTH).error, TRUTH[HOLE].std(axis=0).mean(), rtol=0.15)
    assert np.isnan(figures_of(FLAT, HOLE).error)
