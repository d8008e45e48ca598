"""What strokes say, in the form in which the recipe has it. Needs numpy, no bpy."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

DIGITS = 3  # written of a pixel
THINNEST, WIDEST = 10.0**-DIGITS, 16384.0  # px: the recipe's
SHORTEST = 1.0  # px: a shorter stroke says no direction
ANYWHERE = -1.0  # radius of a stroke's own


@dataclass(frozen=True)
class Stroke:
    """One stroke as it lies in the picture, a polyline."""

    points: np.ndarray  # (n, 2), px from the picture's top left corner, y down
    widths: np.ndarray  # (n,), px: where the pen was pressed harder it is wider
    frame: int  # of the key that holds its drawing
    radius: float = 0  # px, its own, of a touch-up; 0 = the layer's
    seed: int = 0  # its own and 1; 0 = the layer's
    flow: dict | None = None  # speed, local and alpha of its own, of a stroke along which something flows

    @property
    def length(self) -> float:
        """px"""
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).sum())


def ends(strokes: list[Stroke]) -> list | None:
    """[first, last] point of the last line drawn; None where there is no line."""
    line = _last_line(strokes)
    return line and _written(line.points[[0, -1]])


def polyline(strokes: list[Stroke]) -> list | None:
    """All points of the last line drawn; None where there is no line."""
    line = _last_line(strokes)
    return line and _written(line.points)


def straight_line(strokes: list[Stroke]) -> list | None:
    """[left, right] end of the straight line that is nearest to the last line drawn; None where there is no line.

    Of least squared distances, summed along the stroke: where the hand went slowly, and left more points, does not
    weigh more. It reaches as far as the stroke does.
    """
    line = _last_line(strokes)
    if line is None:
        return None
    steps = np.diff(line.points, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    middles = (line.points[1:] + line.points[:-1]) / 2
    middle = lengths @ middles / lengths.sum()
    offsets = middles - middle
    moments = (offsets.T * lengths) @ offsets + (steps.T * lengths) @ steps / 12
    direction = np.linalg.eigh(moments)[1][:, 1]
    direction = direction if direction[0] >= 0 else -direction
    along = (line.points - middle) @ direction
    return _written(middle + np.outer([along.min(), along.max()], direction))


def polygon(strokes: list[Stroke]) -> list | None:
    """The corners of the last outline drawn, which closes by itself; None where there is none that encloses anything."""
    for stroke in reversed(strokes):
        points = stroke.points
        if len(points) > 1 and np.allclose(points[0], points[-1], atol=10**-DIGITS):
            points = points[:-1]
        if len(points) > 2 and _area(points) > 0:
            return _written(points)
    return None


def all_strokes(strokes: list[Stroke]) -> list | None:
    """Every stroke, dabs too; None where there is none."""
    return [with_pressure(stroke) for stroke in strokes] or None


def touch_ups(strokes: list[Stroke]) -> list | None:
    """Every stroke with the radius and the seed that are its own; None where there is none."""
    return [{"stroke": with_pressure(stroke), **_own(stroke)} for stroke in strokes] or None


def flow_strokes(kind: str) -> Callable:
    """What strokes of one kind ("orientation", "speed", "both") say of a flow: every stroke, dabs only of a speed.

    Each has what is its own, and the frame of its key; None where there is none.
    """

    def said(strokes: list[Stroke]) -> list | None:
        telling = [stroke for stroke in strokes if kind == "speed" or stroke.length >= SHORTEST]
        return [{**with_pressure(each), "kind": kind, **(each.flow or {}), "frame": each.frame} for each in telling] or None

    return said


def clone_targets(strokes: list[Stroke]) -> list | None:
    """Every stroke with the weight that is its own; None where there is none."""
    return [{**with_pressure(stroke), **({"alpha": stroke.flow["alpha"]} if stroke.flow else {})} for stroke in strokes] or None


def _own(stroke: Stroke) -> dict:
    radius = None if stroke.radius < 0 else round(stroke.radius, DIGITS)
    return {**({"radius": radius} if stroke.radius else {}), **({"seed": stroke.seed - 1} if stroke.seed else {})}


def with_pressure(stroke: Stroke) -> dict:
    """The recipe's stroke: its width where it is widest, and a pressure for each point where it varies."""
    width = float(np.clip(stroke.widths.max(), THINNEST, WIDEST))
    points = _written(stroke.points)
    if np.ptp(stroke.widths) > 1e-4 * width:
        pressures = np.round(np.clip(stroke.widths / width, 0, 1), DIGITS).tolist()
        points = [[*point, pressure] for point, pressure in zip(points, pressures, strict=True)]
    return {"points": points, "width": round(width, DIGITS)}


def _area(points: np.ndarray) -> float:
    (x, y), (x1, y1) = points.T, np.roll(points, -1, axis=0).T
    return abs(float((x * y1 - x1 * y).sum())) / 2


def _last_line(strokes: list[Stroke]) -> Stroke | None:
    """The last stroke that leads anywhere: a dab is not a line."""
    return next((stroke for stroke in reversed(strokes) if stroke.length > 0), None)


def _written(points: np.ndarray) -> list:
    return (np.round(points, DIGITS) + 0.0).tolist()  # + 0: no -0
