"""What is out of date and why, in words. Knows nothing of Blender or the engine."""

from collections.abc import Iterable
from dataclasses import dataclass

RANGES, CLAUSES = 3, 6  # so many are written out
READY, MISSING, STALE = "ready", "missing", "stale"


@dataclass(frozen=True)
class Report:
    """How a picture's frames stand. `problem`: why that can't be said."""

    ready: int = 0
    missing: tuple[tuple[int, int], ...] = ()
    stale: tuple[tuple[int, int], ...] = ()
    why: tuple[tuple[str, tuple[tuple[int, int], ...]], ...] = ()  # clause, ranges
    problem: str = ""

    @property
    def words(self) -> str:
        """The state in two or three words, for the node's label; empty where it can't be said."""
        if self.problem:
            return ""
        if self.stale:
            return "out of date"
        if self.missing and not self.ready:
            return "not baked"
        return "frames missing" if self.missing else "ready"

    @property
    def lines(self) -> list[str]:
        """What a panel says, line by line."""
        if self.problem:
            return [self.problem]
        if not self.stale and not self.missing:
            return [f"All {self.ready} frames are ready" if self.ready > 1 else "The frame is ready"]
        if not self.stale and not self.ready:
            return ["Not baked yet"]
        told = [f"{_capital(clause)}: {_frames(ranges)}" for clause, ranges in self.why[:CLAUSES]]
        if len(self.why) > CLAUSES:
            told.append(f"And {len(self.why) - CLAUSES} more changes")
        return [*told, *([f"Missing, the nearest is shown: {_frames(self.missing)}"] if self.missing else [])]

    @property
    def is_ready(self) -> bool:
        return not (self.problem or self.stale or self.missing)

    def at(self, frame: int) -> str:
        """How one frame stands."""
        if any(first <= frame <= last for first, last in self.missing):
            return MISSING
        return STALE if any(first <= frame <= last for first, last in self.stale) else READY


def report(spans: Iterable, by_reason: dict[str, list[tuple[int, int]]]) -> Report:
    """From the engine's ranges of frames (first, last, state) and its reasons."""
    spans = list(spans)
    ranges = {state: _merged((s.first, s.last) for s in spans if s.state == state) for state in (READY, MISSING, STALE)}
    why = tuple((clause, tuple(found)) for clause, found in by_reason.items())
    return Report(_count(ranges[READY]), ranges[MISSING], ranges[STALE], why)


def _merged(ranges: Iterable[tuple[int, int]]) -> tuple[tuple[int, int], ...]:
    merged: list[tuple[int, int]] = []
    for first, last in ranges:
        if merged and merged[-1][1] == first - 1:
            merged[-1] = (merged[-1][0], last)
        else:
            merged.append((first, last))
    return tuple(merged)


def _count(ranges: Iterable[tuple[int, int]]) -> int:
    return sum(last - first + 1 for first, last in ranges)


def _frames(ranges: tuple[tuple[int, int], ...]) -> str:
    told = [str(first) if first == last else f"{first}-{last}" for first, last in ranges[:RANGES]]
    more = [f"{len(ranges) - RANGES} more"] if len(ranges) > RANGES else []
    one = len(ranges) == 1 and ranges[0][0] == ranges[0][1]
    return f"frame{'' if one else 's'} {', '.join(told + more)}"


def _capital(clause: str) -> str:
    return clause[:1].upper() + clause[1:]
