"""Layers displaced as a whole: turned about a point and moved, both ways exactly."""

import numpy as np
import pytest
import stillwater
from stillwater import _stillwater as engine

PICTURE = (300, 200)
PIVOT, ANGLE, SHIFT = (120.0, 80.0), 0.3, (5.0, -7.0)
POINTS = np.stack(np.meshgrid(np.arange(0, 300, 10), np.arange(0, 200, 10)), -1) + 0.5


def motion(pivot=PIVOT, angle=ANGLE, shift=SHIFT):
    return engine.RigidMotion(pivot, angle, shift, PICTURE)


def test_it_turns_clockwise_about_the_pivot_then_moves():
    turn = np.array([[np.cos(ANGLE), -np.sin(ANGLE)], [np.sin(ANGLE), np.cos(ANGLE)]])  # y runs down
    expected = (POINTS - PIVOT) @ turn.T + PIVOT + SHIFT
    assert np.abs(motion().map(POINTS) - expected).max() < 1e-4


@pytest.mark.parametrize("displacement", [motion(), motion(angle=-2.5), engine.Translation((3.25, -900.5))])
def test_forwards_and_back_is_where_it_was(displacement):
    assert np.abs(displacement.unmap(displacement.map(POINTS)) - POINTS).max() < 2e-4
    assert np.abs(displacement.map(displacement.unmap(POINTS)) - POINTS).max() < 2e-4


@pytest.mark.parametrize("given", [{}, {"angle": 3.0}, {"angle": 0}, {"pivot": (-400, 900)}, {"shift": (0, 0)}])
def test_no_point_goes_further_than_reach(given):
    displacement = motion(**given)
    for field in (displacement.displacement_map(PICTURE), displacement.forward_map(PICTURE)):
        furthest = np.hypot(field[..., 0], field[..., 1]).max()
        assert furthest <= displacement.reach() + 1e-3
        assert furthest > 0.5 * displacement.reach()


def test_at_rest_only_where_nothing_moves():
    assert motion(angle=0, shift=(0, 0)).at_rest()
    assert not motion(angle=0).at_rest() and not motion(shift=(0, 0)).at_rest()
    assert engine.Translation((0, 0)).at_rest() and not engine.Translation((0, 1)).at_rest()


def test_what_is_no_motion_is_refused():
    with pytest.raises(stillwater.BadInput, match="rigid motion: nan is not a finite number"):
        motion(angle=float("nan"))
    with pytest.raises(stillwater.BadInput, match="picture: 0 x 9 is not between 1 and 16384 pixels a side"):
        engine.RigidMotion(PIVOT, ANGLE, SHIFT, (0, 9))
    with pytest.raises(stillwater.BadInput, match="points: an array of 3 x 2 is not height x width x 2"):
        motion().map(np.zeros((3, 2), np.float32))
    with pytest.raises(stillwater.BadInput, match="offset: nan is not a finite number"):
        engine.Translation((float("nan"), 0))
