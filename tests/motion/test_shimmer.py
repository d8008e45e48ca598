"""Shimmer: leaves move a little, each its own way, more towards the tip, and nothing tears."""

import numpy as np
import pytest
import stillwater
from stillwater import _stillwater as engine

SIZE = (400, 500)
ARMATURE = ((200.0, 490.0), (200.0, 90.0))
LENGTH, CELL = 400.0, 8.0


def leaves(frame, shimmer=1.0, seed=0, loop=None, **wind):
    """Shimmer alone, as a map: amount 0 holds the branch still."""
    return stillwater.sway(
        SIZE, frame, ARMATURE, amount=0, shimmer=shimmer, seed=seed, loop=loop, wind=stillwater.Wind(**wind)
    )


def swings(points, frames):
    """How far points are swung, frames x points x 2."""
    sway, wind = engine.Sway(armature=ARMATURE, amount=0, shimmer=1), stillwater.Wind()
    motion = engine.SwayMotion(sway, wind.moment(1).wind, SIZE)
    points = np.reshape(points, (1, -1, 2))
    return np.array([motion.at(wind.moment(frame), sway).unmap(points)[0] - points[0] for frame in frames])


def test_it_grows_from_the_root_outwards():
    x = np.arange(150, 250, 5)
    rms = [swings([(x, y) for x in x], range(1, 100, 3)).std() for y in (480, 400, 300, 200, 100)]
    assert rms == sorted(rms)
    assert rms[0] < 0.1 * rms[-1]
    assert not swings([ARMATURE[0]], range(1, 9)).any()


def test_no_leaf_swings_further_than_its_bound():
    longest = 0.2 * CELL * 5 / (5 + 2.5)
    fields = np.array([leaves(frame) for frame in range(1, 60, 7)])
    assert 0.5 * longest < np.hypot(fields[..., 0], fields[..., 1]).max() <= longest


def test_strength_follows_shimmer_and_wind():
    def strength(**given):
        return leaves(9, **given).std()

    assert strength(shimmer=0.5) == pytest.approx(0.5 * strength(), rel=1e-3)
    assert strength(speed=10) / strength(speed=5) == pytest.approx((10 / 12.5) / (5 / 7.5), rel=1e-3)
    assert not leaves(9, speed=0).any() and not leaves(9, shimmer=0).any()


def test_a_gust_shakes_the_leaves_more():
    wind = stillwater.Wind(gusts=1, seed=2)
    frames = range(1, 400, 13)
    gusty = [stillwater.sway(SIZE, f, ARMATURE, amount=0, shimmer=1, wind=wind).std() for f in frames]
    factor = np.array([wind.gust((200, 290), SIZE, frame) for frame in frames])
    calm = np.array([leaves(frame).std() for frame in frames])
    assert np.allclose(np.array(gusty) / calm, (5 * factor / (5 * factor + 2.5)) / (5 / 7.5), rtol=1e-3)


def test_neighbours_go_together_and_others_do_not():
    series = swings([(200, 120), (201, 120), (232, 120), (200, 152)], range(1, 240))[..., 0]
    assert np.corrcoef(series[:, 0], series[:, 1])[0, 1] > 0.95
    assert abs(np.corrcoef(series[:, 0], series[:, 2])[0, 1]) < 0.3
    assert abs(np.corrcoef(series[:, 0], series[:, 3])[0, 1]) < 0.3


def test_leaves_swing_at_two_to_five_hertz():
    fps, frames = 24, 480
    series = swings([(x, y) for x in range(180, 220, 8) for y in range(100, 140, 8)], range(1, frames + 1))
    power = (np.abs(np.fft.rfft(series, axis=0)) ** 2).mean((1, 2))
    frequencies = np.fft.rfftfreq(frames, 1 / fps)
    inside = (frequencies > 1.8) & (frequencies < 5.2)
    assert power[inside].sum() > 0.97 * power.sum()


def test_the_map_never_folds_even_in_a_storm():
    y, x = np.mgrid[0 : SIZE[1], 0 : SIZE[0]].astype(np.float64)
    for frame in range(1, 100, 9):
        points = np.stack([x, y], -1) + leaves(frame, speed=40)
        across, down = np.diff(points, axis=1)[:-1], np.diff(points, axis=0)[:, :-1]
        area = across[..., 0] * down[..., 1] - across[..., 1] * down[..., 0]
        assert area.min() > 0.18  # (1 - 0.57)^2, the bound of shimmer.h


def test_it_closes_in_a_loop():
    for loop in (12, 100):
        assert np.array_equal(leaves(5, loop=loop), leaves(5 + loop, loop=loop))
        assert not np.array_equal(leaves(5, loop=loop), leaves(8, loop=loop))


def test_the_inverse_is_exact():
    moment = stillwater.Wind(speed=40).moment(21)
    sway = engine.Sway(armature=ARMATURE, amount=0, shimmer=1)
    displacement = engine.SwayMotion(sway, moment.wind, SIZE).at(moment, sway)
    y, x = np.mgrid[0 : SIZE[1] : 3, 0 : SIZE[0] : 3] + 0.5
    points = np.stack([x, y], -1)
    assert np.abs(displacement.unmap(displacement.map(points)) - points).max() < 2e-4
    assert not displacement.at_rest()


def test_layers_have_leaves_of_their_own():
    assert not np.allclose(leaves(5, seed=1), leaves(5, seed=2), atol=0.1)
