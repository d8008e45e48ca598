"""An endless layer by synthesis: the picture stays, and the wrap is not seen."""

import numpy as np
import pytest
import stillwater
from scipy.ndimage import gaussian_filter
from stillwater import _stillwater as engine


def clouds(shape, seed, roughness=1.0):
    """Grey clouds that don't wrap, with some grain."""
    rng = np.random.default_rng(seed)
    noise = rng.normal(size=(shape[0] + 40, shape[1] + 40))
    field = sum(gaussian_filter(noise, sigma) * sigma**1.6 for sigma in (1.5, 3, 6, 12))[20:-20, 20:-20]
    field = 0.5 + 0.12 * field / max(field.std(), 1e-9) + 0.004 * roughness * rng.normal(size=shape)
    return np.repeat(np.clip(field, 0, 1)[..., None], 3, axis=2).astype(np.float32)


def steps(image, axis):
    return np.abs(np.diff(image[..., :3], axis=axis))


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_wrap_is_no_steeper_than_the_inside(seed):
    picture = clouds((60, 160), seed)
    whole = stillwater.make_cyclic(picture)
    limit = np.percentile(steps(picture, 1), 99.9)
    assert np.abs(whole[:, -1] - whole[:, 0]).max() <= limit
    assert np.abs(whole[:, 160] - whole[:, 159]).max() <= limit


def test_both_axes_wrap():
    picture = clouds((90, 120), 4)
    whole = stillwater.make_cyclic(picture, along_y=True)
    assert whole.shape == (90 + 23, 150, 4)
    assert np.abs(whole[-1] - whole[0]).max() <= np.percentile(steps(picture, 0), 99.9)
    # Where the strips cross, too.
    assert np.abs(whole[:, -1] - whole[:, 0]).max() <= 1.3 * np.percentile(steps(picture, 1), 99.9)


def test_the_picture_itself_is_kept():
    picture = clouds((60, 80), 5)
    whole = stillwater.make_cyclic(picture, along_y=True)
    assert np.array_equal(whole[:60, :80, :3], picture)


def test_what_is_hidden_is_filled_and_the_rest_is_kept():
    picture = clouds((60, 120), 6)
    known = np.ones((60, 120), bool)
    known[30:, 40:80] = False
    picture[~known] = (1, 0, 0)
    whole = stillwater.make_cyclic(picture, known=known)
    assert np.array_equal(whole[:, :120][known][:, :3], picture[known])
    assert np.abs(whole[..., 0] - whole[..., 1]).max() < 0.05  # no red anywhere


def test_neither_axis_changes_nothing():
    picture = clouds((30, 40), 7)
    assert np.array_equal(stillwater.make_cyclic(picture, along_x=False)[..., :3], picture)


@pytest.mark.parametrize("shape", [(1, 1), (1, 60), (60, 1), (5, 9)])
def test_small_pictures(shape):
    whole = stillwater.make_cyclic(clouds(shape, 8), along_y=True)
    assert whole.shape[:2] == tuple(side + (side + 3) // 4 for side in shape)
    assert np.isfinite(whole).all()


def test_any_number_of_threads_gives_the_same():
    picture, results = clouds((50, 70), 9), []
    for threads in (1, 3):
        engine.set_threads(threads)
        results.append(stillwater.make_cyclic(picture))
    engine.set_threads(0)
    assert np.array_equal(*results)


@pytest.mark.parametrize(
    "given, sentence",
    [
        ({"known": np.zeros((4, 5))}, "known: 5 x 4 is not the size of the image, 80 x 60"),
        ({"known": np.zeros((60, 80))}, "hole: it covers the whole picture"),
        ({"patch": 4}, r"patch: 4 is not odd \(px\)"),
        ({"picture": np.full((60, 80, 3), np.nan)}, r"picture: pixel \(\d+, \d+\) is not a finite number"),
    ],
)
def test_what_does_not_fit_is_said(given, sentence):
    with pytest.raises(ValueError, match=sentence):
        stillwater.make_cyclic(**{"picture": clouds((60, 80), 1), **given})


def test_progress_rises_and_can_cancel():
    told = []

    def listener(phase, share):
        told.append(share)
        return True

    stillwater.make_cyclic(clouds((60, 80), 1), along_y=True, progress=listener)
    assert told == sorted(told) and told[0] == 0 and told[-1] == pytest.approx(1)
    with pytest.raises(engine.Cancelled):
        stillwater.make_cyclic(clouds((60, 80), 1), progress=lambda phase, share: share < 0.3)
