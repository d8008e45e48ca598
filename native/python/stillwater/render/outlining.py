"""Outlines that move: what of their recipe each frame reads, and how far they may go.

An outline follows the film frame after frame, so each frame's depends on all before it. It is kept by spans, each made from
the end of the one before.
"""

import math

import msgspec

from ..recipe.animation import Loop
from ..recipe.fluids import Example, Flow
from ..recipe.strokes import Outline
from .filming import ExampleTrack
from .flowing import FlowTrack
from .hashing import hashed

SPAN = 48  # frames
FORGOTTEN = 1 / 256  # what is left of an outline when a loop comes round
PASSED_ON = 0.5  # an outline lasts as persistence to this power: keeping its area passes some more on (measured)
ROOM = 8  # px, beside the way that an outline lasts
MOST_ROOM = 0.3  # of the layer's longer side


class OutlineNow(msgspec.Struct, frozen=True):
    """An outline at a frame: which of all, and the digest of what it has followed up to the end of its span."""

    index: int
    followed: str


class OutlineTrack:
    """A moving outline over a recipe's frames; outside of them it stands, or comes round again in a loop.

    `before`: frames that a loop's outline follows the film until it has forgotten how it began; `spans`: the digests of all
    that is followed up to the end of each.
    """

    def __init__(self, outline: Outline, track: FlowTrack | ExampleTrack, loop: Loop | None, frames: tuple[int, int]):
        self.persistence = outline.persistence
        self._first, last = frames
        self.count = last - self._first + 1
        self._comes_round = loop is not None
        lasts = loop is not None and self.persistence > 0
        self.before = math.ceil(math.log(FORGOTTEN) / (PASSED_ON * math.log(self.persistence))) if lasts else 0
        self.spans = []
        followed = hashed([self.persistence, *map(track.at, self.frames_before())])
        for span in range(math.ceil(self.count / SPAN)):
            followed = hashed([followed, *map(track.at, self.frames_of(span))])
            self.spans.append(followed)

    def frames_before(self) -> range:
        return range(self._first - self.before, self._first)

    def frames_of(self, span: int) -> range:
        """The frames whose outlines a span holds."""
        return range(self._first + SPAN * span, self._first + min(SPAN * (span + 1), self.count))

    def at(self, frame: int) -> OutlineNow:
        index = frame - self._first
        index = index % self.count if self._comes_round else min(max(index, 0), self.count - 1)
        return OutlineNow(index, self.spans[index // SPAN])


def room_for(motion: Flow | Example, track: FlowTrack | ExampleTrack, box: tuple) -> int:
    """How far an outline may leave a layer's box (x, y, width, height), px: as far as the fluid comes while it lasts."""
    fastest = max((stroke.speed for stroke in motion.strokes), default=0.0) * track.fastest
    lasts = 1 / max(1e-6, 1 - motion.outline.persistence)
    return math.ceil(min(ROOM + fastest * lasts, MOST_ROOM * max(box[2:])))
