"""Frames in memory: the paper's sizes and a large picture, all cores."""

from __future__ import annotations

from bench import Row, medians
from scenes import LARGE, PAPER, Bed


def rows():
    for scene in PAPER:
        yield _row(scene, 60)
    yield _row(LARGE, 24)
    yield _row(LARGE, 18, flow=True)


def _row(scene, fps: float, flow: bool = False) -> Row:
    bed = Bed(scene)
    (seconds,) = medians(lambda: bed.next_frame(flow), runs=21)
    what = "with flow" if flow else "picture only"
    return Row(f"frame in memory, {scene.name}, {what} ({fps:.0f} fps)", seconds * 1e3, 1e3 / fps, 1.0)
