"""The layers cut out of a picture, front first, each kept for itself: a change to one leaves those in front of it."""

from collections.abc import Callable, Generator

import numpy as np

from .. import _stillwater as engine
from ..recipe import RecipeError
from .cache import Cache, Prepared
from .events import Event, Preparing, Warn
from .fills import Exemplar
from .lock import as_progress
from .prepare import Images, Sources

NOTHING = np.zeros((0, 0, 4), np.float32)


def find_stack(cache: Cache, key: str) -> Prepared | None:
    """All layers of a recipe, if every one is there: arrays "colour0", "colour1", ... and, where the picture has alpha,
    "alpha0", ...; facts "colour", "alpha": the box of each (x, y, width, height), "warnings", "has_alpha"."""
    head = cache.find(key)
    if head is None:
        return None
    layers = [cache.find(each) for each in head.facts["layers"]]
    return None if None in layers else _joined(head, layers)


def cut(
    sources: Sources, images: Images, cache: Cache, beat: Callable[[], None], fresh: bool = False
) -> Generator[Preparing, None, Prepared]:
    """Cuts the layers that the cache has not, or all of them (`fresh`), and keeps them. Answers as find_stack().

    `beat` is called again and again while it lasts.
    """
    pictures = {"colour": images.picture}
    if images.has_alpha:  # the picture's own alpha, cut like one more grey picture
        pictures["alpha"] = _grey_alpha(images.picture)
    peelings = {part: engine.Peeling(picture) for part, picture in pictures.items()}
    layers = []
    for i, (layer, key) in enumerate(zip(sources.recipe.layers, sources.layer_keys, strict=True)):
        yield Preparing(round(0.4 + 0.4 * i / len(sources.layer_keys), 3), f"cutting out {layer.name}")
        beat()
        kept = None if fresh else cache.find(key)
        if kept is None:
            with cache.lock(key, beat) as still_there:
                kept = None if fresh else cache.find(key)
                if kept is None:
                    kept = cache.store(key, _taken(peelings, images, i, layer.feather, still_there))
                    layers.append(kept)
                    continue
        leave(peelings, kept)
        layers.append(kept)
    facts = {"layers": sources.layer_keys, "warnings": images.warnings, "has_alpha": images.has_alpha}
    return _joined(cache.store(sources.key, Prepared({}, facts)), layers)


def layers_of(sources: Sources, cache: Cache, beat: Callable[[], None]) -> Generator[Event, None, Prepared]:
    """All layers of a recipe: from the cache, from another process that is at it, or cut now. Answers as find_stack().

    `beat` is called again and again while it lasts. Throws RecipeError.
    """
    stack = find_stack(cache, sources.key)
    if stack is not None:
        return stack
    with cache.lock(sources.key, beat) as still_there:
        stack = find_stack(cache, sources.key)
        if stack is None:
            images = yield from sources.read()
            yield from map(Warn, images.warnings)
            stack = yield from cut(sources, images, cache, still_there)
    return stack


def forget_stack(sources: Sources, cache: Cache) -> None:
    """Removes the layers, and what was made from them; those that another recipe has too are kept. Throws OSError."""
    cache.forget(sources.key)
    shared = {key for facts in cache.facts().values() for key in facts.get("layers", [])}
    for key in sources.layer_keys:
        if key not in shared:
            cache.forget(key)


def layer_images(stack: Prepared, part: str) -> list:
    """The layers of one part of a stack ("colour", "alpha") as the engine wants them."""
    boxes = stack.facts[part]
    return [engine.LayerImage(stack.arrays.get(f"{part}{i}", NOTHING), tuple(box)) for i, box in enumerate(boxes)]


def _taken(peelings: dict, images: Images, i: int, feather: float, beat: Callable) -> Prepared:
    """The next layer, and what lies behind it, taken off here. Throws RecipeError."""

    progress = as_progress(beat)
    arrays, facts = {}, {}
    left = peelings["colour"].left
    matte = None if images.mattes[i] is None else images.mattes[i].on(left, progress)
    for part, peeling in peelings.items():
        if matte is None:
            layer, behind = peeling.rest(), None
        else:
            fill = _fill_of(images.fills[i], part, left, progress)
            layer, behind = _take(peeling, i, matte, fill, feather, progress)
        facts[part] = list(layer.box)
        if min(layer.box[2:]) > 0:
            arrays[part] = layer.pixels
        if behind is not None and min(behind.box[2:]) > 0:
            facts |= {"behind": list(behind.box), "open": behind.open}
            arrays |= {f"behind_{part}": behind.colour, "matte": behind.matte}
    return Prepared(arrays, facts)


def _fill_of(fill, part: str, left: Callable, progress: Callable):
    """As the engine wants it. Alpha goes on smoothly where colours are filled from patches."""
    if isinstance(fill, Exemplar):
        return fill.on(left, progress) if part == "colour" else engine.Fill.push_pull
    return _grey_alpha(fill) if part == "alpha" and isinstance(fill, np.ndarray) else fill


def _take(peeling, i: int, matte, fill, feather: float, progress: Callable) -> tuple:
    try:
        return peeling.take(matte, fill, feather, f"layers[{i}]", progress)
    except engine.BadInput as error:
        raise RecipeError(f"layers[{i}].fill: {error}") from None


def leave(peelings: dict, kept: Prepared) -> None:
    """Leaves behind what a layer left when it was taken off. `peelings`: an engine.Peeling by part."""
    if "behind" not in kept.facts:
        return
    for part, peeling in peelings.items():
        behind = engine.Behind(
            kept.arrays[f"behind_{part}"], kept.arrays["matte"], tuple(kept.facts["behind"]), kept.facts["open"]
        )
        peeling.leave(behind)


def _joined(head: Prepared, layers: list[Prepared]) -> Prepared:
    parts = ("colour", "alpha") if head.facts["has_alpha"] else ("colour",)
    arrays = {f"{part}{i}": layer.arrays[part] for part in parts for i, layer in enumerate(layers) if part in layer.arrays}
    facts = {name: head.facts[name] for name in ("warnings", "has_alpha")}
    return Prepared(arrays, facts | {part: [layer.facts[part] for layer in layers] for part in parts})


def _grey_alpha(picture: np.ndarray) -> np.ndarray:
    grey = np.repeat(picture[..., 3:], 4, axis=2)
    grey[..., 3] = 1
    return grey
