"""Layers that flow for ever: what of their recipe each frame reads."""

import math

import msgspec
import numpy as np

from ..recipe.animation import Loop, Track
from ..recipe.fluids import Example, Flow
from ..recipe.strokes import FlowStroke, Refine, Stroke
from .hashing import hashed

MOST_WAYS = 256  # numbers that say a speed that changes, over one period


class Painting(msgspec.Struct, frozen=True):
    """All that a field is made of, beside the layer."""

    strokes: list[FlowStroke]
    refine: Refine
    freeze: list[Stroke]

    @property
    def digest(self) -> str:
        return hashed(self)


class FlowNow(msgspec.Struct, frozen=True, tag="flow"):
    """A flow at a frame. `cycle`: where in the period it is, 0 .. 1; `ways`: the fluid's way since each age from minus to
    plus half a period, evenly, and `step` that to the next frame, frames at speed 1; `longest`: no way of any frame is
    longer; `fields`: the digests of the paintings between which it is, and the `share` of the second."""

    cycle: float
    ways: tuple[float, ...]
    step: float
    longest: float
    fields: tuple[str, str]
    share: float


class PaintedFields:
    """The fields that a layer's strokes say, and between which of them it is at a frame. `paintings`: by their digests."""

    def __init__(self, motion: Flow | Example, loop: Loop | None):
        self._loop = loop
        drawn = [(frame, Painting(strokes, motion.refine, motion.freeze)) for frame, strokes in motion.drawn()]
        self.paintings = {painting.digest: painting for _, painting in drawn}
        self._keys = self._placed([frame for frame, _ in drawn], [painting.digest for _, painting in drawn])

    def at(self, frame: int) -> tuple[tuple[str, str], float]:
        """The digests of two paintings, and the share of the second. In a loop `frame` lies in it."""
        keys = self._keys
        after = next((i for i, (at, _) in enumerate(keys) if at > frame), len(keys))
        if after == 0 or after == len(keys):
            digest = keys[0 if after == 0 else -1][1]
            return (digest, digest), 0.0
        (start, field), (end, following) = keys[after - 1], keys[after]
        return (field, field if frame == start else following), (frame - start) / (end - start)

    def _placed(self, frames: list, digests: list[str]) -> list[tuple[int, str]]:
        """Each painting's frame; in a loop the first once more, where it comes round again."""
        if len(digests) == 1:
            return [(1, digests[0])]
        if not self._loop:
            return list(zip(frames, digests, strict=True))
        first, period = self._loop.first, self._loop.period
        inside = sorted((first + (frame - first) % period, digest) for frame, digest in zip(frames, digests, strict=True))
        (start, opening), (end, closing) = inside[0], inside[-1]
        return [(end - period, closing), *inside, (start + period, opening)]


class FlowTrack:
    """A flow's numbers at any frame. In a loop the period is one that fits a whole number of times."""

    def __init__(self, flow: Flow, loop: Loop | None):
        self._loop, self._speed = loop, Track.of(flow.speed, loop)
        self._turns = max(1, round(loop.period / flow.period)) if loop else 0
        self._period = loop.period / self._turns if loop else flow.period
        self._fields = PaintedFields(flow, loop)
        self.paintings = self._fields.paintings
        self.fastest = float(np.abs(self._speed.values).max())
        way = self._period / 2 * self.fastest
        self.longest = 2.0 ** math.ceil(math.log2(way)) if way > 0 else 0.0  # rarely another one where the speed is changed

    def at(self, frame: int) -> FlowNow:
        """The numbers of one frame."""
        if self._loop:
            into = (frame - self._loop.first) % self._loop.period
            cycle, frame = (into * self._turns) % self._loop.period / self._loop.period, self._loop.first + into
        else:
            cycle = (frame - 1) % self._period / self._period
        step = self._speed.integral(frame + 1) - self._speed.integral(frame)
        return FlowNow(cycle, self._ways(frame), step, self.longest, *self._fields.at(frame))

    def _ways(self, frame: int) -> tuple[float, ...]:
        half = self._period / 2
        if len(self._speed.values) == 1:
            way = half * float(self._speed.values[0])
            return -way, way
        pieces = min(MOST_WAYS, 2 * math.ceil(half))
        here = self._speed.integral(frame)
        return tuple(here - self._integral(frame - half * (2 * i / pieces - 1)) for i in range(pieces + 1))

    def _integral(self, frame: float) -> float:
        whole = math.floor(frame)
        before = self._speed.integral(whole)
        return before + (frame - whole) * (self._speed.integral(whole + 1) - before)
