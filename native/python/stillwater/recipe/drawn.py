"""What an artist drew to cut out one layer, in a file of its own: the recipe's scribbles or lasso."""

import os
from pathlib import Path

import msgspec

from .errors import RecipeError
from .explain import explain, show
from .mattes import LassoMatte, ScribbleMatte, Scribbles
from .read import decode


def load_drawn(path: str | os.PathLike) -> ScribbleMatte | LassoMatte:
    """Reads {"foreground": [stroke], "background": [stroke]}, or one of the recipe's matte forms with scribbles or a lasso.

    Throws RecipeError with every problem found, OSError where it can't be read.
    """
    value = decode(Path(path).read_bytes())
    if isinstance(value, dict) and ("foreground" in value or "background" in value):
        return ScribbleMatte(_convert(value, Scribbles))
    if isinstance(value, dict) and "scribbles" in value:
        return _convert(value, ScribbleMatte)
    if isinstance(value, dict) and "lasso" in value:
        return _convert(value, LassoMatte)
    raise RecipeError(f"{show(value)} is neither scribbles (foreground, background) nor a lasso")


def _convert(value, kind: type):
    try:
        return msgspec.convert(value, kind)
    except msgspec.ValidationError as error:
        raise RecipeError(*(explain(value, kind) or [str(error)])) from None
