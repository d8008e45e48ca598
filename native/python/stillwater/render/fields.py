"""The fields that the strokes of a layer say which flows."""

from collections.abc import Callable

import numpy as np

from .. import _stillwater as engine
from ..recipe import RecipeError
from ..recipe.strokes import FlowStroke, Stroke
from .flowing import Painting


def make_field(
    layer, size: tuple[int, int], painting: Painting, place: str, bounded: bool, beat: Callable[[], None]
) -> np.ndarray:
    """The flow that a painting says for a layer (engine.LayerImage of a picture of `size`): float32, box height x box width
    x 2, px/frame. `bounded`: it stays within the layer. Throws RecipeError; `place` stands in sentences."""
    x, y, width, height = layer.box
    inside = slice(y, y + height), slice(x, x + width)
    pixels = np.asarray(layer.pixels)
    matte = np.zeros(size[::-1], np.float32)
    matte[inside] = pixels[..., 3]
    sides = (y, size[1] - y - height), (x, size[0] - x - width), (0, 0)
    picture = np.pad(engine.extend_colours(pixels), sides, mode="edge")
    try:
        freeze = _freeze(size, painting.freeze, place)
        beat()
        strokes = [_stroke(stroke) for stroke in painting.strokes]
        painted = engine.paint_flow(strokes, size, matte if bounded and (matte < 1).any() else None, freeze)
        beat()
        return engine.refine_flow(painted, picture, painting.refine.width, painting.refine.amount)[inside].copy()
    except engine.BadInput as error:
        raise RecipeError(f"{place}.{error}") from None


def _stroke(stroke: FlowStroke):
    return engine.FlowStroke(
        points=[[*point, 1.0][:3] for point in stroke.points],
        width=stroke.width,
        kind=getattr(engine.FlowStrokeKind, stroke.kind),
        speed=stroke.speed,
        local=stroke.local,
        alpha=stroke.alpha,
    )


def frozen_part(size: tuple[int, int], box: tuple, strokes: list[Stroke], place: str) -> np.ndarray | None:
    """What strokes hold still of a box (x, y, width, height): float32, box height x box width, 0..1; None: nothing. Throws
    RecipeError."""
    try:
        frozen = _freeze(size, strokes, place)
    except engine.BadInput as error:
        raise RecipeError(f"{place}.{error}") from None
    x, y, width, height = box
    return None if frozen is None else np.ascontiguousarray(frozen[y : y + height, x : x + width])


def _freeze(size: tuple[int, int], strokes: list[Stroke], place: str) -> np.ndarray | None:
    if not strokes:
        return None
    drawn = (engine.Stroke([[*point, 1.0][:3] for point in stroke.points], stroke.width) for stroke in strokes)
    return np.maximum.reduce([engine.drawn(size, each, f"freeze[{i}]") for i, each in enumerate(drawn)])
