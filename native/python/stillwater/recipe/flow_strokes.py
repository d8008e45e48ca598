"""Flow strokes in a file of their own: a JSON list of the recipe's."""

import os
from pathlib import Path

import msgspec

from .errors import RecipeError
from .explain import explain
from .read import decode
from .strokes import FlowStroke


class _Drawn(msgspec.Struct, forbid_unknown_fields=True, frozen=True):
    strokes: list[FlowStroke]


def load_flow_strokes(path: str | os.PathLike) -> list[dict]:
    """Reads [stroke, ...], or {"strokes": [stroke, ...]}, as `stillwater.paint_flow` takes them.

    Raises RecipeError with every problem found (one is a stroke that holds from some frame on: what is drawn stands still),
    OSError where it can't be read.
    """
    value = decode(Path(path).read_bytes())
    value = {"strokes": value} if isinstance(value, list) else value
    try:
        drawn = msgspec.convert(value, _Drawn)
    except msgspec.ValidationError as error:
        raise RecipeError(*(explain(value, _Drawn) or [str(error)])) from None
    timed = [i for i, stroke in enumerate(drawn.strokes) if stroke.frame is not None]
    if timed:
        raise RecipeError(*(f"strokes[{i}].frame: {drawn.strokes[i].frame} is not null (the field is that of one moment)" for i in timed))
    strokes = msgspec.to_builtins(drawn.strokes)
    for stroke in strokes:
        del stroke["frame"]
    return strokes
