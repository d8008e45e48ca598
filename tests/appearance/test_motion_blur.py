"""Blur along a flow against its closed forms."""

import numpy as np
import pytest
import stillwater
from scipy.ndimage import gaussian_filter
from stillwater import _stillwater as engine


def flow(shape, x, y):
    return np.broadcast_to(np.array([x, y], np.float32), (*shape, 2)).copy()


def grey(plane):
    return np.stack([plane] * 3, axis=-1)


def test_constant_flow_is_a_line_filter():
    """A wave of frequency f is damped by sinc(f L), L the way while the shutter is open."""
    y, x = np.mgrid[:60, :200]
    for (u, v), way in [((3, 0), 12), ((0, -1.5), 6), ((2, 1), 4 * np.sqrt(5))]:
        along = (u * x + v * y) / np.hypot(u, v)
        wave = 0.5 + 0.4 * np.cos(2 * np.pi * along / 40)
        blurred = stillwater.motion_blur(grey(wave), flow(x.shape, u, v), shutter=0.4, fps=10, average_blur=0)
        expected = 0.5 + 0.4 * np.sinc(way / 40) * np.cos(2 * np.pi * along / 40)
        np.testing.assert_allclose(blurred[15:-15, 15:-15, 0], expected[15:-15, 15:-15], atol=4e-3)


def test_it_is_symmetric_in_time():
    image = np.random.default_rng(1).random((40, 50, 3))
    there, back = (stillwater.motion_blur(image, flow((40, 50), s * 2, s), average_blur=0) for s in (1, -1))
    np.testing.assert_allclose(there, back, atol=1e-6)


def test_rings_stay_rings_in_a_whirl():
    y, x = np.mgrid[:101, :101] - 50.0
    radius = np.hypot(x, y)
    rings = 0.5 + 0.4 * np.cos(radius / 3)
    whirl = np.stack([-y, x], axis=-1) * 0.05
    blurred = stillwater.motion_blur(grey(rings), whirl, shutter=0.5, average_blur=0)[..., 0]
    assert np.abs(blurred - rings)[radius < 40].max() < 0.02


def test_still_pixels_keep_their_bytes():
    image = np.random.default_rng(2).random((30, 30, 3)).astype(np.float32)
    field = flow((30, 30), 4, 0)
    field[:, :10] = 0
    blurred = stillwater.motion_blur(image, field, average_blur=0)
    np.testing.assert_array_equal(blurred[:, :10, :3], image[:, :10])
    assert np.abs(blurred[:, 12:, :3] - image[:, 12:]).mean() > 0.05


def test_a_gaussian_follows():
    image = np.random.default_rng(3).random((80, 90)).astype(np.float32)
    blurred = stillwater.motion_blur(grey(image), flow(image.shape, 0, 0), average_blur=3)[..., 0]
    np.testing.assert_allclose(blurred[15:-15, 15:-15], gaussian_filter(image, 3)[15:-15, 15:-15], atol=2e-3)


def test_threads_do_not_change_a_byte():
    image, field = np.random.default_rng(4).random((70, 50, 3)), flow((70, 50), 1.3, -2)
    made = []
    for threads in (1, 3):
        engine.set_threads(threads)
        made.append(stillwater.motion_blur(image, field).tobytes())
    engine.set_threads(0)
    assert made[0] == made[1]


@pytest.mark.parametrize(
    "change, sentence",
    [
        ({"velocity": flow((9, 9), 1, 1)}, "velocity: 9 x 9"),
        ({"velocity": flow((8, 10), np.nan, 1)}, "velocity: not finite everywhere"),
        ({"velocity": flow((8, 10), 1e5, 1)}, "velocity: .* is not between 0 and 4096 .px while the shutter is open"),
        ({"shutter": 11}, "shutter: 11 is not between 0 and 10"),
        ({"fps": 0}, "fps: 0 is not between 1 and 1000"),
        ({"average_blur": -1}, "average_blur: -1 is not between 0 and 1000"),
    ],
)
def test_what_cannot_be_is_refused(change, sentence):
    arguments = {"picture": np.ones((8, 10, 3)), "velocity": flow((8, 10), 1, 1)} | change
    with pytest.raises(stillwater.BadInput, match=sentence):
        stillwater.motion_blur(**arguments)
