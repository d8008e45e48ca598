"""Water: the height field for a new time against the bare transform, one thread each; and what a moment's map costs."""

from __future__ import annotations

import statistics
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from bench import Row, medians
from stillwater import Wind
from stillwater import _stillwater as engine

HERE = Path(__file__).parent


def reference_program(folder: str) -> Path:
    """The reference, compiled; see water_reference.cpp."""
    program = Path(folder) / "water_reference"
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "fftw3f"], capture_output=True, text=True, check=True).stdout
    source = HERE / "water_reference.cpp"
    subprocess.run(["g++", "-O3", "-march=native", str(source), "-o", str(program), *flags.split()], check=True, timeout=120)
    return program


def height_field(program: Path, side: int, runs: int = 101) -> Row:
    """Ours and the reference in turn."""
    waves = engine.Waves(60.0, side)
    waves.blow(5.0, 0.0)
    ours, theirs = [], []
    with subprocess.Popen([program, str(side)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as reference:
        for run in range(runs):
            reference.stdin.write("x")
            reference.stdin.flush()
            theirs.append(float(reference.stdout.readline()))
            start = time.perf_counter()
            waves.fill(run / 24)
            ours.append(time.perf_counter() - start)
        reference.stdin.close()
    return Row(
        f"water height field {side} x {side} for a new t, against FFTW's c2r",
        statistics.median(ours[5:]) * 1e3,
        statistics.median(theirs[5:]) * 1e3,
        1.5,
    )


def moment_of_a_frame() -> Iterator[Row]:
    """1280 x 720 with 60 % water, all threads: what a new moment costs, and its whole sampling map."""
    size, water = (1280, 720), (0, 288, 1280, 432)
    given, wind = engine.Ripple(), Wind()
    view = engine.View(horizon=((0, 288), (1280, 288)))
    motion = engine.RippleMotion(given, view, wind.moment(1).wind, size, water)
    frame = iter(range(1, 10_000))
    kept = motion.at(wind.moment(1), given)
    moment, sampling = medians(
        lambda: motion.at(wind.moment(next(frame)), given), lambda: kept.displacement_map(size), runs=31
    )
    yield Row("water of a 1280 x 720 frame, 60 % of it: a new moment", moment * 1e3, 6.0, 1.0)
    yield Row("the same: the sampling map of all pixels", sampling * 1e3, 6.0, 1.0)


def rows() -> Iterator[Row]:
    with tempfile.TemporaryDirectory() as folder:
        program = reference_program(folder)
        for side in (512, 1024):
            yield height_field(program, side)
    yield from moment_of_a_frame()
