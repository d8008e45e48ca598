"""Layers that drift go on for ever: what continues them takes seconds to make, and is a preparation of its own.

Its key holds the layers it is made of, the scale and the axes: a change of speed makes nothing anew.
"""

from collections.abc import Callable, Generator

from .. import _stillwater as engine
from ..recipe import Recipe
from ..recipe.stochastic import Drift
from .cache import Cache, Prepared
from .events import Preparing
from .keys import ENGINES, hashed
from .stack import layer_images

PARTS = ("colour", "alpha")

Way = tuple[int, tuple[bool, bool] | None]  # a layer, and of one that drifts the axes along which it goes on for ever


def parts_of(layers: Prepared) -> tuple[str, ...]:
    """The stacks there are of some layers: their colour, and the picture's own alpha where it has one."""
    return PARTS if layers.facts["has_alpha"] else PARTS[:1]


def drifts(recipe: Recipe, index: int) -> bool:
    """Whether a layer drifts, or follows one that does."""
    layer = recipe.layers[index]
    if isinstance(layer.motion, Drift):
        return True
    return layer.follows is not None and drifts(recipe, [each.name for each in recipe.layers].index(layer.follows.layer))


def ways_of(recipe: Recipe, endless: list[tuple[bool, bool]]) -> list[Way]:
    """How each layer must be ready. `endless`: Timeline.endless."""
    return [(i, axes if drifts(recipe, i) else None) for i, axes in enumerate(endless)]


def endless_key(layers: str, way: Way, scale: float = 1.0) -> str:
    """The key of what a drifting layer of those with the key `layers` goes on with, `scale` times as large."""
    return hashed({"endless": layers, "way": way, "scale": min(1.0, scale), "drift": ENGINES["drift"]})


class Canvas:
    """Some layers with their key, of a picture of `size`, and the scale at which they are read."""

    def __init__(self, key: str, layers: Prepared, size: tuple[int, int], scale: float = 1.0):
        self.key, self.layers, self.size, self.scale = key, layers, size, scale

    def make(self, way: Way, of: str, beat: Callable) -> Prepared:
        """What a layer goes on with. `of`: the key that forgets it; `beat` is called again and again."""

        def still_there(phase: str, share: float) -> bool:
            beat()
            return True

        arrays = {}
        for part in parts_of(self.layers):
            image = layer_images(self.layers, part)[way[0]]
            if min(image.box[2:]) > 0:
                made = engine.make_endless(image, self.size, self.scale, way[1], progress=still_there)
                arrays |= {f"{part}_pixels": made[0], f"{part}_mean": made[1]}
        return Prepared(arrays, {"of": of})

    def plates(self, way: Way, endless: Prepared | None) -> engine.LayerPlates:
        """A layer ready for any moment. `endless`: what make() gave; None for one that does not drift."""
        parts = parts_of(self.layers)
        images = [layer_images(self.layers, part)[way[0]] for part in parts]
        arrays = endless.arrays if endless else {}
        before = [(arrays[f"{part}_pixels"], arrays[f"{part}_mean"]) for part in parts if f"{part}_mean" in arrays]
        alpha = images[1] if len(images) > 1 else None
        return engine.make_plates(images[0], alpha, self.size, self.scale, way[1], before)


def make_endless(
    canvas: Canvas, recipe: Recipe, ways: list[Way], cache: Cache, of: str, beat: Callable
) -> Generator[Preparing, None, dict[Way, Prepared]]:
    """What each layer that drifts goes on with: from the cache, from another worker that is at it, or made now."""
    endless = {}
    for way in ways:
        if way[1] is None:
            continue
        key = endless_key(canvas.key, way, canvas.scale)
        if (made := cache.find(key)) is None:
            yield Preparing(0.95, f"making {recipe.layers[way[0]].name} endless")
            with cache.lock(key, beat) as lock:

                def still_there(lock=lock) -> None:
                    beat()
                    lock.beat()

                made = cache.find(key) or cache.store(key, canvas.make(way, of, still_there))
        endless[way] = made
    return endless
