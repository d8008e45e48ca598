"""Layers that drift or flow go on for ever: what continues them takes long to make, and is a preparation of its own.

Of a drift its key holds the layers it is made of, the scale and the axes, of a flow the layers and the strokes: a change of
speed makes nothing anew.
"""

from collections.abc import Callable, Generator

from .. import _stillwater as engine
from ..recipe import Recipe
from ..recipe.stochastic import Drift
from .cache import Cache, Prepared
from .events import Preparing
from .fields import make_field
from .keys import ENGINES, hashed
from .resolve import Timeline
from .stack import layer_images

PARTS = ("colour", "alpha")

# A layer; of one that drifts the axes along which it goes on for ever; of one that flows its fields' digests and the longest
# way of its copies.
Way = tuple[int, tuple[bool, bool] | None, tuple[tuple[str, ...], float] | None]


def parts_of(layers: Prepared) -> tuple[str, ...]:
    """The stacks there are of some layers: their colour, and the picture's own alpha where it has one."""
    return PARTS if layers.facts["has_alpha"] else PARTS[:1]


def drifts(recipe: Recipe, index: int) -> bool:
    """Whether a layer drifts, or follows one that does."""
    layer = recipe.layers[index]
    if isinstance(layer.motion, Drift):
        return True
    return layer.follows is not None and drifts(recipe, [each.name for each in recipe.layers].index(layer.follows.layer))


def ways_of(timeline: Timeline) -> list[Way]:
    """How each layer must be ready."""
    return [
        (i, axes if drifts(timeline.recipe, i) else None, flow and (tuple(flow.paintings), flow.longest))
        for i, (axes, flow) in enumerate(zip(timeline.endless, timeline.flows, strict=True))
    ]


def endless_key(layers: str, way: Way, scale: float = 1.0) -> str:
    """The key of what a drifting layer of those with the key `layers` goes on with, `scale` times as large."""
    return hashed({"endless": layers, "way": way[:2], "scale": min(1.0, scale), "drift": ENGINES["drift"]})


def field_key(layers: str, index: int, digest: str) -> str:
    """The key of a field that a painting with this digest says for a layer of those with the key `layers`."""
    return hashed({"field": layers, "layer": index, "painting": digest, "flow": ENGINES["flow"]})


def keys_of(layers: str, way: Way, scale: float = 1.0) -> list[str]:
    """The keys of all preparations that a layer needs beside its pixels."""
    if way[2] is not None:
        return [field_key(layers, way[0], digest) for digest in way[2][0]]
    return [] if way[1] is None else [endless_key(layers, way, scale)]


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

    def make_field(self, way: Way, painting, place: str, of: str, beat: Callable) -> Prepared:
        """A field of a layer that flows; of one without pixels none. Throws RecipeError."""
        image = layer_images(self.layers, "colour")[way[0]]
        if not min(image.box[2:]):
            return Prepared({}, {"of": of})
        return Prepared({"field": make_field(image, self.size, painting, place, beat)}, {"of": of})

    def plates(self, way: Way, ready: list[Prepared]) -> engine.LayerPlates:
        """A layer ready for any moment. `ready`: what has its keys_of()."""
        parts = parts_of(self.layers)
        images = [layer_images(self.layers, part)[way[0]] for part in parts]
        arrays = ready[0].arrays if ready and way[1] is not None else {}
        before = [(arrays[f"{part}_pixels"], arrays[f"{part}_mean"]) for part in parts if f"{part}_mean" in arrays]
        alpha = images[1] if len(images) > 1 else None
        fields, longest = [], 0.0
        if way[2] is not None:
            fields, longest = [each.arrays["field"] for each in ready if "field" in each.arrays], way[2][1]
        return engine.make_plates(images[0], alpha, self.size, self.scale, way[1], before, fields, longest)


def make_ready(
    canvas: Canvas, timeline: Timeline, cache: Cache, of: str, beat: Callable
) -> Generator[Preparing, None, dict[Way, list[Prepared]]]:
    """What each layer needs beside its pixels: from the cache, from another worker that is at it, or made now.

    Throws RecipeError.
    """
    ready = {}
    for way in ways_of(timeline):
        name, flow = timeline.recipe.layers[way[0]].name, timeline.flows[way[0]]
        ready[way] = []
        for i, key in enumerate(keys_of(canvas.key, way, canvas.scale)):
            if (made := cache.find(key)) is None:
                yield Preparing(0.95, f"making {name} {'flow' if flow else 'endless'}")
                with cache.lock(key, beat) as lock:

                    def still_there(lock=lock) -> None:
                        beat()
                        lock.beat()

                    if (made := cache.find(key)) is None:
                        if flow:
                            painting = flow.paintings[way[2][0][i]]
                            place = f"layers[{way[0]}].motion"
                            made = canvas.make_field(way, painting, place, of, still_there)
                        else:
                            made = canvas.make(way, of, still_there)
                        made = cache.store(key, made)
            ready[way].append(made)
    return ready
