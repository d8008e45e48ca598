"""One video example: a clip taken apart; a final frame of the film and a quick one, at the size of the paper's waterfall."""

from __future__ import annotations

import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from bench import Row, medians
from stillwater import _stillwater as engine
from stillwater import analyse

FRAMES, WIDTH, HEIGHT = 150, 640, 360
PICTURE = (405, 399)
LIFE, PACE = 16, 1.0


def rows() -> Iterator[Row]:
    if shutil.which("ffmpeg"):
        yield from analysis()
    yield film("a final frame of a film 405 x 399, 8 x 8 cells, 3 times", 1.0, "steerable", 3, 400.0)
    yield film("the same for a quick look: Laplacian, half size, once", 0.5, "laplacian", 1, 1000 / 24)


def analysis() -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as folder:
        clip = written(Path(folder) / "clip.mp4")
        taken = []
        for _ in range(3):
            start = time.perf_counter()
            analyse(clip)
            taken.append(time.perf_counter() - start)
        yield Row(f"a clip taken apart, {FRAMES} frames {WIDTH} x {HEIGHT}", statistics.median(taken), 6.0, 1.0, "s")
        command = [sys.executable, str(Path(__file__).with_name("peak.py")), "analyse", str(clip), "-o", f"{folder}/a.npz"]
        said = subprocess.run(command, check=True, capture_output=True, text=True, timeout=300).stdout
        yield Row("memory of that, above the process after import", int(said.split()[-1]) / 1e6, 1200.0, 1.0, "MB")


def written(path: Path) -> Path:
    """Noise that runs down."""
    rng = np.random.default_rng(0)
    tall = rng.integers(0, 255, (HEIGHT + 3 * FRAMES, WIDTH, 3), np.uint8)
    frames = np.stack([tall[3 * (FRAMES - t) :][:HEIGHT] // 2 + rng.integers(0, 120, (HEIGHT, WIDTH, 1), np.uint8) for t in range(FRAMES)])
    coding = f"ffmpeg -v error -y -f rawvideo -pix_fmt rgb24 -s {WIDTH}x{HEIGHT} -r 24 -i - -c:v libx264 -preset ultrafast -crf 20"
    subprocess.run([*coding.split(), str(path)], input=frames.tobytes(), check=True, timeout=120)
    return path


def film(work: str, scale: float, matching: str, repetitions: int, limit: float) -> Row:
    next_frame = player(scale, matching, repetitions)
    (seconds,) = medians(next_frame, runs=9)
    return Row(work, seconds * 1e3, limit, 1.0)


def player(scale: float, matching: str, repetitions: int) -> Callable[[], object]:
    """A function that makes the next frame of a film of noise."""
    engine.set_threads(0)
    width, height = PICTURE
    rng = np.random.default_rng(1)
    picture = rng.random((height, width, 4), np.float32)
    picture[..., 3] = 1
    down = np.zeros((height, width, 2), np.float32)
    down[..., 1] = 3
    residuals = rng.normal(0, 0.1, (40, height, width, 3)).astype(np.float16)
    transfer = engine.TransferParameters()
    patches = engine.match_patches(down, down, np.ones((height, width), np.float32), transfer)
    look = engine.LookParameters(
        shutter=0.2, fps=24, average_blur=8, grid=(8, 8), repetitions=repetitions, matching=matching, stylize=1
    )  # fmt: skip
    setup = engine.ExampleSetup(
        residuals=residuals, patches=patches, strokes=[], transfer=transfer, reach=1.0, velocities=[down], freeze=None,
        life=LIFE, endless=True, period=0, look=look,
    )  # fmt: skip
    (layer,) = engine.peel(picture, [None], [engine.Fill.none], [0.0])
    made = engine.make_look(engine.make_plates(layer, None, PICTURE, scale, None, example=setup))
    plates = engine.make_plates(layer, None, PICTURE, scale, None, example=setup, look=made)
    renderer = engine.FrameRenderer(PICTURE, scale, engine.View(), engine.Wind(), [engine.Layer(plates, engine.Example())])
    frame = 0

    def next_frame() -> object:
        nonlocal frame
        frame += 1
        now, after = (engine.LayerState(1.0, engine.Example(moment=LIFE + (frame + ahead) * PACE, step=PACE)) for ahead in (0, 1))
        return renderer.render(engine.Moment(), engine.Moment(), [now], [after], flow=True)

    return next_frame
