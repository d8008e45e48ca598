"""What is out of date and why, in words. Knows nothing of Blender or the engine."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

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
    said: Callable[[str], str] = field(default=str, compare=False)  # puts sentences into the person's language

    @property
    def words(self) -> str:
        """The state in two or three words, for the node's label; empty where it can't be said."""
        if self.problem:
            return ""
        if self.stale:
            return self.said("out of date")
        if self.missing and not self.ready:
            return self.said("not baked")
        return self.said("frames missing") if self.missing else self.said("ready")

    @property
    def lines(self) -> list[str]:
        """What a panel says, line by line."""
        if self.problem:
            return [self.problem]
        if not self.stale and not self.missing:
            several = self.said("All {count} frames are ready").format(count=self.ready)
            return [several if self.ready > 1 else self.said("The frame is ready")]
        if not self.stale and not self.ready:
            return [self.said("Not baked yet")]
        told = [f"{_capital(self.said(clause))}: {_frames(ranges, self.said)}" for clause, ranges in self.why[:CLAUSES]]
        if len(self.why) > CLAUSES:
            told.append(self.said("And {count} more changes").format(count=len(self.why) - CLAUSES))
        if self.missing:
            sentence = self.said("Missing, the nearest is shown: {frames}")
            told.append(sentence.format(frames=_frames(self.missing, self.said)))
        return told

    @property
    def is_ready(self) -> bool:
        return not (self.problem or self.stale or self.missing)

    def at(self, frame: int) -> str:
        """How one frame stands."""
        if any(first <= frame <= last for first, last in self.missing):
            return MISSING
        return STALE if any(first <= frame <= last for first, last in self.stale) else READY


def report(spans: Iterable, by_reason: dict[str, list[tuple[int, int]]], said: Callable[[str], str] = str) -> Report:
    """From the engine's ranges of frames (first, last, state) and its reasons."""
    spans = list(spans)
    ranges = {state: _merged((s.first, s.last) for s in spans if s.state == state) for state in (READY, MISSING, STALE)}
    why = tuple((clause, tuple(found)) for clause, found in by_reason.items())
    return Report(_count(ranges[READY]), ranges[MISSING], ranges[STALE], why, said=said)


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


def _frames(ranges: tuple[tuple[int, int], ...], said: Callable[[str], str]) -> str:
    told = [str(first) if first == last else f"{first}-{last}" for first, last in ranges[:RANGES]]
    more = [said("{count} more").format(count=len(ranges) - RANGES)] if len(ranges) > RANGES else []
    one = len(ranges) == 1 and ranges[0][0] == ranges[0][1]
    return (said("frame {numbers}") if one else said("frames {numbers}")).format(numbers=", ".join(told + more))


def _capital(clause: str) -> str:
    return clause[:1].upper() + clause[1:]
