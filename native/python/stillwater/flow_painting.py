"""Flow painted over a picture with strokes, refined by the picture, proposed from it, and made visible."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _stillwater as engine
from .layers import _premultiplied, _straight
from .matting import _place

Array = NDArray[np.float32]
Kind = Literal["water", "falls", "fire", "smoke", "sky"]
KINDS = ("water", "falls", "fire", "smoke", "sky")

STROKE_KINDS = {
    "orientation": engine.FlowStrokeKind.orientation,
    "speed": engine.FlowStrokeKind.speed,
    "both": engine.FlowStrokeKind.both,
}
STROKE_FIELDS = ("points", "width", "kind", "speed", "local", "alpha")


def paint_flow(
    strokes: Sequence[Mapping[str, Any]],
    size: tuple[int, int],
    *,
    bound: ArrayLike | None = None,
    freeze: ArrayLike | None = None,
) -> engine.PaintedFlow:
    """A flow painted with an orientation brush and a speed brush.

    Between the strokes both are interpolated by radial basis functions, phi(r) = r; x and y of the orientation apart, then
    normalised. A later stroke paints over an earlier one where they cross.

    Args:
        strokes: each {"points": [[x, y] or [x, y, pressure], ...], "width": 10, "kind": "both", "speed": 2, "local": False,
            "alpha": 1}: in picture pixels, the fluid runs from the first point to the last; kind is "orientation", "speed"
            or "both", speed px/frame. A local stroke changes only its neighbourhood; alpha 0..1 is how strongly a stroke
            counts against the others.
        size: (width, height) of the picture, px.
        bound: height x width, 0..1: the layer's matte. The flow does not cross its outline but slides along.
        freeze: height x width, 0..1: 1 is held still.

    Returns:
        An object with `orientation`, height x width x 2, unit vectors (x right, y down), and `speed`, height x width, px/frame.

    Raises:
        ValueError: no stroke, none that says an orientation and touches the picture, a stroke shorter than a pixel that is to
            say a direction, numbers out of range, or arrays of another size.

    Source: Okabe, Anjyo, Igarashi and Seidel 2009, "Animating pictures of fluid using video examples", 5.1.
    """
    return engine.paint_flow(_flow_strokes(strokes), _size(size), bound, freeze)


def refine_flow(
    painted: engine.PaintedFlow | tuple[ArrayLike, ArrayLike], picture: ArrayLike, *, width: float = 12.0, amount: float = 1.0
) -> Array:
    """A painted flow turned along the picture's own streaks.

    The directions of edges (across the gradient, the way of the painted flow), weighted by the gradient's size, are blurred;
    where they stand across the painted flow it slows down.

    Args:
        painted: what `paint_flow` or `propose_flow` gave, or (orientation, speed).
        picture: height x width x 3 or 4, display-referred, straight alpha.
        width: sigma of the blur, px, 0..1000. Wide gives a calm flow, narrow one that follows every detail.
        amount: 0..1: 0 is the flow as painted, 1 the refined one.

    Returns:
        height x width x 2: the flow, px/frame, x right, y down.

    Raises:
        ValueError: sizes differ, numbers are out of range, or a colour is not a finite number.

    Source: Okabe et al. 2009, 5.1: "refined orientation component" and "refined speed component".
    """
    if isinstance(painted, tuple):
        painted = engine.PaintedFlow(*painted)
    return engine.refine_flow(painted, _premultiplied(picture), width, amount)


def propose_flow(
    picture: ArrayLike,
    kind: Kind = "water",
    strokes: Sequence[Mapping[str, Any]] = (),
    *,
    bound: ArrayLike | None = None,
    freeze: ArrayLike | None = None,
) -> engine.PaintedFlow:
    """A flow found in the picture itself: along its streaks, the way that such a fluid runs.

    Args:
        picture: height x width x 3 or 4, display-referred, straight alpha.
        kind: "falls" run down, "fire" and "smoke" up, "sky" and "water" to the right.
        strokes: as of `paint_flow`; they correct it: their direction holds near them, and says which way streaks run
            elsewhere; a painted speed takes the place of the kind's.
        bound: as of `paint_flow`; only what lies within is looked at.
        freeze: as of `paint_flow`.

    Returns:
        As `paint_flow`.

    Raises:
        ValueError: another kind, sizes that differ, a colour that is not a finite number, or what `paint_flow` raises.

    Source: Bigun and Granlund 1987, "Optimal orientation detection of linear symmetry"; Di Zenzo 1986, eq. 9.
    """
    return engine.propose_flow(_premultiplied(picture), kind, _flow_strokes(strokes), bound, freeze)


def streaks(
    flow: ArrayLike,
    phase: float = 0.0,
    *,
    size: tuple[int, int] | None = None,
    length: float = 0.03,
    strength: float = 0.85,
    seed: int = 0,
) -> Array:
    """A flow made visible: streaks along it, light and dark, to be laid over any picture with `over`.

    Args:
        flow: height x width x 2, px/frame.
        phase: of the streaks' motion; 0..1 is one turn, in which they run half their length downstream, and 1 is 0 again.
        size: (width, height) of the result, px; None is the flow's.
        length: of a streak where the flow is fast, in parts of the picture's diagonal, 0.001..0.5.
        strength: 0..1, opacity of the clearest streaks.
        seed: of the noise.

    Returns:
        height x width x 4, straight alpha; clear where nothing moves.

    Raises:
        ValueError: another shape, a vector that is not finite, or numbers out of range.

    Source: Cabral and Leedom 1993, "Imaging vector fields using line integral convolution", 4.
    """
    made = engine.Streaks(flow, length=length, strength=strength, seed=seed)
    return _straight(made.at(phase, None if size is None else _size(size)))


def _flow_strokes(strokes: Sequence[Mapping[str, Any]]) -> list:
    given = []
    for i, stroke in enumerate(strokes):
        name = f"strokes[{i}]"
        if "points" not in stroke:
            raise engine.BadInput(f"{name}: a stroke without points is not a line")
        if unknown := set(stroke) - set(STROKE_FIELDS):
            raise engine.BadInput(f"{name}: {', '.join(sorted(unknown))} is not one of {', '.join(STROKE_FIELDS)}")
        values = dict(stroke)
        values["points"] = [_place(f"{name}.points[{k}]", p, pressure=True) for k, p in enumerate(stroke["points"])]
        if "kind" in values:
            if values["kind"] not in STROKE_KINDS:
                raise engine.BadInput(f"{name}.kind: {values['kind']!r} is not one of {', '.join(STROKE_KINDS)}")
            values["kind"] = STROKE_KINDS[values["kind"]]
        given.append(engine.FlowStroke(**values))
    return given


def _size(size: tuple[int, int]) -> tuple[int, int]:
    width, height = size
    return int(width), int(height)
