"""Benches that run inside Blender: the built extension in an empty profile, a process each."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
BUILD = Path(os.environ.get("STILLWATER_BUILD", HERE.parents[1] / "build"))
LIMIT = 120  # seconds


def inside(name: str) -> dict[str, float]:
    """What inside/NAME.py measured: the last line that it printed."""
    (archive,) = BUILD.glob("stillwater-*.zip")
    with tempfile.TemporaryDirectory(prefix="stillwater-profile-", ignore_cleanup_errors=True) as profile:
        command = [str(BUILD / "blender-venv/bin/python"), str(HERE / "inside" / f"{name}.py"), str(archive)]
        environment = {**os.environ, "BLENDER_USER_RESOURCES": profile}
        done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=LIMIT)
    if done.returncode:
        raise RuntimeError(f"{name}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
    return json.loads(done.stdout.splitlines()[-1])
