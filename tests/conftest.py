"""A small scene that every room can render: all four motions, a reflection, hard and soft mattes."""

import copy
import json
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

WIDTH, HEIGHT = 48, 36
SCENE = {
    "stillwater": 1,
    "picture": "picture.png",
    "frames": [1, 6],
    "seed": 7,
    "wind": {"speed": 8, "direction": 20, "gusts": 0.4},
    "view": {"horizon": [[0, 17], [48, 18]]},
    "layers": [
        {"name": "boat", "matte": {"labels": "labels.png", "value": 2},
         "motion": {"type": "bob", "waterline": [[20, 25], [32, 25]], "water": "sea"}},
        {"name": "reflection", "matte": {"labels": "labels.png", "value": 3}, "follows": {"layer": "boat", "mirror": True}},
        {"name": "tree", "matte": {"file": "tree.png"}, "feather": 1,
         "motion": {"type": "sway", "armature": [[8, 34], [8, 4]], "amount": 3}},
        {"name": "sea", "matte": {"labels": "labels.png", "value": 1}, "motion": {"type": "ripple", "resolution": 16}},
        {"name": "clouds", "motion": {"type": "drift", "velocity": [0.7, 0.2]}},
    ],
}  # fmt: skip


def paint(folder):
    """The scene's pictures."""
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    noise = np.random.default_rng(3).integers(0, 60, (HEIGHT, WIDTH, 3))
    picture = np.stack([x * 4, y * 5, 120 + 2 * (x + y) % 90], axis=-1) + noise
    Image.fromarray(np.clip(picture, 0, 255).astype(np.uint8)).save(folder / "picture.png")
    labels = np.where(y > 17, 1, 0)
    labels[(abs(x - 26) < 6) & (abs(y - 22) < 4)] = 2
    labels[(abs(x - 26) < 6) & (abs(y - 29) < 3)] = 3
    Image.fromarray(labels.astype(np.uint8)).save(folder / "labels.png")
    tree = np.clip(255 * (7 - np.hypot(x - 8, (y - 14) * 0.5)), 0, 255)
    Image.fromarray(tree.astype(np.uint8)).save(folder / "tree.png")


@pytest.fixture
def scene(tmp_path):
    """`scene(change, name)` writes the scene's pictures and recipe, changed by a function, and answers its path."""

    def write(change=lambda recipe: None, name="recipe.json"):
        recipe = copy.deepcopy(SCENE)
        change(recipe)
        if not (tmp_path / "picture.png").exists():
            paint(tmp_path)
        (tmp_path / name).write_text(json.dumps(recipe))
        return tmp_path / name

    return write


@pytest.fixture
def recipe():
    """A copy of the scene's recipe, as a dictionary."""
    return copy.deepcopy(SCENE)


@pytest.fixture
def command():
    """`command("render", ...)` runs the command line to its end."""

    def run(*arguments, **how):
        line = [sys.executable, "-m", "stillwater", *map(str, arguments)]
        return subprocess.run(line, **{"capture_output": True, "text": True, "timeout": 60, "stdin": subprocess.DEVNULL} | how)

    return run
