"""Animated numbers: the value at a frame, and its integral from frame 1.

A number is held outside its keys. In a loop it repeats with the period of the recipe's range; where its ends differ
it is blended, over the last tenth, into what stood one period earlier.
"""

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from .parts import Keys

BLENDED_SHARE = 0.1  # of the loop


@dataclass(frozen=True)
class Loop:
    """The frames that repeat: first .. last, and first again."""

    first: int
    last: int

    @property
    def period(self) -> int:
        return self.last - self.first + 1

    @property
    def blended(self) -> int:
        """How many of the last frames are blended where the ends differ."""
        return max(1, round(self.period * BLENDED_SHARE))


class Track:
    """A number for every frame: `values` from frame `first` on, the end values held outside, or repeated in a loop.

    Asking costs the same at any frame. The integral is the trapezoid's, in value x frames: zero at frame 1, negative
    before. It is summed outwards from frame 1, so that values further out never change what lies nearer, in twice the
    precision, and rounded once: so it does not depend on whether a number is keyed or held.
    """

    def __init__(self, first: int, values, loop: Loop | None = None):
        self.first, self.loop = first, loop
        self.values = np.asarray(values, dtype=np.float64)
        self._sums = None

    @classmethod
    def of(cls, number: float | Keys, loop: Loop | None = None, component: int | None = None) -> "Track":
        """The track of an animated number of the recipe, or of one component of an animated pair."""
        first, values = (number.first, number.values) if isinstance(number, Keys) else (1, [number])
        values = [value if component is None else value[component] for value in values]
        if len(values) == 1:
            return cls(1, values, loop)
        keyed = cls(first, values)
        if loop is None:
            return keyed
        inside = np.array([keyed.at(frame) for frame in range(loop.first, loop.last + 1)])
        if ends_differ(keyed, loop):
            for step in range(loop.blended):
                frame = loop.last - step
                share = 1 - (step + 1) / (loop.blended + 1)
                inside[frame - loop.first] += share * (keyed.at(frame - loop.period) - inside[frame - loop.first])
        return cls(loop.first, inside, loop)

    def at(self, frame: int) -> float:
        """The value at a frame."""
        place = frame - self.first
        if self.loop is not None:
            return float(self.values[place % len(self.values)])
        return float(self.values[min(max(place, 0), len(self.values) - 1)])

    def integral(self, frame: int) -> float:
        """From frame 1 to a frame."""
        if self._sums is None:
            self._sums = self._sum()
        sums, start = self._sums
        if self.loop is not None and len(self.values) > 1:
            turns, place = divmod(frame - 1, len(sums) - 1)
            return float(turns * sums[-1] + sums[place])
        place = frame - start
        if place < 0:
            return float(sums[0] + place * Fraction(self.values[0]))
        beyond = place - (len(sums) - 1)
        return float(sums[-1] + beyond * Fraction(self.values[-1]) if beyond > 0 else sums[place])

    def over_loop(self) -> float:
        """The integral over one period; 0 without a loop."""
        return 0.0 if self.loop is None else self.integral(1 + self.loop.period)

    def _sum(self) -> tuple[list[Fraction], int]:
        """Integrals at consecutive frames, and the frame of the first of them."""
        if self.loop is not None and len(self.values) > 1:
            return _outwards([self.at(frame) for frame in range(1, len(self.values) + 2)]), 1
        low, high = min(self.first, 1), max(self.first + len(self.values) - 1, 1)
        after = _outwards([self.at(frame) for frame in range(1, high + 1)])
        before = _outwards([self.at(frame) for frame in range(1, low - 1, -1)])
        return [*(-area for area in before[:0:-1]), *after], low


def combine(function: Callable, *tracks: Track) -> Track:
    """The track of `function` of the values of several tracks of one recipe."""
    loop = tracks[0].loop
    if all(len(track.values) == 1 for track in tracks):
        first = last = 1
    elif loop is not None:
        first, last = loop.first, loop.last
    else:
        first = min(track.first for track in tracks)
        last = max(track.first + len(track.values) - 1 for track in tracks)
    return Track(first, [function(*(track.at(frame) for track in tracks)) for frame in range(first, last + 1)], loop)


def ends_differ(keyed: Track, loop: Loop) -> bool:
    """Whether a number jumps where the loop closes: neither its last value nor the one after is its first."""
    start = keyed.at(loop.first)
    near = 1e-9 * float(np.abs(keyed.values).max())
    return all(not math.isclose(keyed.at(end), start, rel_tol=0, abs_tol=near) for end in (loop.last, loop.last + 1))


def _outwards(values: list[float]) -> list[Fraction]:
    """Areas under a line from its first point to each point: sums of two doubles (Knuth's two-sum)."""
    areas, high, low = [Fraction(0)], 0.0, 0.0
    for a, b in itertools.pairwise(values):
        piece = (a + b) / 2
        total = high + piece
        back = total - high
        low += (high - (total - back)) + (piece - back)
        high = total
        areas.append(Fraction(high) + Fraction(low))
    return areas
