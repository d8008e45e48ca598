"""Mattes and foreground colours against PyMatting's closed form and multilevel method, in one run.

Ours is the whole of `stillwater.matte`: colours compared, the closed form solved, haze taken off.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from bench import Row, medians

SIZES = {"340x220, 10k unknown": (340, 220, 0.13), "1920x1280, 300k unknown": (1920, 1280, 0.12)}
MEGABYTE = 1e6


@dataclass(frozen=True)
class Scene:
    picture: np.ndarray  # height x width x 3
    alpha: np.ndarray
    trimap: np.ndarray


def scene(width: int, height: int, share: float = 0.12, hairs: float = 1, soft: float = 0.1) -> Scene:
    """Something with a wavy, hairy edge over another texture; about `share` of it is unknown, `soft` the edge's width."""
    import scipy.ndimage

    rng = np.random.default_rng(5)
    y, x = np.mgrid[:height, :width]
    x, y = x - width / 2, y - height / 2
    turn, radius = np.arctan2(y, x), np.hypot(x, y) / height
    hair = 0.02 * np.sin(9 * turn) + hairs * (0.03 * np.sin(97 * turn + 40 * radius) + 0.01 * np.sin(311 * turn))
    alpha = np.clip((0.3 + hair - radius) / soft + 0.5, 0, 1)

    def texture(colour, scale):
        noise = np.stack([scipy.ndimage.gaussian_filter(rng.standard_normal((height, width)), scale) for _ in range(3)], axis=2)
        return np.clip(colour + 0.08 * noise / noise.std() + 0.01 * rng.standard_normal((height, width, 3)), 0, 1)

    picture = alpha[..., None] * texture([0.7, 0.5, 0.3], 8) + (1 - alpha[..., None]) * texture([0.2, 0.4, 0.5], 16)
    band = share * width / (4 * np.pi * 0.3)  # of the picture's height, on each side
    trimap = np.where(abs(radius - 0.3) < band / height, 0.5, radius < 0.3)
    return Scene(picture.astype(np.float32), alpha.astype(np.float32), trimap.astype(np.float32))


def rows():
    yield from _mattes()
    yield from _memory()
    yield _foreground()
    yield from _one_more_scribble()


def _mattes():
    import stillwater

    for (name, size), faster, runs in zip(SIZES.items(), (2, 5), (7, 1), strict=True):
        given = scene(*size)
        ours, theirs = medians(
            lambda given=given: stillwater.matte(given.picture, given.trimap),
            lambda given=given: _pymatting(given),
            runs=runs,
            warmup=runs // 3,
        )
        unknown = int((given.trimap == 0.5).sum())
        yield Row(f"matte {name} (PyMatting)", ours * 1e3, theirs * 1e3, 1 / faster, note=f"{unknown} unknown")


def _memory():
    name, size = list(SIZES.items())[1]
    ours, theirs = (_peak(which, size) for which in ("ours", "theirs"))
    yield Row(f"matte {name}, memory (PyMatting)", ours / MEGABYTE, theirs / MEGABYTE, 1 / 4, unit="MB")


def _foreground() -> Row:
    import pymatting
    import stillwater

    given = scene(1920, 1280)
    ours, theirs = medians(
        lambda: stillwater.foreground(given.picture, given.alpha),
        lambda: pymatting.estimate_foreground_ml(given.picture, given.alpha, return_background=True),
        runs=5,
        warmup=1,
    )
    return Row("foreground colours 1920x1280 (PyMatting)", ours * 1e3, theirs * 1e3, 1 / 1.5)


def _one_more_scribble():
    from stillwater import _stillwater as engine

    given = scene(1280, 720, hairs=0.3, soft=0.02)
    picture = np.dstack([given.picture, np.ones((720, 1280), np.float32)])
    inside, outside = ([[640 + r * 7.2 * np.cos(t), 360 + r * 7.2 * np.sin(t)] for t in np.arange(0, 6.2, 0.2)] for r in (15, 46))
    strokes = [{"points": inside, "width": 5}, {"points": [[610, 330], [660, 380]], "width": 5}]
    preview, final = engine.MatteOptions(), engine.MatteOptions()
    preview.finest = 2

    def matte(options):
        import stillwater

        scribbles = {"foreground": strokes, "background": [{"points": outside, "width": 5}]}
        return engine.matte(picture, stillwater.trimap(given.picture, scribbles=scribbles), options)

    fast, whole = medians(lambda: matte(preview), lambda: matte(final), runs=5, warmup=1)
    apart = np.abs(matte(preview) - matte(final)).sum() / matte(final).sum()
    yield Row("one more scribble 1280x720, a preview", fast * 1e3, 300, 1, note=f"{apart:.2%} SAD from the final matte")
    yield Row("one more scribble 1280x720, preview's SAD from the final matte", apart * 100, 2, 1, unit="%")
    yield Row("one more scribble 1280x720, the final matte", whole * 1e3, 2000, 1)


def _pymatting(given: Scene):
    import warnings

    import pymatting

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that its incomplete Cholesky is tried again
        return pymatting.estimate_alpha_cf(given.picture.astype(float), given.trimap.astype(float))


def _peak(which: str, size) -> float:
    """Bytes that one matte takes at most, beyond what the process holds after a small one, in a process of its own."""
    program = f"import matting; matting.print_peak({which!r}, {size!r})"
    environment = {**os.environ, "PYTHONPATH": os.path.dirname(__file__)}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, timeout=900)
    return float(done.stdout.splitlines()[-1])


def print_peak(which: str, size) -> None:
    import stillwater

    def held(what: str) -> int:
        (line,) = (line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith(what))
        return int(line.split()[1]) * 1024

    work = {"ours": lambda given: stillwater.matte(given.picture, given.trimap), "theirs": _pymatting}[which]
    work(scene(64, 48, 0.3))  # whatever is compiled or read once
    given = scene(*size)
    Path("/proc/self/clear_refs").write_text("5")  # the peak starts anew
    before = held("VmRSS")
    start = time.perf_counter()
    work(given)
    print(f"{time.perf_counter() - start:.1f} s", file=sys.stderr)
    print(held("VmHWM") - before)
