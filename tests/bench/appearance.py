"""Appearance: the steerable pyramid against pyrtools; texture matching of a final frame and of a quick one."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator

import numpy as np
from bench import Row, medians
from stillwater import _stillwater as engine


def noise(height: int, width: int, seed: int) -> np.ndarray:
    """Opaque noise, premultiplied."""
    image = np.random.default_rng(seed).random((height, width, 4), np.float32)
    image[..., 3] = 1
    return image


def cpu_seconds(work: Callable[[], object], runs: int = 7) -> float:
    """Median over all threads, one thread asked for."""
    engine.set_threads(1)
    taken = []
    for _ in range(runs):
        start = time.process_time()
        work()
        taken.append(time.process_time() - start)
    engine.set_threads(0)
    return statistics.median(taken)


def pyramid() -> Row:
    from pyrtools.pyramids import SteerablePyramidFreq

    plane = noise(512, 512, 0)[..., 0].copy()
    doubles = plane.astype(float)

    def ours() -> None:
        highpass, bands, _, lowpass = engine.steerable_pyramid(plane, 4, 4, False)
        engine.collapse_steerable(highpass, bands, lowpass)

    taken, reference = medians(ours, lambda: SteerablePyramidFreq(doubles, 4, 3).recon_pyr(), runs=15)
    work = "steerable pyramid 512 x 512, 4 scales, 4 orientations, pyrtools"
    return Row(work, taken * 1e3, reference * 1e3, 1 / 20)


def matching(height: int, width: int, grid: tuple[int, int], how: str, repetitions: int) -> Callable[[], object]:
    target = engine.TextureTarget(noise(height, width, 1), grid, 0, 4, how)
    frame = noise(height, width, 2)
    return lambda: engine.match_texture(frame, target, repetitions, 1.0)


def rows() -> Iterator[Row]:
    yield pyramid()
    seconds = cpu_seconds(matching(256, 256, (4, 4), "steerable", 5))
    yield Row("texture matching 256 x 256, 4 x 4 cells, 5 times: CPU", seconds * 1e3, 250, 1)
    final, quick = medians(
        matching(399, 405, (8, 8), "steerable", 3), matching(200, 202, (8, 8), "laplacian", 1), runs=9
    )
    yield Row("texture matching of a frame 405 x 399, 8 x 8 cells, 3 times", final * 1e3, 250, 1)
    yield Row("the same for a quick look: Laplacian, half size, once", quick * 1e3, 20, 1)
