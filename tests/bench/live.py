"""One live frame of the lake at 960 x 540: all that the extension does at a new frame, within Blender (the bpy package).

Blender's own redraw is not in it. Where the bpy package was not installed yet, setup/blender.sh does.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from bench import Row

REPOSITORY = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("STILLWATER_BUILD", REPOSITORY / "build"))
LIMITS = {"all": 12.0, "engine": 12.0, "slider": 50.0}  # ms
WORKS = {
    "all": "live frame in Blender, lake, 864x540",
    "engine": "... the engine's part of it",
    "slider": "live, a slider moved: recipe, motions, frame",
}


def rows():
    python = BUILD / "blender-venv" / "bin" / "python"
    archives = sorted(BUILD.glob("stillwater-*.zip"))
    if not python.exists() or not archives:
        print("live: left out, the extension is not built here (bash tests/run.sh blender)", file=sys.stderr)
        return
    with tempfile.TemporaryDirectory() as profile:
        command = [str(python), str(Path(__file__).with_name("live_in_blender.py")), str(archives[0])]
        environment = {**os.environ, "BLENDER_USER_RESOURCES": profile}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300)
    lines = [line.split() for line in done.stdout.splitlines() if line.startswith("ms ")]
    if not lines:
        print(f"live: {done.stderr.strip().splitlines()[-1]}", file=sys.stderr)
    for _, name, value in lines:
        yield Row(WORKS[name], float(value), LIMITS[name], 1.0)
