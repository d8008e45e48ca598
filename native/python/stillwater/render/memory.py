"""How much memory a render will need at most, before it starts.

The largest of three moments: cutting the layers (picture, mattes, and the layer that takes most), making them ready
(those from the cache, mapped, and what is made of them), and rendering (what is ready, and the frame at work). A test
holds it within 20 % of the measured peak.
"""

import math
from typing import NamedTuple

import numpy as np

from .. import _stillwater as engine
from ..recipe.mattes import FileFill, LabelMatte
from .clips import FRAME as CLIP_FRAME
from .clips import fitting, needed_memory
from .fills import Exemplar
from .films import MEMORY, clip_key
from .outlining import SPAN
from .ready import keys_of, ways_of

PROCESS = 170e6  # Python and the engine's libraries
RGBA, PLANE = 16, 4  # bytes a pixel
LEFT = RGBA + 3 * PLANE  # what is left of the picture, what hides it, what is solid, the matte at work
# Measured, bytes a pixel while a layer is cut: filling from patches (of the picture, and of the hole), taking the colours
# of a soft edge apart (of the layer and what surrounds it), solving a matte (of what is unknown).
EXEMPLAR, HOLE, COLOURS, SOLVING = 91, 161, 103, 525
SURROUNDED = 1.5**2  # a layer with what surrounds it, of the layer
FRAME = 28  # picture, flow, matte
WRITTEN, WRITTEN_AT_ONCE = 30, 64 << 20  # what is written of them; bytes of it that are held
TRIED_OUT = 128  # pixels
CLEAR = 2  # pixels around a layer that was cut
STRIP = 1.25  # an endless layer's period, of its side
# Of a layer that flows, bytes a pixel of it: its texture, fields, streamlines and what is found on their knots; and while a
# field is painted, of the whole picture.
FIELD, TEXTURE, KNOTS, PAINTING = 8, 16, 24, 120
# Of a layer that flows like a clip, measured, bytes a pixel of it: its texture, look, sources and the frame at work with its
# pyramid; and what finding the look takes beside them.
FILM, LOOK = 400, 230
TURNED = 1.8  # an endless layer that is being made ready, beside itself: on its canvas, and one period of it


def needed_bytes(job) -> float:
    """For a Job whose files are checked."""
    if job.stack is not None:
        return PROCESS + _rendering(job, job.boxes)
    boxes = _behind(job)
    return PROCESS + max(_cutting(job, boxes), _rendering(job, boxes))


def _behind(job) -> list:
    """The boxes as they will be: a layer goes on behind those in front. Tried out on a small copy."""
    height, width = job.images.picture.shape[:2]
    step = math.ceil(max(width, height) / TRIED_OUT)
    picture = np.ascontiguousarray(job.images.picture[::step, ::step])
    mattes = [None if matte is None else _small(matte.bound, picture.shape[:2], step) for matte in job.images.mattes]
    fills, feathers = [engine.Fill.push_pull] * len(mattes), [0.0] * len(mattes)
    layers = engine.peel(picture, mattes, fills, feathers)
    return [_grown(own, layer.box, step, (width, height)) for own, layer in zip(job.boxes, layers, strict=True)]


def _grown(own, small, step: int, size: tuple[int, int]) -> tuple:
    """A box of the picture and what the small copy's, with its clear sides, says of it."""
    if not (_area(own) and _area(small)):
        return own
    ends = []
    for at in (0, 1):
        low, high = small[at], small[at] + small[at + 2]
        low = step * (low + CLEAR) if low > 0 else 0
        high = step * (high - CLEAR) if step * high < size[at] else size[at]
        ends.append((min(own[at], low), max(own[at] + own[at + 2], high)))
    (left, right), (top, bottom) = ends
    return left, top, right - left, bottom - top


