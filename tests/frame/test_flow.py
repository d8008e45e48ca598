"""The flow channel: frame t + 1, sampled along it, gives frame t; it belongs to what is seen."""

import numpy as np
import pytest
from stage import MATTES, MOTIONS, TIES, Stage, matte, smooth_picture
from stillwater import _stillwater as engine

WHOLE = matte(0, 64, 0, 96)
ONE_LAYER = {
    "sway": ([MATTES[0], None], [MOTIONS[0], None], [{}, {}]),
    "ripple": ([MATTES[4], None], [MOTIONS[4], None], [{}, {}]),
    "drift": ([MATTES[3], None], [MOTIONS[3], None], [{"endless": (True, False)}, {}]),
    "bob": ([MATTES[1], MATTES[4], None], [MOTIONS[1], MOTIONS[4], None], [{"water": 1}, {}, {}]),
    "all": (MATTES, MOTIONS, TIES),
}


def warped_back(frame, after):
    """Frame t + 1 sampled at p + flow."""
    return engine.displace(after.combined, frame.flow)


def inner(mask, by=6):
    """Where all of the surroundings belong to the mask."""
    for axis in (0, 1):
        mask = np.logical_and.reduce([np.roll(mask, k, axis) for k in range(-by, by + 1)])
    return mask


@pytest.mark.parametrize("kind", ONE_LAYER)
@pytest.mark.parametrize("t", [4, 29])
def test_the_next_frame_sampled_along_the_flow_gives_this_one(kind, t):
    mattes, motions, ties = ONE_LAYER[kind]
    stage = Stage(image=smooth_picture(), mattes=mattes, motions=motions, ties=ties)
    frame, after = stage.frame(t), stage.frame(t + 1)
    back = warped_back(frame, after)
    edges = np.zeros((64, 96), bool)
    for area in mattes[:-1]:
        edges |= ~(inner(area == 1) | inner(area == 0))
    edges[:6] = edges[-6:] = True
    edges[:, :6] = edges[:, -6:] = True
    error = np.abs(back - frame.combined).max(axis=2)[~edges]
    still = np.abs(after.combined - frame.combined).max(axis=2)[~edges]
    assert error.max() < 0.02
    assert error.mean() < 0.25 * still.mean()


def test_drift_flows_with_its_velocity():
    stage = Stage(velocity=(1.25, 0.0))
    assert np.allclose(stage.frame(9).flow[2:16, 34:], (1.25, 0), atol=1e-4)


def test_a_cross_faded_drift_flows_with_its_velocity_always():
    stage = Stage(velocity=(0.5, 0.0), loop=40, speed=0.0)
    for t in (1, 20, 21, 40):
        assert np.allclose(stage.frame(t).flow[2:16, 34:], (0.5, 0), atol=1e-4)


def test_what_is_still_does_not_flow():
    assert not Stage().frame(9).flow[20:24, 34:].any()


def test_flow_is_in_output_pixels():
    stage = Stage(velocity=(1.0, 0.0), scale=2.0)
    assert np.allclose(stage.frame(9).flow[4:30, 70:], (2.0, 0), atol=1e-3)


def owner_flow(front_coverage, rear_coverage):
    """Flow of one pixel under a drifting front layer over a drifting rear one."""
    front = engine.LayerImage(np.full((8, 8, 4), front_coverage, np.float32), (0, 0, 8, 8))
    rear = engine.LayerImage(np.full((8, 8, 4), rear_coverage, np.float32), (0, 0, 8, 8))
    layers = [engine.Layer(front, motion=engine.Drift()), engine.Layer(rear, motion=engine.Drift())]
    renderer = engine.FrameRenderer((8, 8), 1.0, engine.View(), engine.Wind(), layers)
    now = [engine.LayerState(motion=engine.Drift()) for _ in range(2)]
    after = [engine.LayerState(motion=engine.Drift(offset=(1, 0))), engine.LayerState(motion=engine.Drift(offset=(0, 2)))]
    return tuple(renderer.render(engine.Moment(), engine.Moment(), now, after).flow[4, 4])


@pytest.mark.parametrize(
    "front, rear, flow",
    [
        (1.0, 1.0, (1, 0)),
        (0.5, 1.0, (1, 0)),
        (0.4, 1.0, (0, 2)),
        (0.4, 0.3, (0, 2)),
        (0.4, 0.1, (1, 0)),
        (0.2, 0.3, (0, 2)),
        (0.0, 0.0, (0, 0)),
    ],
)
def test_flow_belongs_to_the_front_most_layer_that_brings_coverage_to_one_half(front, rear, flow):
    assert owner_flow(front, rear) == flow
