"""What the artist draws: strokes, and strokes that say where a fluid flows."""

from typing import Annotated, Literal

from msgspec import Meta

from .parts import Part, Place, choice, number, whole

Pressure = number("pressure of the pen", ge=0, le=1)
StrokePoint = Annotated[
    list[float], Meta(min_length=2, max_length=3, description="[x, y] in picture pixels, or [x, y, pressure]")
]


class Stroke(Part):
    """A line drawn over the picture."""

    points: Annotated[list[StrokePoint], Meta(min_length=1)]
    width: number("full width at pressure 1", "px", gt=0, le=16384) = 10.0


class FlowStroke(Part):
    """A stroke that says where the fluid goes, how fast, or both."""

    points: Annotated[list[StrokePoint], Meta(min_length=1)]
    width: number("full width at pressure 1", "px", gt=0, le=16384) = 10.0
    kind: choice(Literal["orientation", "speed", "both"], "what the stroke says") = "both"
    speed: number("speed under the stroke", "px/frame", ge=0, le=1000) = 2.0
    local: choice(bool, "only its neighbourhood follows it") = False
    alpha: number("how strongly it counts", ge=0, le=1) = 1.0
    frame: choice(whole("frame from which it holds", "frame", ge=-1_000_000, le=1_000_000) | None, "null = always") = None


class CloneStroke(Part):
    """Residuals taken along `source` in the clip and laid along `target` in the picture."""

    source: Annotated[list[Place], Meta(min_length=1, description="points in pixels of the clip")]
    target: Annotated[list[Place], Meta(min_length=1, description="points in picture pixels")]
    width: number("full width", "px", gt=0, le=16384) = 20.0
    alpha: number("how strongly it counts", ge=0, le=1) = 1.0


class Refine(Part):
    """Turns a painted flow along the picture's own streaks (METHODS.md 2)."""

    width: number("sigma of the blur", "px", ge=0, le=1000) = 12.0
    amount: number("share of the turn", ge=0, le=1) = 1.0


class Outline(Part):
    """The moving outline of fire and smoke."""

    moving: choice(bool, "the outline moves with the flow") = False
    persistence: number("share of the outline that lasts from frame to frame", ge=0, le=1) = 0.9


