"""The layers of a recipe at the size of a screen: a preparation, so that whoever shows frames makes none.

`prepare` makes it, as slowly as it must; whoever knows `key_of`, and ready.py's `keys_of`, finds it, and reads no
file but the cache's.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

from msgspec.structs import replace

from .. import _stillwater as engine
from ..recipe import Document, Recipe
from ..recipe.fluids import Example, Flow
from ..recipe.parts import Keys
from ..recipe.stochastic import Bob, Drift, Sway
from .cache import Cache, Prepared
from .errors import Failed
from .events import Event, Preparing, Ready
from .hashing import hashed
from .keys import ENGINES, stack_key
from .loop import frame_size
from .prepare import Sources, digests_of
from .ready import Canvas, make_ready, parts_of
from .resolve import Timeline
from .stack import forget_stack, layer_images, layers_of


SMALLEST_PATCH = 4  # px, of a film's transfer


def key_of(document: Document, cache: Cache, longest: int) -> str | None:
    """The key of the small layers for the files as they are now; None where nobody has read these yet.

    Throws RecipeError where a file is missing.
    """
    digests = digests_of(document, cache.known)
    return _key(stack_key(document.recipe, digests), longest) if all(digests.values()) else None


def prepare(document: Document, longest: int, cache: Cache, beat: Callable = lambda: None) -> Iterator[Event]:
    """Prepares the layers for frames whose longer side is `longest` pixels, at most the picture's. The last event is Ready.

    `beat` is called again and again while it lasts, and may end it by raising. Throws RecipeError; Failed where the
    cache can't be written.
    """
    sources = Sources(document, cache)
    key = _key(sources.key, longest)
    if cache.find(key) is None:
        with cache.lock(key, beat) as still_there:
            if cache.find(key) is None:
                stack = yield from layers_of(sources, cache, still_there)
                yield Preparing(0.9, "making the layers small")
                small = _reduced(stack, sources.size, longest, still_there)
                cache.store(key, Prepared(small.arrays, {**small.facts, "of": sources.key}))
    if (small := cache.find(key)) is not None:
        timeline = Timeline(reduced(document.recipe, small.facts["scale"]))
        canvas = Canvas(key, small, tuple(small.facts["size"]))
        yield from make_ready(canvas, timeline, document, sources.digests, cache, sources.key, beat)
    cache.keep_digests()
    if cache.trouble:
        raise Failed(cache.trouble)
    yield Preparing(1, "done")
    yield Ready(key, {str(path.resolve()): _file(path, digest) for path, digest in _located(document, sources)})


def forget(document: Document, cache: Cache) -> None:
    """Removes the layers of a recipe as it is now, at every size. Throws RecipeError, OSError."""
    forget_stack(Sources(document, cache), cache)


def _key(stack: str, longest: int) -> str:
    return hashed({"preview of": stack, "longest": longest, "frame": ENGINES["frame"]})


def _located(document: Document, sources: Sources):
    return [(document.locate(name), digest) for name, digest in sources.digests.items()]


def _file(path: Path, digest: str) -> list:
    state = path.stat()
    return [state.st_size, state.st_mtime_ns, digest]


def _reduced(stack: Prepared, size: tuple[int, int], longest: int, beat: Callable) -> Prepared:
    """`scale`: small pixels for a picture's; `size` of the small picture; `boxes`: of its layers."""
    scale = min(1.0, longest / max(size))
    parts = parts_of(stack)
    arrays, boxes = {}, {part: [] for part in parts}
    for part in parts:
        for i, image in enumerate(layer_images(stack, part)):
            beat()
            small = engine.scaled_layer(image, size, scale)
            boxes[part].append(list(small.box))
            if min(small.box[2:]) > 0:
                arrays[f"{part}{i}"] = small.pixels
    facts = {"scale": scale, "size": frame_size(size, scale), "has_alpha": stack.facts["has_alpha"], **boxes}
    return Prepared(arrays, facts)


def reduced(recipe: Recipe, scale: float) -> Recipe:
    """The recipe of the picture made smaller: every place and velocity of what moves it."""
    view = recipe.view
    if view.horizon is not None:
        view = replace(view, horizon=tuple(_scaled(place, scale) for place in view.horizon))
    layers = [replace(layer, motion=_reduced_motion(layer.motion, scale)) for layer in recipe.layers]
    return replace(recipe, view=view, layers=layers)


def _reduced_motion(motion, scale: float):
    match motion:
        case Sway():
            return replace(motion, armature=tuple(_scaled(place, scale) for place in motion.armature))
        case Bob():
            return replace(motion, waterline=[_scaled(place, scale) for place in motion.waterline])
        case Drift(velocity=None):
            return replace(motion, wind=motion.wind * scale)
        case Drift(velocity=Keys() as keys):
            return replace(motion, velocity=replace(keys, values=[_scaled(value, scale) for value in keys.values]))
        case Drift():
            return replace(motion, velocity=_scaled(motion.velocity, scale))
        case Flow() | Example():
            strokes = [replace(_reduced_stroke(stroke, scale), speed=stroke.speed * scale) for stroke in motion.strokes]
            refine = replace(motion.refine, width=motion.refine.width * scale)
            freeze = [_reduced_stroke(stroke, scale) for stroke in motion.freeze]
            small = replace(motion, strokes=strokes, refine=refine, freeze=freeze)
            return _quick_look(small, scale) if isinstance(small, Example) else small
    return motion


def _quick_look(motion: Example, scale: float) -> Example:
    """A film that looks nearly the same, and takes a fraction of the time."""
    transfer = motion.transfer
    strokes = [
        replace(stroke, target=[_scaled(place, scale) for place in stroke.target], width=stroke.width * scale)
        for stroke in transfer.strokes
    ]
    return replace(
        motion,
        transfer=replace(transfer, patch=max(SMALLEST_PATCH, round(transfer.patch * scale)), strokes=strokes),
        clip_scale=motion.clip_scale * scale,
        average_blur=motion.average_blur * scale,
        matching="none" if motion.matching == "none" else "laplacian",
        repetitions=min(motion.repetitions, 1),
    )


def _reduced_stroke(stroke, scale: float):
    points = [[x * scale, y * scale, *pressure] for x, y, *pressure in stroke.points]
    return replace(stroke, points=points, width=stroke.width * scale)


def _scaled(pair: tuple, scale: float) -> tuple:
    return pair[0] * scale, pair[1] * scale
