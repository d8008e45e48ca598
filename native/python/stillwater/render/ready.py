"""What layers need beside their pixels before a frame can be made: preparations that take long, each kept under its key.

Of a layer that drifts what continues it, of one that flows its fields, of one that flows like a clip these, the clip taken
apart, where it takes its residuals from, and its look; then, where its outline moves, the outlines of all frames. A change of
speed makes nothing but these anew.
"""

from collections.abc import Callable, Generator, Iterator
from dataclasses import dataclass

import msgspec
import numpy as np

from .. import _stillwater as engine
from ..recipe import Document, Recipe
from ..recipe.stochastic import Drift
from . import films, outlines
from .cache import Cache, Prepared
from .events import Event, Preparing, Warn
from .fields import frozen_part, make_field
from .hashing import hashed
from .keys import ENGINES
from .lock import as_progress
from .moments import moment_of, motion_of, view_of
from .outlining import room_for
from .resolve import Timeline
from .stack import layer_images

PARTS = ("colour", "alpha")


class Outlined(msgspec.Struct, frozen=True):
    """An outline that moves: the `room` it gets around the layer, px, and the digests of what its `spans` follow."""

    room: int
    spans: tuple[str, ...]


class Way(msgspec.Struct, frozen=True):
    """How a layer must be ready. `axes`: of one that drifts, along which it goes on for ever; `fields`: of one that flows, the
    digests of its paintings, with the `longest` way of its copies; `film`: of one that flows like a clip; `outline`: of one
    of these whose outline moves."""

    layer: int
    axes: tuple[bool, bool] | None = None
    fields: tuple[str, ...] = ()
    longest: float = 0.0
    film: films.Film | None = None
    outline: Outlined | None = None

    @property
    def inside(self) -> int:
        """How many preparations its film needs, without an outline."""
        return len(self.fields) + (3 if self.film else 0)


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


def ways_of(timeline: Timeline, digests: dict[str, str], boxes: list) -> list[Way]:
    """How each layer must be ready. `digests`: the hash of each file the recipe names; `boxes`: of the layers."""
    return [_way(timeline, i, digests, box) for i, box in enumerate(boxes)]


def _way(timeline: Timeline, i: int, digests: dict[str, str], box: tuple) -> Way:
    if (flow := timeline.flows[i]) is not None:
        return Way(i, fields=tuple(flow.paintings), longest=flow.longest, outline=_outlined(timeline, i, box))
    if (track := timeline.films[i]) is not None:
        film = films.film_of(track, digests[track.example.clip], timeline.recipe.fps)
        return Way(i, fields=film.fields, film=film, outline=_outlined(timeline, i, box))
    return Way(i, axes=timeline.endless[i] if drifts(timeline.recipe, i) else None)


def _outlined(timeline: Timeline, i: int, box: tuple) -> Outlined | None:
    if (outline := timeline.outlines[i]) is None or not min(box[2:]):
        return None
    room = room_for(timeline.recipe.layers[i].motion, timeline.fluid(i), box)
    return Outlined(room, tuple(outline.spans))


def keys_of(layers: str, way: Way, scale: float = 1.0) -> list[str]:
    """The keys of all preparations that a layer of those with the key `layers` needs, in the order in which they are made."""
    if way.outline is None:
        return _film_keys(layers, way, scale)
    film = _film_keys(hashed({"with room": layers, "px": way.outline.room}), way, scale)
    facts = {"outline": film, "scale": min(1.0, scale), "flow": ENGINES["flow"], "frame": ENGINES["frame"]}
    return [*film, *(hashed({**facts, "followed": followed}) for followed in way.outline.spans)]


