"""The layers of a recipe as pictures: what a painter takes into another program."""

import re
from collections.abc import Callable, Generator
from pathlib import Path

import numpy as np

from .. import _stillwater as engine
from ..recipe import Document
from .cache import Cache, Prepared
from .errors import Failed, Refused
from .events import Event, LayerFile
from .prepare import Sources
from .stack import layers_of

FORMATS = ("png", "exr")


def write_layers(
    document: Document, folder: Path, cache: Cache, kind: str = "png", beat: Callable[[], None] = lambda: None
) -> Generator[Event, None, None]:
    """Writes each layer, the front first, as FOLDER/01_NAME.png: of the picture's size, its colours free of what lies
    behind it, transparent where it is not. Laid over each other in this order they give the picture.

    `kind`: "png" (8 bit, straight alpha) or "exr" (scene-linear, premultiplied). Throws RecipeError; Refused where the
    folder can't be made, Failed where a file can't be written.
    """
    sources = Sources(document, cache)
    stack = yield from layers_of(sources, cache, beat)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise Refused(f"{folder}: cannot be written ({error.strerror})") from None
    digits = max(2, len(str(len(document.recipe.layers))))
    for i, layer in enumerate(document.recipe.layers):
        path = folder / f"{i + 1:0{digits}d}_{_file_name(layer.name)}.{kind}"
        try:
            engine.write_picture(str(path), whole_layer(stack, i, sources.size))
        except engine.FileError as error:
            raise Failed(str(error)) from None
        yield LayerFile(layer.name, str(path))


def whole_layer(stack: Prepared, index: int, size: tuple[int, int]) -> np.ndarray:
    """One layer over nothing: H x W x 4, premultiplied. `size`: width and height of the picture."""
    picture = np.zeros((*size[::-1], 4), np.float32)
    for part in ("colour", "alpha") if stack.facts["has_alpha"] else ("colour",):
        pixels = stack.arrays.get(f"{part}{index}")
        if pixels is None:
            continue
        x, y, width, height = stack.facts[part][index]
        into = picture[y : y + height, x : x + width]
        if part == "colour":
            into[:] = pixels
        else:  # how much of it is there, as grey
            into[..., 3] = pixels[..., 0]
    return picture


def _file_name(name: str) -> str:
    """A layer's name without what file systems don't like."""
    return re.sub(r'[\x00-\x1f<>:"/\\|?*]', "_", name).strip(" .") or "layer"
