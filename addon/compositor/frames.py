"""The frames on disk. Knows nothing of Blender."""

import bisect
import re
from collections.abc import Sequence
from pathlib import Path


def present(folder: Path, name: str) -> list[int]:
    """The numbers of the frames NAME_0001.exr, ... in `folder`, in order; none where there is no such folder."""
    numbered = re.compile(re.escape(name) + r"_(\d{4,})\.exr")
    found = folder.iterdir() if folder.is_dir() else ()
    return sorted(int(match[1]) for path in found if (match := numbered.fullmatch(path.name)))


def path_of(folder: Path, name: str, frame: int) -> Path:
    return folder / f"{name}_{frame:04d}.exr"


def nearest(frame: int, frames: Sequence[int]) -> int:
    """Of the frames that there are, in order, the one shown for `frame`; of two as near the earlier."""
    place = bisect.bisect_left(frames, frame)
    return min(frames[max(place - 1, 0) : place + 1], key=lambda there: (abs(there - frame), there))


def offsets(first: int, last: int, frames: Sequence[int]) -> list[tuple[int, int]]:
    """Where an image sequence's frame_offset has to change, so that a missing frame shows the nearest one.

    A list of (frame, offset from there on); one entry where nothing is missing.
    """
    changes: list[tuple[int, int]] = []
    for frame in range(first, last + 1):
        offset = first - 1 + nearest(frame, frames) - frame
        if not changes or changes[-1][1] != offset:
            changes.append((frame, offset))
    return changes


def spans(frames: list[int]) -> str:
    """Frames in order as ranges: 1-4,7."""
    ranges: list[list[int]] = []
    for frame in frames:
        if ranges and ranges[-1][1] == frame - 1:
            ranges[-1][1] = frame
        else:
            ranges.append([frame, frame])
    return ",".join(str(first) if first == last else f"{first}-{last}" for first, last in ranges)
