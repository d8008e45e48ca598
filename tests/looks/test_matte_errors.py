"""The figures by which mattes are compared."""

import numpy as np
import pytest
from matte_errors import Errors, errors

TRUTH = np.zeros((30, 40))
TRUTH[8:22, 10:30] = 1
EVERYWHERE = np.ones(TRUTH.shape, bool)


def test_the_truth_has_no_error():
    assert errors(TRUTH, TRUTH, EVERYWHERE) == Errors(0, 0, 0, 0)


def test_sad_and_mse_count_unknown_pixels_only():
    found = errors(np.abs(TRUTH - 0.5), TRUTH, TRUTH == 1)
    assert found.sad == pytest.approx(0.5 * (TRUTH == 1).sum() / 1000) and found.mse == pytest.approx(0.25)


def test_gradient_sees_edges_not_levels():
    lighter = errors(TRUTH + 0.2, TRUTH, EVERYWHERE)
    shifted = errors(np.roll(TRUTH, 2, axis=1), TRUTH, EVERYWHERE)
    assert lighter.gradient == pytest.approx(0, abs=1e-9) and shifted.gradient > 0.01


def test_a_loose_island_is_disconnected():
    island, grown = TRUTH.copy(), TRUTH.copy()
    island[2:5, 35:38] = 1
    grown[8:11, 30:33] = 0.1  # too little to count
    assert errors(island, TRUTH, EVERYWHERE).connectivity > 0
    assert errors(grown, TRUTH, EVERYWHERE).connectivity == 0


def test_errors_add_up():
    assert Errors(1, 2, 3, 4) + Errors(1, 1, 1, 1) == Errors(2, 3, 4, 5)
