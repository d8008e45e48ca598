"""Drift passes evenly, and closes loops by whole turns or by two copies half a loop apart."""

import inspect

import numpy as np
import pytest
import stillwater
from stillwater import _stillwater as engine
from stillwater.recipe.stochastic import Drift as RecipeDrift

PERIOD = (400.0, 300.0)
LOOP, FIRST = 100, 11


def copies(frame, speed, loop=LOOP):
    """A layer that moves by `speed` px/frame since frame 1."""
    drift = engine.Drift(
        offset=tuple(s * (frame - 1) for s in speed), loop_offset=tuple(s * loop for s in speed) if loop else (0, 0)
    )
    return engine.drift(drift, engine.Moment(frame=frame, loop_frames=loop, first_frame=FIRST), PERIOD)


def test_names_and_defaults_are_the_recipe_s():
    given = inspect.signature(stillwater.drift).parameters
    for name, default in zip(RecipeDrift.__struct_fields__, RecipeDrift.__struct_defaults__):
        assert given[name].default == default, name


def test_without_a_loop_one_copy_stands_at_the_offset():
    here = copies(31, (2, -1), loop=0)
    assert here.first == [60, -30] and here.second_share == 0


def test_whole_turns_close_a_loop_evenly():
    """420 px a loop are made one turn of 400."""
    places = np.array([copies(frame, (4.2, 0)).first for frame in range(FIRST, FIRST + LOOP + 1)])
    shares = [copies(frame, (4.2, 0)).second_share for frame in range(FIRST, FIRST + LOOP)]
    assert not any(shares)
    assert places[0] == pytest.approx([42, 0], abs=1e-6)
    assert np.allclose(np.diff(places[:-1], axis=0), [4, 0], atol=1e-6)
    assert places[-1] == pytest.approx(places[0], abs=1e-6)  # the next loop begins


@pytest.mark.parametrize(
    ("speed", "crossed"), [(4.44, False), (4.46, True), (3.64, False), (3.62, True), (1, True), (0, False)]
)
def test_a_change_of_speed_by_more_than_a_tenth_crosses_two_copies(speed, crossed):
    assert (copies(FIRST + 30, (speed, 0)).second_share > 0) == crossed


def test_two_copies_are_half_a_loop_apart_and_start_over_unseen():
    speed = (1.0, 0.5)
    frames = range(FIRST, FIRST + LOOP + 1)
    drawn = [copies(frame, speed) for frame in frames]
    first, second = np.array([d.first for d in drawn]), np.array([d.second for d in drawn])
    share = np.array([d.second_share for d in drawn])
    assert share[0] == 0 and share[LOOP // 2] == 1 and share[-1] == 0
    assert np.allclose(first[0], [FIRST - 1, (FIRST - 1) / 2], atol=1e-6)
    assert np.allclose(np.abs(first - second), np.multiply(speed, LOOP / 2), atol=1e-6)
    for copy, weight in ((first, 1 - share), (second, share)):
        jumps = np.abs(np.diff(copy, axis=0) - speed).max(1) > 1e-6
        assert jumps.sum() == 1
        assert weight[1:][jumps] < 1e-9


def test_the_loop_closes_to_the_byte():
    for frame in (FIRST, FIRST + 17, FIRST + 80):
        for speed in ((4.2, 0.013), (1.1, 0.7)):
            one, two = copies(frame, speed), copies(frame + LOOP, speed)
            assert (one.first, one.second, one.second_share) == (two.first, two.second, two.second_share)


def test_the_map_is_the_same_everywhere_and_both_ways():
    back = stillwater.drift((7, 5), 11, velocity=(1.5, -2))
    assert back.shape == (5, 7, 2) and back.dtype == np.float32
    assert np.allclose(back, [-15, 20], atol=1e-5)
    assert np.allclose(stillwater.drift((7, 5), 11, velocity=(1.5, -2), forward=True), [15, -20], atol=1e-5)


@pytest.mark.parametrize(("direction", "expected"), [(0, 25), (180, -25), (60, 12.5), (90, 0)])
def test_clouds_go_with_the_wind_along_the_picture(direction, expected):
    moved = stillwater.drift((3, 2), 11, under=stillwater.Wind(direction=direction), forward=True)
    assert np.allclose(moved, [expected, 0], atol=1e-5)


def test_frame_one_is_at_rest():
    assert not stillwater.drift((4, 4), 1).any()


def test_a_period_of_nothing_is_refused():
    with pytest.raises(stillwater.BadInput, match=r"period: 0 is not above 0 \(px\)"):
        engine.drift(engine.Drift(), engine.Moment(), (0, 5))


def test_a_way_without_end_is_refused():
    with pytest.raises(stillwater.BadInput, match="drift: inf is not a finite number"):
        engine.drift(engine.Drift(offset=(float("inf"), 0)), engine.Moment(), PERIOD)