def _small(matte, shape, step) -> np.ndarray:
    """Every `step`-th row and column of a matte."""
    x, y, _, _ = matte.box
    part = matte.pixels[-y % step :: step, -x % step :: step]
    top, left = -(-y // step), -(-x // step)
    small = np.zeros(shape, np.float32)
    small[top : top + part.shape[0], left : left + part.shape[1]] = part
    return small


def _cutting(job, boxes) -> float:
    pixels = job.sources.size[0] * job.sources.size[1]
    with_matte = [i for i, layer in enumerate(job.recipe.layers) if layer.matte is not None]
    mattes = PLANE * sum(_area(job.boxes[i]) for i in with_matte)
    fills = RGBA * pixels * sum(isinstance(layer.fill, FileFill) for layer in job.recipe.layers[:-1])
    at_work = max((_cutting_one(job, i, boxes[i]) for i in with_matte), default=0.0)
    return pixels * (RGBA + LEFT) * (2 if job.has_alpha else 1) + mattes + fills + at_work


def _cutting_one(job, i: int, box) -> float:
    pixels = job.sources.size[0] * job.sources.size[1]
    around = min(pixels, SURROUNDED * _area(box))
    colours = 0.0 if isinstance(job.recipe.layers[i].matte, LabelMatte) and not job.recipe.layers[i].feather else COLOURS * around
    filling = EXEMPLAR * pixels + HOLE * _area(box) if isinstance(job.images.fills[i], Exemplar) else 2 * RGBA * around
    return max(colours, filling, SOLVING * getattr(job.images.mattes[i], "unknown", 0))


def _rendering(job, boxes) -> float:
    shrunk = min(1.0, job.scale) ** 2
    canvas = RGBA * job.sources.size[0] * job.sources.size[1]
    cut, ready, at_work = 0.0, 0.0, canvas if shrunk < 1 else 0.0
    ways = ways_of(job.timeline, job.sources.digests, boxes)
    layers = zip(job.recipe.layers, boxes, job.timeline.endless, job.timeline.flows, ways, strict=True)
    for layer, box, endless, flow, way in layers:
        cut += RGBA * _area(box)
        if not layer.visible:
            continue
        if way.outline is not None:
            box = (*box[:2], *(min(side + 2 * way.outline.room, most) for side, most in zip(box[2:], job.sources.size, strict=True)))
            ready += shrunk * _area(box) * min(job.last - job.first + 1, SPAN * len(way.outline.spans))
        width = STRIP * job.sources.size[0] if endless[0] else box[2]
        height = STRIP * job.sources.size[1] if endless[1] else box[3]
        plate = RGBA * shrunk * width * height
        ready += plate
        if flow is not None:
            fields = len(flow.paintings)
            ready += shrunk * _area(box) * (TEXTURE + (FIELD + KNOTS) * fields)
            painting = 0 if _painted(job, way) else PAINTING * job.sources.size[0] * job.sources.size[1]
            at_work = max(at_work, painting + FIELD * fields * _area(box))
        if way.film is not None:
            clip = _clip_of(job, way)
            made = _painted(job, way)
            ready += shrunk * _area(box) * FILM + CLIP_FRAME * clip.size[0] * clip.size[1] * clip.touched
            painting = PAINTING * job.sources.size[0] * job.sources.size[1] + FIELD * _area(box)
            at_work = max(at_work, 0 if made else max(shrunk * _area(box) * LOOK, painting))
            if not clip.taken_apart:
                at_work = max(at_work, needed_memory(clip.size, clip.frames) - shrunk * _area(box) * FILM)
        if any(endless):
            at_work = max(at_work, TURNED * plate)
    if job.has_alpha:
        cut, ready = 2 * cut, 2 * ready
    own = RGBA * sum(layer.visible for layer in job.recipe.layers) if job.recipe.output.layers else 0
    pixels = job.size[0] * job.size[1]
    return ready + max(cut + at_work, pixels * (FRAME + own) + min(pixels * (WRITTEN + own), WRITTEN_AT_ONCE))


class _Clip(NamedTuple):
    """A film's clip: width and height, frames, how many of these a render reads, and whether it is in the cache."""

    size: tuple[int, int]
    frames: int
    touched: int
    taken_apart: bool


def _clip_of(job, way) -> _Clip:
    example = job.recipe.layers[way.layer].motion
    if (kept := job.cache.find(clip_key(way.film))) is not None:
        frames, height, width, _ = kept.arrays["residuals"].shape
        size, fps, apart = (width, height), kept.facts["fps"], True
    else:
        clip = engine.Clip(str(job.document.locate(example.clip)))
        first, last = example.clip_frames or (1, clip.frames)
        frames, fps, apart = last - first + 1, clip.fps, False
        size = fitting((clip.width, clip.height), frames, MEMORY)
    steps = (example.clip_fps or fps or job.recipe.fps) / job.recipe.fps * (job.last - job.first + 1)
    return _Clip(size, frames, min(frames, math.ceil(example.life + 2 + steps)), apart)


def _painted(job, way) -> bool:
    """Whether all that a layer needs beside its pixels is in the cache."""
    return all(job.cache.find(key) is not None for key in keys_of(job.sources.key, way, job.scale))


def _area(box) -> int:
    return box[2] * box[3]
