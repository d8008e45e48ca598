"""The samples, rendered small, look as they did: frames of each against a picture kept beside this file.

A frame may differ from the kept one by 1 level of 255 in the mean (other processors compute to 1/1000, other libraries
resize a little differently) and by more than 6 levels in one pixel of a hundred; in six of a hundred where a layer flows like
a clip, as which pieces of it lie where hangs on the optical flow of OpenCV's version (4.6 and 4.10: in four of them). After a wanted change
`STILLWATER_UPDATE=1 bash tests/run.sh golden` keeps the new ones: look at them before they are committed.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from stillwater import _stillwater as engine

HERE = Path(__file__).parent
SAMPLES = HERE.parents[1] / "blend_samples"
FRAMES = (1, 20, 47)
SCALE = 0.125
FEW, FEW_OF_FILMS = 0.01, 0.06  # of the pixels


def rendered(name, folder):
    """The frames side by side, 8 bit."""
    command = [sys.executable, "-m", "stillwater", "render", SAMPLES / name / "recipe.json", "--scale", SCALE, "--output", folder]
    for frame in FRAMES:
        subprocess.run([*map(str, command), "--frames", f"{frame}-{frame}"], check=True, timeout=120, capture_output=True)
    pictures = [engine.read_frame(str(folder / f"frame_{frame:04}.exr")) for frame in FRAMES]
    return np.hstack([(np.clip(picture[..., :3], 0, 1) * 255 + 0.5).astype(np.uint8) for picture in pictures])


@pytest.mark.parametrize("name", sorted(path.parent.name for path in SAMPLES.glob("*/recipe.json")))
def test_sample(name, tmp_path):
    new, kept = rendered(name, tmp_path), HERE / f"{name}.png"
    if os.environ.get("STILLWATER_UPDATE") == "1":
        Image.fromarray(new).save(kept)
    assert kept.exists(), f"{kept.name} is not there: STILLWATER_UPDATE=1 bash tests/run.sh golden makes it"
    difference = np.abs(new.astype(int) - np.asarray(Image.open(kept)).astype(int))
    filmed = '"example"' in (SAMPLES / name / "recipe.json").read_text()
    if difference.mean() >= 1 or (difference.max(axis=2) > 6).mean() >= (FEW_OF_FILMS if filmed else FEW):
        Image.fromarray(new).save(tmp_path / "new.png")
        pytest.fail(f"{name} looks different: {tmp_path / 'new.png'} against {kept} (mean {difference.mean():.2f} levels)")


def test_all_samples_move():
    """A golden of a still picture would hold for an engine that moves nothing."""
    for kept in HERE.glob("*.png"):
        first, second, third = np.split(np.asarray(Image.open(kept)).astype(int), len(FRAMES), axis=1)
        assert np.abs(first - second).mean() > 0.5 and np.abs(second - third).mean() > 0.5, kept.name
