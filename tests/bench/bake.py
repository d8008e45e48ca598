"""Baking the large scene to half-float EXR: computing and writing together against each alone; and its memory."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from bench import Row, medians
from scenes import LARGE, Bed, write_recipe
from stillwater import _stillwater as engine
from stillwater import load
from stillwater.render.cache import FOLDER, Cache
from stillwater.render.prepare import Sources


def rows():
    yield _together()
    yield from _memory()


def _together() -> Row:
    bed = Bed(LARGE)
    kept = bed.next_frame(flow=True)
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "frame.exr")

        def write(frame):
            engine.write_frame(path, frame.combined, frame.flow, frame.matte, options=engine.FrameOptions(half=True, compression="zip", key="bench"))

        both, compute, writing = medians(
            lambda: write(bed.next_frame(flow=True)), lambda: bed.next_frame(flow=True), lambda: write(kept), runs=9, warmup=1
        )
    return Row("bake of 1920x1080, 29 layers (computing + writing alone)", both * 1e3, (compute + writing) * 1e3, 1.1)


def _memory():
    """What `render` takes at most, above the same process after import, against 2 x the layers' boxes in float RGBA + 6
    frames: from its files to the first frame, and with the layers in the cache, as all later bakes of a picture are."""
    with tempfile.TemporaryDirectory() as folder:
        recipe = write_recipe(LARGE, Path(folder))
        preparing = _peak("render", recipe, "--frames", "1-1")
        baking = _peak("render", recipe, "--frames", "2-9")
        layers = Sources(load(recipe), Cache(Path(folder) / FOLDER)).layer_keys
        facts = Cache(Path(folder) / FOLDER).facts()
    boxes = sum(width * height for _, _, width, height in (facts[key]["colour"] for key in layers))
    reference = (2 * boxes + 6 * LARGE.width * LARGE.height) * 4 * 4
    yield Row("memory of that, above the process after import", baking / 1e6, reference / 1e6, 1.0, "MB")
    yield Row("memory of cutting its layers and a first frame", preparing / 1e6, reference / 1e6, 1.0, "MB")


def _peak(*arguments) -> int:
    """Bytes that a command line held at most, beyond those it held when all was imported."""
    command = [sys.executable, str(Path(__file__).with_name("peak.py")), *map(str, arguments), "--progress", "none"]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=300)
    return int(done.stdout)
