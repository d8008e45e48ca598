"""Holes filled, against G'MIC's inpaint_matchpatch (Debian's gmic, installed here): time on two threads, and figures."""

from __future__ import annotations

import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from bench import Row
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "looks"))
THREADS, RUNS = 2, 5


def rows():
    import stillwater
    from fill_figures import figures_of
    from stillwater import _stillwater as engine

    engine.set_threads(THREADS)
    picture, hole = scene(360, 480), lobed(360, 480, 107)
    pixels = int(hole.sum())
    gmic = _gmic()
    with tempfile.TemporaryDirectory() as folder:
        ours, theirs = [], []
        for _ in range(RUNS):
            theirs.append(gmic.seconds(picture, hole, Path(folder)))
            ours.append(_seconds(lambda: stillwater.inpaint(picture, hole)))
        yield Row(
            f"inpainting 360x480, hole {pixels // 1000}k px (inpaint_matchpatch)",
            statistics.median(ours),
            statistics.median(theirs),
            1,
            "s",
        )
        mine = figures_of(stillwater.inpaint(picture, hole)[..., :3], hole)
        other = figures_of(gmic.filled(picture, hole, Path(folder)), hole)
        yield Row("  distance of its patches to the nearest outside", mine.coherence, other.coherence, 1, "level")
        yield Row("  largest share from one 32 px neighbourhood", mine.repetition, other.repetition, 1, "share")
    picture, hole = scene(1920, 1080), lobed(1920, 1080, 252)
    seconds = statistics.median(_seconds(lambda: stillwater.inpaint(picture, hole)) for _ in range(3))
    yield Row(f"inpainting 1920x1080, hole {int(hole.sum()) // 1000}k px", seconds, 4, 1, "s")
    wide = scene(1920, 540)
    yield Row(
        "make_cyclic 1920x540 (as fast as that hole, by pixels)",
        _seconds(lambda: stillwater.make_cyclic(wide)),
        4 * 480 * 540 / 2e5,
        1,
        "s",
    )


def scene(width: int, height: int) -> np.ndarray:
    """A sky, a shore with a fence, water and grain: lines, bands and textures of several sizes."""
    from scipy.ndimage import gaussian_filter

    rng = np.random.default_rng(4)
    y, x = np.mgrid[:height, :width] / height
    noise = lambda *sigma: gaussian_filter(rng.normal(size=(height, width)), sigma)  # noqa: E731
    clouds, waves, leaves = noise(9, 30), noise(1, 9), noise(2, 2)
    sky = np.stack([0.5 + 0.3 * y, 0.6 + 0.2 * y, 0.85 + 0 * y], 2) + (clouds / clouds.std() * 0.06)[..., None]
    sea = np.stack([0.15 + 0 * y, 0.3 + 0.1 * y, 0.4 + 0.1 * y], 2) + (waves / waves.std() * 0.07)[..., None]
    shore = np.stack([0.3 + 0 * y, 0.38 + 0 * y, 0.15 + 0 * y], 2) + (leaves / leaves.std() * 0.1)[..., None]
    picture = np.where((y < 0.42)[..., None], sky, sea)
    picture = np.where((y > 0.75 + 0.1 * x)[..., None], shore, picture)
    fence = ((x * height) % 24 < 4) & (y > 0.6) & (y < 0.72) | (abs(y - 0.63) < 0.006)
    picture[fence] = (0.8, 0.76, 0.7)
    return np.clip(picture + 0.01 * rng.normal(size=picture.shape), 0, 1).astype(np.float32)


def lobed(width: int, height: int, radius: float) -> np.ndarray:
    y, x = np.mgrid[:height, :width]
    angle = np.arctan2(y - height * 0.55, x - width / 2)
    return np.hypot(y - height * 0.55, x - width / 2) < radius * (
        1 + 0.15 * np.cos(5 * angle) + 0.1 * np.sin(3 * angle)
    )


class _gmic:
    """The program; what it takes to start, read and write is not counted."""

    def __init__(self):
        if not shutil.which("gmic"):
            install = ["apt-get", "install", "-y", "-qq", "--no-install-recommends", "gmic"]
            as_root = [] if os.geteuid() == 0 else ["sudo"]
            subprocess.run([*as_root, *install], check=True, stdout=subprocess.DEVNULL)

    def _run(self, folder: Path, *method: str) -> float:
        files = [str(folder / name) for name in ("picture.png", "hole.png")]
        line = ["gmic", *files, *method, "keep[0]", "output", str(folder / "out.png")]
        environment = {**os.environ, "OMP_NUM_THREADS": str(THREADS)}
        return _seconds(lambda: subprocess.run(line, check=True, capture_output=True, env=environment))

    def _write(self, picture: np.ndarray, hole: np.ndarray, folder: Path) -> None:
        for name, image in (("picture", np.where(hole[..., None], 0, picture)), ("hole", hole)):
            Image.fromarray((image * 255 + 0.5).astype(np.uint8)).save(folder / f"{name}.png")

    def seconds(self, picture: np.ndarray, hole: np.ndarray, folder: Path) -> float:
        self._write(picture, hole, folder)
        return self._run(folder, "inpaint_matchpatch[0]", "[1]") - self._run(folder)

    def filled(self, picture: np.ndarray, hole: np.ndarray, folder: Path) -> np.ndarray:
        self._write(picture, hole, folder)
        self._run(folder, "inpaint_matchpatch[0]", "[1]")
        out = np.asarray(Image.open(folder / "out.png").convert("RGB"), np.float32) / 255
        return np.where(hole[..., None], out, picture)


def _seconds(work) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start
