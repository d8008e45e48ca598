"""A flow slides along its layer's outline, and stops before what is held still."""

import numpy as np
import pytest
import stillwater
from stillwater import _stillwater as engine

SIZE = (200, 140)
X, Y = np.meshgrid(np.arange(200) + 0.5, np.arange(140) + 0.5)
ROCK = np.hypot(X - 100, Y - 70)  # distance from the rock's middle; its radius is 30
REACH = engine.obstacle_reach(SIZE)
RIGHT = [{"points": [[10, 70], [190, 70]], "speed": 4}]


def around_rock(strokes=RIGHT, **more):
    return stillwater.paint_flow(strokes, SIZE, bound=(ROCK > 30).astype(np.float32), **more)


def through(velocity, ring):
    """The part across the rock's outline, there."""
    out = np.stack([X - 100, Y - 70], axis=2) / ROCK[..., None]
    return np.abs((velocity * out).sum(axis=2))[ring]


def test_reach_goes_with_the_picture():
    assert engine.obstacle_reach((1000, 750)) == pytest.approx(18.75) and engine.obstacle_reach((40, 30)) == 6


def test_nothing_runs_through_the_outline_but_along():
    flow = around_rock()
    velocity = flow.orientation * flow.speed[..., None]
    at_rock = (ROCK > 30) & (ROCK < 31.5)
    assert through(velocity, at_rock).max() < 0.15 * 4
    assert through(velocity, at_rock).mean() < 0.04 * 4
    beside = at_rock & (np.abs(X - 100) < 5)
    assert flow.speed[beside].min() > 0.95 * 4 and flow.orientation[beside][:, 0].min() > 0.98


def test_it_turns_aside_smoothly():
    flow = around_rock()
    velocity = flow.orientation * flow.speed[..., None]
    far = ROCK > 31 + REACH
    assert np.abs(velocity[far] - (4, 0)).max() < 1e-4
    front = velocity[70, :70, 0]
    assert front[69] < 0.3 and (np.diff(front) < 1e-3).all() and np.abs(np.diff(front)).max() < 4 * 0.45
    assert np.abs(np.linalg.norm(flow.orientation, axis=2) - 1).max() < 1e-4


def test_a_particle_does_not_enter_the_rock():
    flow = around_rock()
    velocity = flow.orientation * flow.speed[..., None]
    for start in np.linspace(45, 95, 21):
        at = np.array([20.0, start])
        for _ in range(600):
            x, y = int(at[0]), int(at[1])
            if not (0 <= x < 200 and 0 <= y < 140):
                break
            at = at + 0.1 * velocity[y, x]
            assert np.hypot(*(at - (100, 70))) > 28.5


def test_it_runs_out_of_the_picture():
    flow = stillwater.paint_flow(RIGHT, SIZE, bound=np.ones((140, 200)))
    assert np.array_equal(flow.speed, stillwater.paint_flow(RIGHT, SIZE).speed)
    band = (np.abs(Y - 70) < 40).astype(np.float32)
    flow = stillwater.paint_flow([{"points": [[20, 50], [180, 90]], "speed": 4}], SIZE, bound=band)
    assert flow.speed[70, 199] == pytest.approx(4, abs=0.01)
    assert abs(flow.orientation[30, 100, 1]) < 0.02 and flow.speed[30, 100] > 3.5


def test_refining_does_not_lead_it_through():
    picture = (0.5 + 0.4 * np.sin((X + Y) / 4))[..., None].repeat(3, 2)
    refined = stillwater.refine_flow(around_rock(), picture, width=6)
    assert through(refined, (ROCK > 30) & (ROCK < 31.5)).mean() < 0.04 * 4


def test_what_is_held_still_stands_and_speed_falls_smoothly():
    frozen = (X > 150).astype(np.float32)
    flow = stillwater.paint_flow(RIGHT, SIZE, freeze=frozen)
    assert flow.speed[:, 150:].max() == 0
    line = flow.speed[70]
    assert line[100] == pytest.approx(4, abs=1e-4) and line[149] < 0.6
    assert (np.diff(line[100:]) <= 1e-5).all() and np.abs(np.diff(line)).max() < 4 * 0.45
    assert np.array_equal(flow.orientation, stillwater.paint_flow(RIGHT, SIZE).orientation)


def test_half_held_is_half_as_fast():
    flow = stillwater.paint_flow(RIGHT, SIZE, freeze=np.full((140, 200), 0.25))
    assert np.abs(flow.speed - 3).max() < 1e-4
