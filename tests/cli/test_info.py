"""`info`: what will be computed, what is there, and how much memory it takes."""

import json
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image


def facts(done):
    assert done.returncode == 0, done.stderr
    return dict(re.findall(r"^(\w+) +(.+)$", done.stdout, re.MULTILINE))


def test_before_and_after(scene, tmp_path, command):
    path = scene(lambda recipe: recipe["layers"][2].update(visible=False))
    before = facts(command("info", path))
    assert before["picture"] == "48 x 36 px"
    assert before["frames"] == "1 to 6, 48 x 36 px, 24 a second"
    assert before["folder"] == f"{tmp_path}/frames: 0 of 6 frames are there and up to date"
    assert before["cache"] == f"{tmp_path}/.stillwater-cache: the layers are not cut yet, 0 MB in all"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["labels.png", "picture.png", "recipe.json", "tree.png"]
    command("render", path, "--frames", "2-4")
    after = facts(command("info", path))
    assert after["folder"] == f"{tmp_path}/frames: 3 of 6 frames are there and up to date"
    assert after["cache"].startswith(f"{tmp_path}/.stillwater-cache: the layers are cut")


def test_what_is_out_of_date_and_why(scene, command):
    command("render", scene())
    path = scene(lambda recipe: recipe["wind"].update(speed={"first": 1, "values": [8, 8, 8, 8, 3]}))
    done = command("info", path)
    assert facts(done)["stale"] == "wind changed: 4 to 6" and ": 3 of 6 frames are there" in facts(done)["folder"]
    told = json.loads(command("info", path, "--json").stdout)
    stale = {"first": 4, "last": 6, "state": "stale", "why": ["wind changed"]}
    assert told["spans"] == [{"first": 1, "last": 3, "state": "ready", "why": []}, stale]
    assert (told["frames"], told["size"], told["layers"][1]["name"]) == ([1, 6], [48, 36], "reflection")
    assert told["memory"] > 1e8 and told["cache"]["cut"]


def test_the_layers(scene, command):
    done = command("info", scene(lambda recipe: recipe["layers"][2].update(visible=False)))
    told = [line.strip() for line in done.stdout.splitlines() if line.startswith("   ")]
    assert told == ["boat: bob", "reflection: still, follows boat in the mirror", "tree: sway, hidden", "sea: ripple", "clouds: drift"]
    assert done.stderr == ""


def test_what_is_wrong_is_said(scene, tmp_path, command):
    path = scene()
    (tmp_path / "tree.png").unlink()
    done = command("info", path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"stillwater: {path}: layers[2].matte.file: {tmp_path}/tree.png: there is no such file\n"


PEAK = """import resource, subprocess, sys
subprocess.run(sys.argv[1:], stdin=subprocess.DEVNULL, check=True)
print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"""


def peak_bytes(*arguments):
    """Of a command line that runs to its end, started by a small process: a child's peak is at least its parent's size."""
    command = [sys.executable, "-S", "-c", PEAK, sys.executable, "-m", "stillwater", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, done.stderr
    return int(done.stdout) * (1 if sys.platform == "darwin" else 1024)


WIDTH, HEIGHT = 1600, 1000
SWAY = {"type": "sway", "armature": [[100, 900], [100, 100]]}
FLOW = {"type": "flow", "strokes": [{"points": [[100, 100], [1500, 900]]}]}


FILM = {"type": "example", "clip": "clip.mp4", "strokes": [{"points": [[100, 100], [700, 900]]}], "repetitions": 1}


def stripes(x, y, layers):
    """Side by side: whatever lies in front hides all of a layer's surroundings on one side."""
    return x * layers // WIDTH


def discs(x, y, layers):
    """Over each other, the first in front; each touches a few others."""
    labels = np.full(x.shape, layers - 1)
    for i in reversed(range(layers - 1)):
        centre = WIDTH * (0.1 + 0.8 * (i * 0.618 % 1)), HEIGHT * (0.2 + 0.6 * (i * 0.382 % 1))
        labels[np.hypot(x - centre[0], y - centre[1]) < 200] = i
    return labels


@pytest.mark.parametrize(
    "labels, layers, motion, scale",
    [
        (stripes, 2, SWAY, 1),
        (stripes, 6, SWAY, 1),
        (discs, 12, SWAY, 1),
        (stripes, 2, {"type": "drift", "velocity": [3, 0]}, 1),
        (stripes, 3, {"type": "still"}, 2),
        (stripes, 2, FLOW, 1),
        (stripes, 2, {**FLOW, "outline": {"moving": True}}, 1),
        pytest.param(stripes, 2, FILM, 1, marks=pytest.mark.skipif(not shutil.which("ffmpeg"), reason="ffmpeg is not installed")),
    ],
)
def test_the_memory_is_within_a_fifth_of_the_peak(scene, tmp_path, command, labels, layers, motion, scale):
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    Image.fromarray(np.stack([x % 256, y % 256, (x + y) % 256], axis=-1).astype(np.uint8)).save(tmp_path / "picture.png")
    Image.fromarray(labels(x, y, layers).astype(np.uint8)).save(tmp_path / "labels.png")
    if motion is FILM:
        noise = np.random.default_rng(1).integers(0, 255, (24, 180, 320, 3), np.uint8)
        coding = "ffmpeg -v error -y -f rawvideo -pix_fmt rgb24 -s 320x180 -r 24 -i - -c:v libx264 -qp 10".split()
        subprocess.run([*coding, str(tmp_path / "clip.mp4")], input=noise.tobytes(), check=True, timeout=60)
        cut, motion = [{"name": "0", "matte": {"labels": "labels.png", "value": 0}, "fill": {"method": "none"}, "motion": motion}], {"type": "still"}
    else:
        cut = None
    cut = cut or [{"name": str(i), "matte": {"labels": "labels.png", "value": i}, "motion": motion} for i in range(layers - 1)]
    path = scene(lambda recipe: recipe.update(layers=[*cut, {"name": "back", "motion": motion}], output={"scale": scale}))
    for state in ("cold", "warm"):
        said = float(re.match(r"(\d+) MB", facts(command("info", path))["memory"])[1]) * 1e6
        peak = peak_bytes("render", path, "--frames", "1-2", "--output", tmp_path / state, "--progress", "none")
        assert abs(said / peak - 1) < 0.2, (state, said, peak)
