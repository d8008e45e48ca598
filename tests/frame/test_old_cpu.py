"""On a CPU that has SSE4.2 and nothing later (qemu-user plays one, and stops at any later instruction), the engine runs
from the picture to the EXR, and gives the frames that it gives here."""

import functools
import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from stage import Stage
from stillwater import _stillwater as engine

QEMU = "qemu-x86_64"
OLD_CPU = [QEMU, "-cpu", "Nehalem"]


@functools.cache
def why_not():
    """Why no old CPU can be played here, or nothing."""
    if "STILLWATER_SANITIZED" in os.environ:
        return "the sanitizers and qemu can't share a process"
    if platform.machine().lower() not in ("x86_64", "amd64"):
        return f"this machine is no x86-64 but {platform.machine()}"
    if shutil.which(QEMU) is None:
        return f"{QEMU} (Debian's package qemu-user) is not here"
    tried = subprocess.run([*OLD_CPU, sys.executable, "-c", "import numpy"], capture_output=True, text=True, timeout=60)
    return f"{QEMU} can't run Python and numpy here: {tried.stderr.strip()[-200:]}" if tried.returncode else ""


@pytest.fixture
def on_old_cpu():
    """`on_old_cpu(argument, ...)` runs this Python there."""
    if reason := why_not():
        pytest.skip(reason)

    def run(*arguments):
        line = [*OLD_CPU, sys.executable, *map(str, arguments)]
        done = subprocess.run(line, capture_output=True, text=True, timeout=100, stdin=subprocess.DEVNULL)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


def test_a_frame_in_memory(on_old_cpu, tmp_path):
    program = f"""
import sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
import numpy as np
from stage import Stage
from stillwater import _stillwater as engine
assert not engine.has_avx2()
frame = Stage(gusts=0.5).frame(17)
np.savez({str(tmp_path / "there.npz")!r}, combined=frame.combined, flow=frame.flow, matte=frame.matte)
"""
    on_old_cpu("-c", program)
    here = Stage(gusts=0.5).frame(17)
    there = np.load(tmp_path / "there.npz")
    for channel in ("combined", "flow", "matte"):
        expected = getattr(here, channel)
        assert expected.any()
        assert np.abs(there[channel] - expected).max() < 1e-3, channel


def test_the_whole_way_to_a_file(on_old_cpu, scene, command, tmp_path):
    path = scene(lambda recipe: recipe["layers"][2]["motion"].update(shimmer=0.5))
    ask = ("render", path, "--frames", "3-3", "--fresh", "--progress", "none", "--output")
    here = command(*ask, tmp_path / "here")
    assert here.returncode == 0, here.stderr
    on_old_cpu("-m", "stillwater", *ask, tmp_path / "there")
    expected, given = (engine.read_frame(str(tmp_path / place / "frame_0003.exr")) for place in ("here", "there"))
    assert np.abs(given - expected).max() < 1e-3
