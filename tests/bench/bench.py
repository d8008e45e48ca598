"""What every bench shares: a row of the table, and medians of interleaved runs.

A bench is a file beside this one with `rows()`, which yields a Row for each line of the table. Ours and the
reference are measured in the same run, in turn, so that a machine that slows down slows both.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """One line: ours against a reference, both in `unit`; the ratio ours / reference must not pass `limit`.

    Where there is no reference program, `reference` is the figure that must be reached and `limit` is 1.
    """

    work: str
    ours: float
    reference: float
    limit: float
    unit: str = "ms"
    note: str = ""

    @property
    def ratio(self) -> float:
        return self.ours / self.reference

    @property
    def reached(self) -> bool:
        return self.ratio <= self.limit


def medians(*works: Callable[[], object], runs: int = 15, warmup: int = 3) -> tuple[float, ...]:
    """Median seconds of each work over `runs` rounds; a round runs every work once."""
    for work in works:
        for _ in range(warmup):
            work()
    seconds: list[list[float]] = [[] for _ in works]
    for _ in range(runs):
        for work, taken in zip(works, seconds, strict=True):
            start = time.perf_counter()
            work()
            taken.append(time.perf_counter() - start)
    return tuple(statistics.median(taken) for taken in seconds)
