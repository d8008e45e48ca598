"""One full 1920x1080 layer displaced and laid over a background, against cv::remap (cubic) alone; one thread each."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
from bench import Row, medians

WIDTH, HEIGHT = 1920, 1080


def rows():
    yield from _rows("AVX2", 0.7)
    # The engine picks its way once a process: the plain one needs a process of its own.
    program = "import displace; print(*displace.measure())"
    environment = {**os.environ, "STILLWATER_CPU": "sse4.2", "PYTHONPATH": os.path.dirname(__file__)}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, timeout=300)
    ours, theirs = map(float, done.stdout.split())
    yield Row("displace + over 1920x1080, SSE4.2 (cv::remap: its best)", ours * 1e3, theirs * 1e3, 1.0)


def _rows(way: str, limit: float):
    ours, theirs = measure()
    yield Row(f"displace + over 1920x1080, {way}", ours * 1e3, theirs * 1e3, limit)


def measure() -> tuple[float, float]:
    """Median seconds of ours and of cv::remap."""
    import cv2
    from stillwater import _stillwater as engine

    engine.set_threads(1)
    cv2.setNumThreads(1)
    rng = np.random.default_rng(3)
    image, back = rng.random((2, HEIGHT, WIDTH, 4), np.float32)
    y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float32)
    map = np.stack([6 * np.sin(y / 40), 4 * np.cos(x / 60)], axis=2).astype(np.float32)
    source = engine.Source(image)
    map_x, map_y = x + map[..., 0], y + map[..., 1]
    out = np.empty_like(image)
    return medians(
        lambda: engine.displace_over(source, map, back),
        lambda: cv2.remap(image, map_x, map_y, cv2.INTER_CUBIC, dst=out, borderMode=cv2.BORDER_REPLICATE),
        runs=15,
    )
