"""The matte of one layer while it is being drawn: at once, and near to what it will be."""

import math
from collections.abc import Callable, Iterator

import numpy as np

from .. import _stillwater as engine
from ..recipe import Document, RecipeError
from .cache import Cache, Prepared
from .errors import Failed
from .events import Event, QuickMatte
from .hashing import hashed
from .lock import as_progress
from .mattes import MatteReader, ToSolve, whole
from .prepare import Sources
from .stack import leave

AT_ONCE = 60_000  # unknown pixels that are solved in a fraction of the time that a person waits


class Pictures:
    """The last picture that was read, for whoever asks for mattes of it again and again."""

    def __init__(self) -> None:
        self._digest, self._picture = "", np.zeros((0, 0, 4), np.float32)

    def of(self, sources: Sources) -> np.ndarray:
        """H x W x 4. Throws RecipeError."""
        digest = sources.digests[sources.recipe.picture] + sources.recipe.colour_space
        if digest != self._digest:
            self._picture, self._digest = sources.picture(), digest
        return self._picture


def quick_matte(
    document: Document, name: str, cache: Cache, pictures: Pictures, beat: Callable[[], None] = lambda: None
) -> Iterator[Event]:
    """The matte of the layer with this name, in the cache: array "matte", H x W of the picture, bytes 0 .. 255.

    It is solved on a smaller picture where much is unknown, and on what the layers in front have left as far as they
    are in the cache. The last event is QuickMatte. `beat` is called again and again while it lasts, and may end it by
    raising. Throws RecipeError; Failed where the cache can't be written.
    """
    sources = Sources(document, cache)
    index = _index(document, name)
    place, form = f"layers[{index}].matte", document.recipe.layers[index].matte
    if form is None:
        raise RecipeError(f"{place}: missing (there is nothing to solve)")
    key = hashed(["quick matte", sources.layer_keys[index], AT_ONCE])
    if cache.find(key) is None:
        picture = pictures.of(sources)
        matte = MatteReader(document, picture).read(place, form)
        left = _left(sources, cache, picture, index)
        solved = _solved(matte, left, beat) if isinstance(matte, ToSolve) else matte.matte
        plane = np.round(255 * whole(solved, sources.size)).astype(np.uint8)
        cache.store(key, Prepared({"matte": plane}, {"of": sources.layer_keys[index]}))
    if cache.trouble:
        raise Failed(cache.trouble)
    yield QuickMatte(key, name)


def _index(document: Document, name: str) -> int:
    names = [layer.name for layer in document.recipe.layers]
    if name not in names:
        raise RecipeError(f'layer: "{name}" is not one of {", ".join(names)}')
    return names.index(name)


def _left(sources: Sources, cache: Cache, picture: np.ndarray, index: int) -> np.ndarray:
    """The picture without the layers in front, as far as these were cut."""
    peeling = engine.Peeling(picture)
    for key in sources.layer_keys[:index]:
        kept = cache.find(key)
        if kept is None:
            break
        leave({"colour": peeling}, kept)
    return peeling.left()


def _solved(matte: ToSolve, left: np.ndarray, beat: Callable[[], None]):
    finest = min(8, 2 ** math.ceil(max(0.0, math.log2(max(1, matte.unknown) / AT_ONCE) / 2)))
    return matte.on(lambda: left, as_progress(beat), finest)
