"""Histograms matched: exactly the reference's values, monotone, ties alike, as the published formula says."""

import numpy as np
import pytest
import stillwater
from hypothesis import given, settings
from hypothesis import strategies as st
from stillwater.appearance import describe_histogram


def noise(shape, seed=0):
    return np.random.default_rng(seed).standard_normal(shape).astype(np.float32)


def by_formula(plane, reference):
    """scikit-image's: quantiles of unique values, interpolated; with the middle rank of equal values instead of the highest."""
    _, inverse, counts = np.unique(plane.ravel(), return_inverse=True, return_counts=True)
    values, wanted = np.unique(reference.ravel(), return_counts=True)
    ranks = (np.cumsum(counts) - counts / 2) / plane.size
    wanted_ranks = (np.cumsum(wanted) - wanted / 2) / reference.size
    return np.interp(ranks, wanted_ranks, values)[inverse].reshape(plane.shape)


def test_a_plane_of_the_same_size_gets_exactly_the_values():
    plane, reference = noise((50, 40)), noise((40, 50), 1) ** 3
    expected = np.sort(reference.ravel())[np.argsort(np.argsort(plane.ravel()))].reshape(plane.shape)
    np.testing.assert_array_equal(stillwater.match_histogram(plane, reference), expected)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 1000), st.integers(1, 30), st.integers(1, 30), st.integers(1, 40))
def test_it_is_the_formula(seed, height, width, levels):
    random = np.random.default_rng(seed)
    plane = random.integers(-levels, levels + 1, (height, width)) / 8
    reference = random.integers(0, levels, (width + 3, height)) ** 2 / 16
    np.testing.assert_allclose(stillwater.match_histogram(plane, reference), by_formula(plane, reference), atol=1e-4)


def test_it_is_monotone_and_equals_stay_equal():
    plane, reference = np.round(noise((60, 60)) * 4), noise((30, 80), 2)
    matched = stillwater.match_histogram(plane, reference)
    order = np.argsort(plane.ravel(), kind="stable")
    assert np.all(np.diff(matched.ravel()[order]) >= 0)
    assert all(np.unique(matched[plane == value]).size == 1 for value in np.unique(plane))


def test_a_plane_of_one_value_gets_the_median():
    assert stillwater.match_histogram(np.ones((5, 5)), noise((9, 11))) == pytest.approx(np.median(noise((9, 11))))


def test_minus_zero_is_zero():
    assert np.unique(stillwater.match_histogram([[0.0, -0.0, 1.0]], [[1.0, 2.0, 3.0]])).size == 2


def test_a_few_values_describe_many():
    plane, reference = noise((200, 200)), noise((300, 300), 5)
    kept = describe_histogram(reference, 1024)
    assert len(kept.values) == len(kept.ranks) <= 1024
    exact, near = stillwater.match_histogram(plane, reference), stillwater.match_histogram(plane, kept)
    assert np.abs(exact - near).mean() < 2e-3 and np.ptp(near) == pytest.approx(np.ptp(exact), rel=0.05)


def test_channels_are_matched_each_by_itself():
    plane, reference = noise((20, 30, 3)), noise((10, 50, 3), 1)
    matched = stillwater.match_histogram(plane, reference)
    np.testing.assert_array_equal(matched[..., 1], stillwater.match_histogram(plane[..., 1], reference[..., 1]))


@pytest.mark.parametrize(
    "call, sentence",
    [
        (lambda: stillwater.match_histogram([[np.nan]], [[1.0]]), "plane: nan is not a finite number"),
        (lambda: describe_histogram([[1.0]], 1), "points: 1 is not between 2 and 65536"),
        (lambda: stillwater.match_histogram(noise((4, 4, 3)), noise((4, 4))), r"reference: an array of shape \(4, 4\)"),
    ],
)
def test_what_cannot_be_is_refused(call, sentence):
    with pytest.raises(stillwater.BadInput, match=sentence):
        call()
