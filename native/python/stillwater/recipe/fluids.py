"""Motions of fluids: painted flow, one video example (METHODS.md 2), a video library (METHODS.md 3)."""

from typing import Annotated, Literal

from msgspec import Meta, field

from .parts import File, Part, Place, animated, choice, number, text, whole
from .strokes import CloneStroke, FlowStroke, Outline, Refine, Stroke

Grid = Annotated[tuple[whole("cells across", ge=1, le=64), whole("cells down", ge=1, le=64)], Meta(description="cells")]


class Transfer(Part):
    """How the clip's residuals come onto the picture."""

    patch: whole("side of a patch", "px", ge=4, le=128) = 16
    order: choice(Literal["best-last", "best-first"], "which patches lie on top") = "best-last"
    strokes: list[CloneStroke] = []


class _Painted(Part):
    """What flow and example share: a flow painted with strokes, some of which may hold from a frame on."""

    strokes: list[FlowStroke] = []
    refine: Refine = Refine()
    speed: animated(number("factor of the speed", ge=-1000, le=1000)) = 1.0
    freeze: choice(list[Stroke], "what stays where it is") = []
    outline: Outline | None = None

    def drawn(self) -> list[tuple[int | None, list[FlowStroke]]]:
        """The strokes that hold together, by the frame from which they do: those without a frame always, those with one
        until the next such frame, and before the first. None: no stroke has one."""
        frames = sorted({stroke.frame for stroke in self.strokes if stroke.frame is not None})
        return [
            (frame, [stroke for stroke in self.strokes if stroke.frame is None or stroke.frame == frame])
            for frame in frames or [None]
        ]


class Flow(_Painted, tag="flow"):
    """A fluid that moves along painted strokes, without footage."""

    period: number("after which the flow begins anew", "frames", gt=0, le=1e6) = 60.0


class _Look(_Painted):
    """What example and library share: the look of a fluid that comes from clips."""

    shutter: number("motion blur of the approximated average", "s", ge=0, le=10) = 0.2
    average_blur: number("blur of the approximated average (sigma)", "px", ge=0, le=1000) = 8.0
    grid: choice(Grid | None, "cells of the histogram matching; null = of about 55 px") = None
    repetitions: whole("rounds of the histogram matching", ge=0, le=20) = 3
    matching: choice(Literal["steerable", "laplacian", "none"], "pyramid of the histogram matching") = "steerable"
    clip_scale: number("picture pixels for a pixel of the clip", gt=0, le=100) = 1.0
    clip_fps: choice(number("frames per second of the clip", "1/s", gt=0, le=1000) | None, "null = the file's") = None
    endless: choice(bool, "goes on for ever") = True
    stylize: number("how strongly the picture's look is put back", ge=0, le=1) = 1.0


class Example(_Look, tag="example", kw_only=True):
    """The picture flows like one clip."""

    clip: File
    clip_frames: choice(tuple[int, int] | None, "[first, last] of the clip, null = all") = None
    clip_steady: choice(bool, "the clip's camera shakes, and is held still") = False
    life: whole("life time of a residual", "frames", ge=1, le=1000) = 16
    transfer: Transfer = Transfer()


class SpeedMap(Part):
    """Speeds painted as grey."""

    file: File
    white: number("speed that white stands for", "px/frame", gt=0, le=1000) = 4.0


class Pin(Part):
    """A clip that is wanted at a place."""

    at: Place
    clip: text("name of the clip")


class Library(_Look, tag="library", kw_only=True):
    """The picture flows like clips that are chosen and merged piece by piece."""

    library: choice(File, "folder made by `stillwater library build`")
    kinds: choice(list[str], "kinds of fluid that clips may show") = field(default_factory=lambda: ["fire"])
    speed_map: SpeedMap | None = None
    candidates: whole("candidates for each piece", ge=1, le=10000) = 100
    smoothness: number("lambda: weight of neighbours' agreement", ge=0, le=1000) = 1.0
    dynamics: number("sigma: weight of the motion's spectrum", ge=0, le=1000) = 1.0
    texture: number("rho: weight of the texture", ge=0, le=1000) = 1.0
    exclude: choice(list[str], "names of clips that are not wanted") = []
    pins: list[Pin] = []
    transfer: Transfer = Transfer()


