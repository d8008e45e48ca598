"""Writing frames, against OpenImageIO that is simply given float arrays of the same channels.

OpenImageIO gets scene-linear floats and makes the same half and float channels of them, with its usual zip. Ours starts
from what the engine has, display-referred premultiplied colours, so the curve is in our time. What makes the difference
is the flow's mantissa, of which we keep 12 bits, and zip's level, 2 instead of 4; the note has both files' sizes. A
second row shows OpenImageIO with the flow rounded already.
"""

from __future__ import annotations

import shlex
import statistics
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from bench import Row
from stillwater import _stillwater as engine

WIDTH, HEIGHT = 1920, 1080
RUNS = 9


def painted(rng: np.random.Generator) -> np.ndarray:
    """A picture with detail at all sizes and the grain of a brush, in 8 bits."""
    picture = np.zeros((HEIGHT, WIDTH, 3), np.float32)
    for cell in (240, 120, 60, 30, 15, 5):
        coarse = rng.normal(0, 1, (HEIGHT // cell + 2, WIDTH // cell + 2, 3)).astype(np.float32)
        y, x = np.arange(HEIGHT) / cell, np.arange(WIDTH) / cell
        i, j = y.astype(int), x.astype(int)
        v, u = (y - i)[:, None, None], (x - j)[None, :, None]
        top = coarse[i][:, j] * (1 - u) + coarse[i][:, j + 1] * u
        bottom = coarse[i + 1][:, j] * (1 - u) + coarse[i + 1][:, j + 1] * u
        picture += (top * (1 - v) + bottom * v) * (cell / 240) ** 0.7 * 0.12
    picture += rng.normal(0, 0.004, picture.shape)
    return np.rint(np.clip(picture + 0.45, 0, 1) * 255).astype(np.float32) / 255


def moving(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """The flow of a sea below, of a few trees above, and where they are."""
    y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float32)
    matte = ((y > HEIGHT * 0.55) | (np.sin(x / 140) * np.sin(y / 170) > 0.4)).astype(np.float32)
    waves = sum(np.sin(x * kx + y * ky + phase) for kx, ky, phase in rng.normal(0, 0.03, (8, 3)))
    flow = np.stack([0.6 * np.cos(x / 90 + y / 200) + 0.1 * waves, 0.4 * waves], 2) * matte[..., None]
    return flow.astype(np.float32), matte


def built(folder: Path) -> Path:
    """The reference program."""
    flags = subprocess.run(
        ["pkg-config", "--cflags", "--libs", "OpenImageIO"], capture_output=True, text=True, check=True
    )
    source = Path(__file__).with_name("openimageio_frame.cpp")
    subprocess.run(
        ["g++", "-O2", "-std=c++17", str(source), "-o", str(folder / "reference"), *shlex.split(flags.stdout)],
        check=True,
    )
    return folder / "reference"


def interleaved(write, references: list[subprocess.Popen]) -> tuple[float, ...]:
    """Median seconds of our write and of each reference, in turn, after one round of warm-up."""
    taken: list[list[float]] = [[] for _ in range(len(references) + 1)]
    for _ in range(RUNS + 1):
        start = time.perf_counter()
        write()
        taken[0].append(time.perf_counter() - start)
        for reference, seconds in zip(references, taken[1:], strict=True):
            reference.stdin.write(".")
            reference.stdin.flush()
            seconds.append(float(reference.stdout.readline()))
    return tuple(statistics.median(seconds[1:]) for seconds in taken)


def rows() -> Iterator[Row]:
    rng = np.random.default_rng(1)
    picture = painted(rng)
    flow, matte = moving(rng)
    combined = np.concatenate([picture, np.ones((HEIGHT, WIDTH, 1), np.float32)], 2)
    scene = engine.display_to_scene(combined)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        program = built(folder)
        references = []
        for i, given in enumerate((flow, engine.round_mantissa(flow))):
            channels = np.concatenate([scene, scene, given, np.zeros_like(given[..., :1]), matte[..., None]], 2)
            channels.astype(np.float32).tofile(folder / f"{i}.raw")
            command = [program, str(WIDTH), str(HEIGHT), folder / f"{i}.raw", folder / f"{i}.exr"]
            references.append(subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True))
        ours, plain, rounded = interleaved(
            lambda: engine.write_frame(str(folder / "ours.exr"), combined, flow, matte), references
        )
        for reference in references:
            reference.stdin.close()
            reference.wait(30)
        ours_size, plain_size = ((folder / name).stat().st_size / 1e6 for name in ("ours.exr", "0.exr"))
    size = f"{ours_size:.1f} MB against {plain_size:.1f}"
    yield Row("write a 1920x1080 frame, zip, half + float flow", 1e3 * ours, 1e3 * plain, 0.8, note=size)
    yield Row("the same, OpenImageIO given the flow rounded to 12 bits", 1e3 * ours, 1e3 * rounded, 1.0)
