"""Layers that flow like a clip: what of their recipe each frame reads, and how the clip's time goes by."""

import msgspec
import numpy as np

from ..recipe.animation import Loop, Track
from ..recipe.fluids import Example
from .flowing import PaintedFields

BEFORE = 1  # steps of the clip, beside a residual's life, that have gone by at frame 1: by then all have come


class ExampleNow(msgspec.Struct, frozen=True, tag="example"):
    """A film at a frame. `way`: frames at speed 1 since the first one, `step` those to the next frame; `fields`: the
    digests of the paintings between which it is, and the `share` of the second."""

    way: float
    step: float
    fields: tuple[str, str]
    share: float


class ExampleTrack:
    """A film's numbers at any frame; `over_loop`: the way in one loop, None where there is none."""

    def __init__(self, example: Example, loop: Loop | None):
        self.example, self._loop = example, loop
        self._speed = Track.of(example.speed, loop)
        self._fields = PaintedFields(example, loop)
        self.paintings = self._fields.paintings
        self.over_loop = self._speed.over_loop() if loop else None
        self.fastest = float(np.abs(self._speed.values).max())

    def at(self, frame: int) -> ExampleNow:
        """The numbers of one frame."""
        if self._loop:
            frame = self._loop.first + (frame - self._loop.first) % self._loop.period
        start = self._loop.first if self._loop else 1
        way = self._speed.integral(frame) - self._speed.integral(start)
        step = self._speed.integral(frame + 1) - self._speed.integral(frame)
        return ExampleNow(way, step, *self._fields.at(frame))


class Pace(msgspec.Struct, frozen=True):
    """How a clip's steps go by: `steps` of it in a frame at speed 1; `period` of them until a loop begins anew (0: none)."""

    steps: float
    period: int
    start: float
    last: float | None  # where the film stands still; None: it never does

    @classmethod
    def of(cls, track: ExampleTrack, clip_fps: float, residuals: int, fps: float) -> "Pace":
        """`clip_fps`: as the clip was read, 0 where its file does not say: then as the picture's; `residuals`: how many."""
        example = track.example
        steps = (example.clip_fps or clip_fps or fps) / fps
        start, last = float(example.life + BEFORE), None if example.endless else residuals - 1.0
        period = 0
        if example.endless and track.over_loop:
            period = max(1, round(abs(track.over_loop) * steps))
            steps = period / abs(track.over_loop)  # a whole number of steps in a loop
        return cls(steps, period, start, last)

    def moment(self, way: float) -> float:
        """Steps of the clip that have gone by."""
        at = self.start + way * self.steps
        return at if self.last is None else min(max(at, min(self.start, self.last)), self.last)
