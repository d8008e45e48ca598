"""What layers need beside their pixels before a frame can be made: preparations that take long, each kept under its key.

Of a layer that drifts what continues it, of one that flows its fields, of one that flows like a clip these, the clip taken
apart, where it takes its residuals from, and its look. A change of speed makes nothing anew.
"""

from collections.abc import Callable, Generator, Iterator
from dataclasses import dataclass

import msgspec

from .. import _stillwater as engine
from ..recipe import Document, Recipe
from ..recipe.stochastic import Drift
from . import films
from .cache import Cache, Prepared
from .events import Event, Preparing, Warn
from .fields import frozen_part, make_field
from .keys import ENGINES, hashed
from .lock import as_progress
from .resolve import Timeline
from .stack import layer_images

PARTS = ("colour", "alpha")


class Way(msgspec.Struct, frozen=True):
    """How a layer must be ready. `axes`: of one that drifts, along which it goes on for ever; `fields`: of one that flows, the
    digests of its paintings, with the `longest` way of its copies; `film`: of one that flows like a clip."""

    layer: int
    axes: tuple[bool, bool] | None = None
    fields: tuple[str, ...] = ()
    longest: float = 0.0
    film: films.Film | None = None


@dataclass(frozen=True)
class Step:
    """A preparation: its key, what is said while it is made, and how it is made from those before it."""

    key: str
    what: str
    make: Callable[[list[Prepared], Callable[[], None]], Prepared]


def parts_of(layers: Prepared) -> tuple[str, ...]:
    """The stacks there are of some layers: their colour, and the picture's own alpha where it has one."""
    return PARTS if layers.facts["has_alpha"] else PARTS[:1]


def drifts(recipe: Recipe, index: int) -> bool:
    """Whether a layer drifts, or follows one that does."""
    layer = recipe.layers[index]
    if isinstance(layer.motion, Drift):
        return True
    return layer.follows is not None and drifts(recipe, [each.name for each in recipe.layers].index(layer.follows.layer))


def ways_of(timeline: Timeline, digests: dict[str, str]) -> list[Way]:
    """How each layer must be ready. `digests`: the hash of each file the recipe names."""
    return [_way(timeline, i, digests) for i in range(len(timeline.recipe.layers))]


def _way(timeline: Timeline, i: int, digests: dict[str, str]) -> Way:
    if (flow := timeline.flows[i]) is not None:
        return Way(i, fields=tuple(flow.paintings), longest=flow.longest)
    if (track := timeline.films[i]) is not None:
        film = films.film_of(track, digests[track.example.clip], timeline.recipe.fps)
        return Way(i, fields=film.fields, film=film)
    return Way(i, axes=timeline.endless[i] if drifts(timeline.recipe, i) else None)


def keys_of(layers: str, way: Way, scale: float = 1.0) -> list[str]:
    """The keys of all preparations that a layer of those with the key `layers` needs, in the order in which they are made."""
    if way.axes is not None:
        facts = {"endless": layers, "way": [way.layer, way.axes], "scale": min(1.0, scale), "drift": ENGINES["drift"]}
        return [hashed(facts)]
    fields = [
        hashed({"field": layers, "layer": way.layer, "painting": digest, "flow": ENGINES["flow"]}) for digest in way.fields
    ]
    if way.film is None:
        return fields
    index, film = way.layer, way.film
    return [
        *fields, films.clip_key(film), films.transfer_key(layers, index, film), films.look_key(layers, index, film, scale)
    ]  # fmt: skip


