"""Streaks lie along the flow, run with it, come back after one turn, and show on light and dark."""

import numpy as np
import pytest
import stillwater
from stillwater import _stillwater as engine

SIZE = (240, 160)


def uniform(x, y, size=SIZE):
    flow = np.zeros((size[1], size[0], 2), np.float32)
    flow[:] = (x, y)
    return flow


def tones(flow, phase=0.0, **more):
    """Signed: white streaks above 0, black ones below."""
    overlay = stillwater.streaks(flow, phase, **more)
    return (2 * overlay[..., 0] - 1) * overlay[..., 3]


def alike(a, b):
    return np.corrcoef(a.ravel(), b.ravel())[0, 1]


def test_along_the_flow_they_are_alike_and_across_not():
    right, down = tones(uniform(3, 0)), tones(uniform(0, 3))
    assert alike(right[:, :-3], right[:, 3:]) > 0.5 and abs(alike(right[:-3], right[3:])) < 0.1
    assert alike(down[:-3], down[3:]) > 0.5 and abs(alike(down[:, :-3], down[:, 3:])) < 0.1


def test_along_circles_too():
    y, x = np.mgrid[:201, :201] - 100.0
    tone = tones(np.stack([-y, x], axis=2) / 50)
    turns, radii = np.meshgrid(np.linspace(0, 2 * np.pi, 400), np.arange(30, 90))

    def ring(radius, turn):
        return tone[np.rint(100 + radius * np.sin(turn)).astype(int), np.rint(100 + radius * np.cos(turn)).astype(int)]

    assert alike(ring(radii, turns), ring(radii, turns + 2 / radii)) > 0.5
    assert abs(alike(ring(radii, turns), ring(radii + 3, turns))) < 0.15


def test_one_turn_later_they_are_the_same():
    flow = uniform(2, 1)
    assert np.array_equal(stillwater.streaks(flow, 0), stillwater.streaks(flow, 1))
    assert np.abs(stillwater.streaks(flow, 0.25) - stillwater.streaks(flow, -2.75)).max() < 1e-4
    assert alike(tones(flow, 0), tones(flow, 0.5)) < 0.75


@pytest.mark.parametrize("way", [1, -1])
def test_they_run_with_the_flow(way):
    """A little later they are where the flow went: their length a turn."""
    now, later = tones(uniform(3 * way, 0), 0.3), tones(uniform(3 * way, 0), 0.4)
    shifts = np.arange(-6, 7)
    fits = [alike(now[:, 20:-20], np.roll(later, -shift, axis=1)[:, 20:-20]) for shift in shifts]
    length = 0.04 * np.hypot(*SIZE)
    assert abs(shifts[np.argmax(fits)] - 0.1 * length * way) <= 1 and way * shifts[np.argmax(fits)] > 0


def test_no_moment_is_fainter_than_another():
    opacity = [np.abs(tones(uniform(3, 1), phase)).mean() for phase in np.arange(0, 1, 0.1)]
    assert max(opacity) < 1.05 * min(opacity)


def test_faster_is_longer():
    flow = uniform(4, 0)
    flow[:80] = (1, 0)
    tone = tones(flow)
    slow, fast = (alike(part[:, :-5], part[:, 5:]) for part in (tone[:78], tone[82:]))
    assert fast > slow + 0.12


def test_what_stands_still_is_clear():
    flow = uniform(3, 0)
    flow[:, :100] = 0
    overlay = stillwater.streaks(flow)
    assert overlay[:, :100, 3].max() == 0 and overlay[:, 110:, 3].max() > 0.5
    assert stillwater.streaks(uniform(0, 0)).max() == 0


@pytest.mark.parametrize("grey", [0, 0.25, 0.5, 0.75, 1])
def test_they_show_over_any_picture(grey):
    picture = np.full((160, 240, 3), grey, np.float32)
    shown = stillwater.over(stillwater.streaks(uniform(3, 1)), picture)[..., :3]
    assert shown.std() > 0.06
    assert np.median(np.abs(shown - grey)) < 0.12  # most of the picture is still to be seen


def test_strength_is_the_clearest_streaks_opacity():
    full, half = (stillwater.streaks(uniform(3, 1), strength=strength)[..., 3] for strength in (1, 0.5))
    assert np.abs(full - 2 * half).max() < 1e-5 and 0.8 < full.max() <= 1
    assert stillwater.streaks(uniform(3, 1), strength=0).max() == 0


def test_length_is_part_of_the_diagonal():
    def reach(length):
        tone = tones(uniform(3, 0), length=length)
        return next(shift for shift in range(1, 100) if alike(tone[:, :-shift], tone[:, shift:]) < 0.3)

    assert reach(0.12) > 1.6 * reach(0.04) and reach(0.04) > reach(0.01)


def test_size_seed_and_threads():
    flow = uniform(3, 1)
    assert stillwater.streaks(flow, size=(120, 80)).shape == (80, 120, 4)
    large = stillwater.streaks(uniform(3, 1, (1600, 900)))
    assert large.shape == (900, 1600, 4) and large[..., 3].max() > 0.5
    assert not np.array_equal(stillwater.streaks(flow), stillwater.streaks(flow, seed=1))
    made = set()
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        made.add(stillwater.streaks(flow, 0.2).tobytes())
    engine.set_threads(0)
    assert len(made) == 1


@pytest.mark.parametrize("size", [(1, 1), (2, 300), (5, 4)])
def test_small_flows(size):
    assert np.isfinite(stillwater.streaks(uniform(1, 2, size))).all()


@pytest.mark.parametrize(
    "given, sentence",
    [
        ({"flow": np.zeros((4, 5))}, "flow: an array of 4 x 5 is not height x width x 2"),
        ({"flow": np.full((4, 5, 2), np.inf)}, "flow[0, 0]: a vector is not finite numbers"),
        ({"phase": float("nan")}, "phase: nan is not a finite number"),
        ({"size": (0, 4)}, "size: 0 x 4 is not between 1 and 16384 pixels a side"),
        ({"length": 0}, "length: 0 is not between 0.001 and 0.5"),
        ({"strength": 2}, "strength: 2 is not between 0 and 1"),
    ],
)
def test_bad_input(given, sentence):
    with pytest.raises(stillwater.BadInput) as caught:
        stillwater.streaks(**{"flow": uniform(1, 0), **given})
    assert str(caught.value) == sentence
