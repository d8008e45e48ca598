"""Which frames are there and right, which are missing, and why the others are out of date."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from msgspec import Struct

from ..recipe import Document
from .cache import FOLDER, Cache
from .keys import FrameKeys
from .loop import Order, frame_range, frame_size
from .prepare import Sources
from .reads import Reads, read_mark, reasons
from .resolve import Timeline

READY, MISSING, STALE = "ready", "missing", "stale"


class Frames(Struct, frozen=True):
    """Frames `first` .. `last`, all in one state; `why` they are out of date, as clauses."""

    first: int
    last: int
    state: str
    why: tuple[str, ...] = ()


@dataclass(frozen=True)
class Standing:
    """Looks at the frames `first` .. `last` of a recipe one by one: nothing is prepared or rendered."""

    first: int
    last: int
    folder: Path
    name: str
    keys: FrameKeys
    reads: Reads
    read: Callable = read_mark  # a file's mark; the caller may have one that remembers

    def at(self, frame: int) -> Frames:
        """The state of one frame."""
        path = self.folder / f"{self.name}_{frame:04d}.exr"
        if not path.exists():
            return Frames(frame, frame, MISSING)
        key, parts = self.read(path)
        if key == self.keys.of(frame):
            return Frames(frame, frame, READY)
        return Frames(frame, frame, STALE, tuple(reasons(parts, self.reads.of(frame))))

    def all(self) -> Iterator[Frames]:
        """The state of each frame, in order."""
        return map(self.at, range(self.first, self.last + 1))


def standing(
    document: Document,
    order: Order = Order(),  # noqa: B008
    read: Callable = read_mark,
    cache: Cache | None = None,
) -> Standing:
    """Looks a recipe's frames up without opening its pictures: as fast as their files' hashes are known.

    `cache`: the one of its bakes, which remembers them; None = in the recipe's folder. Throws RecipeError and Refused
    with what is wrong with the recipe or its files.
    """
    recipe = document.recipe
    first, last = frame_range(recipe, order)
    scale = recipe.output.scale if order.scale is None else order.scale
    timeline, cache = Timeline(recipe), cache or Cache(document.folder / FOLDER)
    sources = Sources(document, cache)
    frame_size(sources.size, scale)
    keys = FrameKeys(timeline, sources.key, sources.size, scale, sources.digests)
    reads = Reads(timeline, sources.digests, keys.fixed)
    if cache.folder.exists():
        cache.keep_digests()
    folder = order.folder or document.locate(recipe.output.folder)
    return Standing(first, last, folder, recipe.output.name, keys, reads, read)


def joined(frames: Iterable[Frames]) -> list[Frames]:
    """Neighbours in one state for one reason as one."""
    spans: list[Frames] = []
    for one in frames:
        before = spans[-1] if spans else None
        if before and (before.state, before.why, before.last + 1) == (one.state, one.why, one.first):
            spans[-1] = Frames(before.first, one.last, one.state, one.why)
        else:
            spans.append(one)
    return spans


def by_reason(frames: Iterable[Frames]) -> dict[str, list[tuple[int, int]]]:
    """Each reason, and the ranges of frames that it put out of date."""
    found: dict[str, list[Frames]] = {}
    for span in frames:
        for clause in span.why:
            found.setdefault(clause, []).append(Frames(span.first, span.last, span.state))
    return {clause: [(span.first, span.last) for span in joined(spans)] for clause, spans in found.items()}