class Canvas:
    """Some layers with their key, of a picture of `size`, and the scale at which they are read."""

    def __init__(self, key: str, layers: Prepared, size: tuple[int, int], scale: float = 1.0):
        self.key, self.layers, self.size, self.scale = key, layers, size, scale

    def box(self, index: int) -> tuple[int, int, int, int]:
        return tuple(self.layers.facts["colour"][index])

    def steps(self, way: Way, timeline: Timeline, document: Document) -> list[Step]:
        """How what has keys_of() is made. A layer without pixels needs nothing but its keys."""
        name, place = timeline.recipe.layers[way.layer].name, f"layers[{way.layer}].motion"
        keys = keys_of(self.key, way, self.scale)
        if way.axes is not None:
            return [Step(keys[0], f"making {name} endless", lambda made, beat: self._endless(way, beat))]
        paintings = (timeline.flows[way.layer] or timeline.films[way.layer]).paintings if way.fields else {}
        steps = [
            Step(key, f"making {name} flow", lambda made, beat, of=paintings[digest]: self._field(way, of, place, beat))
            for key, digest in zip(keys, way.fields, strict=False)
        ]
        return steps if way.film is None else [*steps, *self._film_steps(way, timeline, document, keys, name, place)]

    def _film_steps(self, way: Way, timeline: Timeline, document: Document, keys, name: str, place: str) -> Iterator[Step]:
        example, empty = timeline.films[way.layer].example, not min(self.box(way.layer)[2:])
        count = len(way.fields)
        yield Step(keys[count], f"taking the clip of {name} apart", lambda made, beat: films.take_apart(document, example, place, beat))

        def transfer(made: list[Prepared], beat: Callable) -> Prepared:
            return NOTHING if empty else films.transfer(_fields(made[:count]), made[count], example, place)

        yield Step(keys[count + 1], f"laying the clip over {name}", transfer)

        def look(made: list[Prepared], beat: Callable) -> Prepared:
            return NOTHING if empty else films.make_look(lambda: self.plates(way, made, timeline), beat, place)

        yield Step(keys[count + 2], f"making the clip look like {name}", look)

    def _endless(self, way: Way, beat: Callable) -> Prepared:
        arrays = {}
        for part in parts_of(self.layers):
            image = layer_images(self.layers, part)[way.layer]
            if min(image.box[2:]) > 0:
                made = engine.make_endless(image, self.size, self.scale, way.axes, progress=as_progress(beat))
                arrays |= {f"{part}_pixels": made[0], f"{part}_mean": made[1]}
        return Prepared(arrays, {})

    def _field(self, way: Way, painting, place: str, beat: Callable) -> Prepared:
        image = layer_images(self.layers, "colour")[way.layer]
        if not min(image.box[2:]):
            return NOTHING
        return Prepared({"field": make_field(image, self.size, painting, place, beat)}, {})

    def plates(self, way: Way, ready: list[Prepared], timeline: Timeline) -> engine.LayerPlates:
        """A layer ready for any moment. `ready`: what has its keys_of(); without the last one, a film has no look."""
        parts = parts_of(self.layers)
        images = [layer_images(self.layers, part)[way.layer] for part in parts]
        arrays = ready[0].arrays if way.axes is not None else {}
        before = [(arrays[f"{part}_pixels"], arrays[f"{part}_mean"]) for part in parts if f"{part}_mean" in arrays]
        alpha = images[1] if len(images) > 1 else None
        fields = _fields(ready[: len(way.fields)])
        setup = look = None
        if way.film is not None and fields:
            setup = self._setup(way, ready, timeline)
            look = films.look_of(ready[-1]) if len(ready) == len(way.fields) + 3 else None
        flow = fields if way.film is None else []
        return engine.make_plates(
            images[0], alpha, self.size, self.scale, way.axes, before, flow, way.longest, example=setup, look=look
        )

    def _setup(self, way: Way, ready: list[Prepared], timeline: Timeline) -> engine.ExampleSetup:
        track, count, box = timeline.films[way.layer], len(way.fields), self.box(way.layer)
        freeze = frozen_part(self.size, box, track.example.freeze, f"layers[{way.layer}].motion")
        return films.setup(track, _fields(ready[:count]), ready[count], ready[count + 1], box, freeze, timeline.recipe.fps)


NOTHING = Prepared({}, {})


def _fields(ready: list[Prepared]) -> list:
    return [each.arrays["field"] for each in ready if "field" in each.arrays]


def pace_of(timeline: Timeline, way: Way, ready: list[Prepared]) -> films.Pace | None:
    """How the clip's time goes by in a layer; None where it has no clip."""
    track = timeline.films[way.layer]
    return None if track is None else films.pace_of(track, ready[len(way.fields)], timeline.recipe.fps)


def make_ready(
    canvas: Canvas, timeline: Timeline, document: Document, digests: dict[str, str], cache: Cache, of: str, beat: Callable
) -> Generator[Event, None, dict[Way, list[Prepared]]]:
    """What each layer needs beside its pixels: from the cache, from another worker that is at it, or made now.

    `of`: the key that forgets what is made; `beat` is called again and again. Throws RecipeError.
    """
    ready = {}
    for way in ways_of(timeline, digests):
        made: list[Prepared] = []
        for step in canvas.steps(way, timeline, document):
            found = cache.find(step.key)
            if found is None:
                yield Preparing(0.95, step.what)
                with cache.lock(step.key, beat) as still_there:
                    found = cache.find(step.key)
                    if found is None:
                        new = step.make(made, still_there)
                        found = cache.store(step.key, Prepared(new.arrays, {**new.facts, "of": of}))
            for sentence in found.facts.get("warnings", []):
                yield Warn(f"layers[{way.layer}].motion.{sentence}")
            made.append(found)
        ready[way] = made
    return ready
