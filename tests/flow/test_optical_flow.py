"""Optical flow finds motion that is known, of any range of numbers, and says what it can't look at."""

import numpy as np
import pytest
import stillwater
from scipy.ndimage import gaussian_filter, map_coordinates
from stillwater import _stillwater as engine

HEIGHT, WIDTH = 120, 160
QUALITIES = ["fast", "medium", "best"]
INNER = (slice(16, -16), slice(16, -16))


def texture(height=HEIGHT, width=WIDTH, seed=2):
    """Noise of several sizes, 0 .. 1."""
    rng = np.random.default_rng(seed)
    sum_ = sum(s * gaussian_filter(rng.normal(size=(height, width)), s) for s in (1.5, 3, 6))
    return ((sum_ - sum_.min()) / np.ptp(sum_)).astype(np.float32)


def moved(image, flow):
    """The picture one frame later, where the flow is the same everywhere around: b(x) = a(x - flow)."""
    y, x = np.mgrid[: image.shape[0], : image.shape[1]]
    return map_coordinates(image, [y - flow[..., 1], x - flow[..., 0]], order=3, mode="reflect").astype(np.float32)


def even(x, y):
    return np.full((HEIGHT, WIDTH, 2), (x, y), np.float32)


def turned(angle):
    """Where a rotation around the middle takes each pixel, and where it comes from."""
    y, x = np.mgrid[:HEIGHT, :WIDTH] - np.array([HEIGHT / 2, WIDTH / 2])[:, None, None]
    there = [np.stack([np.cos(a) * x - np.sin(a) * y - x, np.sin(a) * x + np.cos(a) * y - y], axis=-1) for a in (angle, -angle)]
    return there[0], -there[1]


@pytest.fixture(autouse=True)
def _default_threads():
    yield
    engine.set_threads(0)


def error(found, expected):
    return np.linalg.norm(found - expected, axis=-1)[INNER].mean()


@pytest.mark.parametrize(("quality", "most"), [("fast", 0.12), ("medium", 0.05), ("best", 0.02)])
@pytest.mark.parametrize("way", [(2, -1), (0.5, 0.25), (-6, 3)])
def test_a_translation(quality, most, way):
    a = texture()
    assert error(stillwater.optical_flow(a, moved(a, even(*way)), quality), way) < most


@pytest.mark.parametrize(("quality", "most"), [("fast", 0.25), ("medium", 0.1), ("best", 0.06)])
def test_a_rotation(quality, most):
    forth, came = turned(0.04)
    a = texture()
    assert error(stillwater.optical_flow(a, moved(a, came), quality), forth) < most


def test_more_care_finds_it_better():
    """A small whirl in a still picture."""
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    spin = 0.25 * np.exp(-((x - 80) ** 2 + (y - 60) ** 2) / (2 * 12**2))
    flow = np.stack([-(y - 60) * spin, (x - 80) * spin], axis=-1)
    b = texture()
    at = [y + flow[..., 1], x + flow[..., 0]]
    a = map_coordinates(b, at, order=3).astype(np.float32)  # a(x) = b(x + flow(x)): exact
    fast, medium, best = (error(stillwater.optical_flow(a, b, quality), flow) for quality in QUALITIES)
    assert best < medium < 0.1 and medium < fast < 0.3


def test_any_range_of_numbers():
    a = texture()
    b = moved(a, even(2, 1))
    expected = stillwater.optical_flow(a, b)
    small = stillwater.optical_flow(0.02 * (a - 0.5), 0.02 * (b - 0.5))
    assert np.abs(small - expected).mean() < 0.02
    a[3, 3] = 1000
    assert error(stillwater.optical_flow(a, b), (2, 1)) < 0.1


def test_colours_count_by_their_luma():
    a = texture()
    b = moved(a, even(3, 0))
    expected = stillwater.optical_flow(a, b)
    for channels in ((1, 1, 1), (1, 1, 1, 1)):
        found = stillwater.optical_flow(a[..., None] * np.array(channels), b[..., None] * np.array(channels))
        assert np.abs(found - expected).mean() < 0.01
    weights = [engine.luma(np.eye(3, dtype=np.float32)[None, c : c + 1])[0, 0] for c in range(3)]
    np.testing.assert_allclose(weights, [0.2126, 0.7152, 0.0722], rtol=1e-6)


def test_what_shows_nothing_does_not_move():
    assert not stillwater.optical_flow(np.full((40, 50), 0.3), np.full((40, 50), 0.3)).any()


@pytest.mark.parametrize("size", [(16, 16), (16, 300), (17, 33)])
@pytest.mark.parametrize("quality", QUALITIES)
def test_small_pictures(size, quality):
    a = texture(*size)
    found = stillwater.optical_flow(a, a, quality)
    assert found.shape == (*size, 2) and np.abs(found).max() < 0.2


@pytest.mark.parametrize("quality", QUALITIES)
@pytest.mark.parametrize("threads", [1, 2, 5])
def test_any_number_of_threads(threads, quality):
    a = texture(200, 333)
    b = texture(200, 333, seed=3) * 0.3 + np.roll(a, 2, axis=1)
    expected = stillwater.optical_flow(a, b, quality)
    engine.set_threads(threads)
    np.testing.assert_array_equal(stillwater.optical_flow(a, b, quality), expected)


GOOD = np.zeros((20, 20))


@pytest.mark.parametrize(
    "a, b, quality, sentence",
    [
        (np.zeros(20), GOOD, "fast", "a: an array of 20 is not height x width"),
        (GOOD, np.zeros((20, 20, 2)), "fast", "b: an array of 20 x 20 x 2 is not height x width"),
        (GOOD, np.zeros((20, 21)), "fast", "b: 21 x 20 is not the size of a, 20 x 20"),
        (np.zeros((15, 90)), np.zeros((15, 90)), "fast", "a: 90 x 15 is not at least 16 pixels a side"),
        (GOOD, np.full((20, 20), np.nan), "fast", "b: not finite everywhere"),
        (GOOD, GOOD, "better", "quality: better is not fast, medium or best"),
    ],
)
def test_what_is_refused(a, b, quality, sentence):
    with pytest.raises(ValueError) as caught:
        stillwater.optical_flow(a, b, quality)
    assert str(caught.value) == sentence