def _film_keys(layers: str, way: Way, scale: float) -> list[str]:
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

    def _image(self, way: Way, part: str):
        """The layer's pixels as they are made ready: without an outline where that moves."""
        image = layer_images(self.layers, part)[way.layer]
        return image if way.outline is None else outlines.opened(outlines.with_room(image, way.outline.room, self.size))

    def steps(self, way: Way, timeline: Timeline, document: Document) -> list[Step]:
        """How what has keys_of() is made. A layer without pixels needs nothing but its keys."""
        name, place = timeline.recipe.layers[way.layer].name, f"layers[{way.layer}].motion"
        keys = keys_of(self.key, way, self.scale)
        if way.axes is not None:
            return [Step(keys[0], f"making {name} endless", lambda made, beat: self._endless(way, beat))]
        paintings = timeline.fluid(way.layer).paintings if way.fields else {}
        steps = [
            Step(key, f"making {name} flow", lambda made, beat, of=paintings[digest]: self._field(way, of, place, beat))
            for key, digest in zip(keys, way.fields, strict=False)
        ]
        if way.film is not None:
            steps += self._film_steps(way, timeline, document, keys, name, place)
        if way.outline is not None:
            steps += self._outline_steps(way, timeline, keys[way.inside :], name)
        return steps

    def _film_steps(self, way: Way, timeline: Timeline, document: Document, keys, name: str, place: str) -> Iterator[Step]:
        example, empty = timeline.films[way.layer].example, not min(self.layers.facts["colour"][way.layer][2:])
        count = len(way.fields)
        yield Step(keys[count], f"taking the clip of {name} apart", lambda made, beat: films.take_apart(document, example, place, beat))

        def transfer(made: list[Prepared], beat: Callable) -> Prepared:
            return NOTHING if empty else films.transfer(_fields(made[:count]), made[count], example, place)

        yield Step(keys[count + 1], f"laying the clip over {name}", transfer)

        def look(made: list[Prepared], beat: Callable) -> Prepared:
            return NOTHING if empty else films.make_look(lambda: self.plates(way, made, timeline), beat, place)

        yield Step(keys[count + 2], f"making the clip look like {name}", look)

    def _outline_steps(self, way: Way, timeline: Timeline, keys: list[str], name: str) -> Iterator[Step]:
        track, canvas = timeline.outlines[way.layer], Canvas(self.key, self.layers, self.size, min(1.0, self.scale))

        def span(made: list[Prepared], beat: Callable, index: int) -> Prepared:
            film, matte = canvas.film(way, made[: way.inside], timeline)
            start = made[-1].arrays["last"] if index else matte
            before = range(0) if index else track.frames_before()
            return outlines.follow(film, matte, track.persistence, start, before, track.frames_of(index), beat)

        for index, key in enumerate(keys):
            yield Step(key, f"following the outline of {name}", lambda made, beat, at=index: span(made, beat, at))

    def film(self, way: Way, ready: list[Prepared], timeline: Timeline) -> tuple[Callable, np.ndarray]:
        """One layer's frames as its outline follows them (opaque, its texture not matched), and its matte, in the pixels of its
        plate. `ready`: what its film needs."""
        closed = outlines.with_room(layer_images(self.layers, "colour")[way.layer], way.outline.room, self.size)
        small = engine.scaled_layer(closed, self.size, self.scale)
        x, y, width, height = small.box
        plates = self.plates(way, ready, timeline, matched=False)
        pace, recipe = pace_of(timeline, way, ready), timeline.recipe

        def numbers(frame: int):
            now = timeline.at(frame)
            return moment_of(now.moment), motion_of(timeline, way.layer, now.layers[way.layer], pace)

        moment, motion = numbers(1)
        has_alpha = len(parts_of(self.layers)) > 1
        layer = engine.Layer(plates, motion)
        renderer = engine.FrameRenderer(self.size, self.scale, view_of(recipe), moment.wind, [layer], has_alpha=has_alpha)

        def film(frame: int) -> np.ndarray:
            moment, motion = numbers(frame)
            state = engine.LayerState(1.0, motion)
            whole = renderer.render(moment, moment, [state], [state], flow=False).combined
            return whole[y : y + height, x : x + width]

        return film, np.ascontiguousarray(np.clip(np.asarray(small.pixels)[..., 3], 0, 1))

    def _endless(self, way: Way, beat: Callable) -> Prepared:
        arrays = {}
        for part in parts_of(self.layers):
            image = layer_images(self.layers, part)[way.layer]
            if min(image.box[2:]) > 0:
                made = engine.make_endless(image, self.size, self.scale, way.axes, progress=as_progress(beat))
                arrays |= {f"{part}_pixels": made[0], f"{part}_mean": made[1]}
        return Prepared(arrays, {})

    def _field(self, way: Way, painting, place: str, beat: Callable) -> Prepared:
        image = self._image(way, "colour")
        if not min(image.box[2:]):
            return NOTHING
        field = make_field(image, self.size, painting, place, way.outline is None, beat)
        return Prepared({"field": field}, {})

    def plates(self, way: Way, ready: list[Prepared], timeline: Timeline, matched: bool = True) -> engine.LayerPlates:
        """A layer ready for any moment. `ready`: what has its keys_of(), or the first of them: a film without a look, an
        opaque layer without its outline. `matched`: a film's texture to the picture's."""
        parts = parts_of(self.layers)
        images = [self._image(way, part) for part in parts]
        arrays = ready[0].arrays if way.axes is not None else {}
        before = [(arrays[f"{part}_pixels"], arrays[f"{part}_mean"]) for part in parts if f"{part}_mean" in arrays]
        alpha = images[1] if len(images) > 1 else None
        fields = _fields(ready[: len(way.fields)])
        setup = look = None
        if way.film is not None and fields:
            setup = self._setup(way, ready, timeline, images[0].box, matched)
            look = films.look_of(ready[way.inside - 1]) if len(ready) >= way.inside else None
        flow = fields if way.film is None else []
        return engine.make_plates(
            images[0], alpha, self.size, self.scale, way.axes, before, flow, way.longest, example=setup, look=look,
            outlines=[span.arrays["outlines"] for span in ready[way.inside :]] if way.outline else [],
        )  # fmt: skip

    def _setup(self, way: Way, ready: list[Prepared], timeline: Timeline, box: tuple, matched: bool) -> engine.ExampleSetup:
        track, count = timeline.films[way.layer], len(way.fields)
        freeze = frozen_part(self.size, box, track.example.freeze, f"layers[{way.layer}].motion")
        return films.setup(track, _fields(ready[:count]), ready[count], ready[count + 1], box, freeze, timeline.recipe.fps, matched)


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
    for way in ways_of(timeline, digests, canvas.layers.facts["colour"]):
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
