"""Baking the large scene to half-float EXR: computing and writing together against each alone; and its memory."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from bench import Row, medians


def rows():
    yield _together()
    yield _memory()


def _together() -> Row:
    from scenes import LARGE, Bed
    from stillwater import _stillwater as engine

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


def _memory() -> Row:
    """Peak above the process after import, against 2 x the layers' boxes in float RGBA + 6 frames."""
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parent)}
    program = "import bake; bake.measure_memory()"
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True, timeout=300)
    peak, boxes = map(float, done.stdout.split())
    frame = 1920 * 1080 * 4 * 4
    return Row("memory of that, above the process after import", peak / 1e6, (2 * boxes * 16 + 6 * frame) / 1e6, 1.0, "MB")


def measure_memory() -> None:
    """Prints the bytes of the renderer and its frames (resident, not counting what making the scene took), and the
    layers' boxes in pixels."""
    import gc

    from scenes import LARGE, Bed

    def resident() -> int:
        return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    before = resident()
    bed = Bed(LARGE)
    gc.collect()
    for _ in range(3):
        bed.next_frame(flow=True)
    print(resident() - before, bed.boxes)
