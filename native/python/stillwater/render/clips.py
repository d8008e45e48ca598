"""Clips of fluids, read into half floats and taken apart."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from .. import _stillwater as engine

FEWEST = 3  # frames
SMALLEST = 32  # px a side
WORK = 400  # bytes a pixel of the clip while it is taken apart, beside its frames; and for each frame
FRAME, SUMS = 6, 1.5
AS_ONE = 0.3  # of the pairs of frames
UNEVEN = 1.5  # longest time between two frames, of the usual one
REPEATED = 0.05  # of the usual change from frame to frame: less is no change


@dataclass
class ClipFrames:
    """A clip as it is worked on: float16, frames x height x width x 3, frames that repeat the one before left out; frames
    per second of those; and what is odd about it."""

    frames: np.ndarray
    fps: float
    warnings: list[str] = field(default_factory=list)


def read_frames(
    path: str, wanted: tuple[int, int] | None, memory: float, beat: Callable[[float], None] = lambda share: None
) -> ClipFrames:
    """Reads frames `wanted` (first, last; None: all), made smaller where they would not fit into `memory` bytes.

    `beat` is called with the share that is read. Throws BadInput, FileError; `clip` and `clip_frames` stand in sentences.
    """
    clip = engine.Clip(path)
    first, last = wanted or (1, clip.frames)
    if last < first:
        raise engine.BadInput(f"clip_frames: [{first}, {last}] runs backwards (the first is not above the last)")
    for number in (first, last):
        if not 1 <= number <= clip.frames:
            raise engine.BadInput(f"clip_frames: {number} is not a frame of the clip (1 to {clip.frames})")
    if last - first + 1 < FEWEST:
        count = last - first + 1
        raise engine.BadInput(f"clip_frames: {count} frame{'s are' if count > 1 else ' is'} not at least {FEWEST}")
    if min(clip.width, clip.height) < SMALLEST:
        raise engine.BadInput(f"clip: {clip.width} x {clip.height} is not at least {SMALLEST} px a side")
    warnings = []
    width, height = fitting((clip.width, clip.height), last - first + 1, memory)
    if min(width, height) < SMALLEST:
        needed = needed_memory((SMALLEST, SMALLEST * max(clip.width, clip.height) // min(clip.width, clip.height)), last - first + 1)
        raise engine.BadInput(f"memory: {memory / 1e6:.0f} MB do not hold the clip (at least {math.ceil(needed / 1e6)} MB)")
    if (width, height) != (clip.width, clip.height):
        warnings.append(
            f"clip: {last - first + 1} frames of {clip.width} x {clip.height} are more than {memory / 1e6:.0f} MB hold;"
            f" taken at {width} x {height}"
        )
    if clip.longest_gap > UNEVEN:
        warnings.append(
            f"clip: its frames come unevenly (up to {clip.longest_gap:.3g} times as long after each other as they use to);"
            " taken as even"
        )
    frames = np.empty((last - first + 1, height, width, 3), np.float16)
    changes, before = [], None
    for number in range(first, last + 1):
        beat((number - first) / (last - first + 1))
        frame = clip.frame(number, width, height)
        if before is not None:
            changes.append(float(np.abs(frame - before).mean()))
        frames[number - first] = frame
        before = frame
    if clip.seen_transparent:
        warnings.append("clip: it is transparent in places; it is taken over black")
    usual = float(np.percentile(changes, 75))
    repeats = [i + 1 for i, change in enumerate(changes) if change <= REPEATED * usual]
    if usual == 0 or len(frames) - len(repeats) < FEWEST:
        raise engine.BadInput("clip: nothing moves in it (its frames are all alike)")
    fps = clip.fps
    if repeats:
        frames = _without(frames, repeats)
        fps *= len(frames) / (last - first + 1)
        one = len(repeats) == 1
        many = "1 frame repeats the one before and is" if one else f"{len(repeats)} frames repeat the one before and are"
        warnings.append(f"clip: {many} left out; taken as {fps:.4g} frames per second")
    return ClipFrames(frames, fps, warnings)


def _without(frames: np.ndarray, left_out: list[int]) -> np.ndarray:
    """In the same memory."""
    kept = sorted(set(range(len(frames))) - set(left_out))
    for i, frame in enumerate(kept):
        frames[i] = frames[frame]
    return frames[: len(kept)]


def take_apart(clip: ClipFrames, flow: str, quality: str, steady: bool, progress: Callable[[str, float], bool]):
    """The clip's frames become its residuals, in the same memory; answers engine.ClipAnalysis. What is odd is added to the
    clip's warnings. Throws BadInput, Cancelled."""
    if steady:
        moved = engine.hold_camera(clip.frames, progress)
        clip.warnings.append(f"clip: held still; the camera shook by up to {moved:.1f} px")
    if engine.moves_as_one(clip.frames) > AS_ONE:
        clip.warnings.append(
            "clip: the whole picture moves as one: by a camera that moves, or a fluid that fills it (the two can't be told apart)"
        )
    return engine.analyse_clip(clip.frames, flow, quality, progress)


def needed_memory(size: tuple[int, int], frames: int) -> float:
    """Bytes that a clip needs while it is taken apart."""
    return size[0] * size[1] * (frames * (FRAME + SUMS) + WORK)


def fitting(size: tuple[int, int], frames: int, memory: float) -> tuple[int, int]:
    """The clip's size, or the largest one of its shape that fits."""
    factor = math.sqrt(min(1.0, memory / needed_memory(size, frames)))
    return (size[0], size[1]) if factor == 1 else (int(size[0] * factor), int(size[1] * factor))
