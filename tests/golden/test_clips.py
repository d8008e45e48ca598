"""The samples' clips of fluids read, go on evenly and move the way their fluids do.

`native/flow` finds the motion between two frames; a pixel counts as much as it changes, so that what is still says nothing.
"""

from pathlib import Path

import numpy as np
import pytest
import stillwater

SAMPLES = Path(__file__).parents[2] / "blend_samples"
RISES = {"campfire": -1, "waterfall": 1}  # y down
LARGEST = 600_000  # bytes

CLIPS = sorted(path.parent.name for path in SAMPLES.glob("*/clip.mp4"))


@pytest.fixture(scope="module", params=CLIPS)
def clip(request):
    return request.param, stillwater.read_clip(SAMPLES / request.param / "clip.mp4")


def test_every_fluid_with_a_script_has_its_clip():
    assert CLIPS == sorted(path.parent.name for path in SAMPLES.glob("*/clip.py")) == sorted(RISES)


def test_a_clip_is_small_and_long_enough(clip):
    name, frames = clip
    assert (SAMPLES / name / "clip.mp4").stat().st_size <= LARGEST
    assert 64 <= len(frames) <= 100 and frames.shape[1] <= 320 and frames.shape[2] <= 240


def test_it_neither_starts_nor_ends(clip):
    """Means of eighths stray from the whole's mean by less than a fluid's own unrest."""
    means = clip[1].mean(axis=(1, 2, 3))
    parts = np.array([part.mean() for part in np.array_split(means, 8)])
    assert np.abs(parts / means.mean() - 1).max() < 0.25


def test_it_moves_the_way_its_fluid_does(clip):
    name, frames = clip
    for first in (4, len(frames) // 2, len(frames) - 6):
        a, b = frames[first], frames[first + 1]
        change = np.abs(b - a).sum(axis=2)
        flow = stillwater.optical_flow(a, b, "medium")
        down = (flow[..., 1] * change).sum() / change.sum()
        assert RISES[name] * down > 1.0, down
