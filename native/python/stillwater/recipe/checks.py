"""What a recipe must fulfil beyond types and ranges, as far as it can be seen without opening a file."""

import math
from collections.abc import Iterator

from .engines import without_engine
from .fluids import Example, Flow
from .keyframes import Keyframes
from .mattes import ExemplarFill
from .picture import Layer, Recipe
from .stochastic import Bob, Drift, Ripple, Sway

SHORTEST = 1e-6  # px: two places closer than this are one
MOST_PERSISTENT = 0.98  # of an outline in a loop


def problems_of(recipe: Recipe) -> list[str]:
    """A sentence for each problem."""
    return [
        *_whole(recipe),
        *_names(recipe),
        *(sentence for i, layer in enumerate(recipe.layers) for sentence in _layer(recipe, i, layer)),
        *_cycles(recipe),
    ]


def _whole(recipe: Recipe) -> Iterator[str]:
    first, last = recipe.frames
    if last < first:
        yield f"frames: [{first}, {last}] runs backwards (the first is not above the last)"
    if recipe.picture is None and not all(isinstance(layer.motion, Keyframes) for layer in recipe.layers):
        yield "picture: missing (only a recipe of nothing but keyframes layers needs none)"
    elif recipe.picture is None and recipe.size is None:
        yield "size: missing (required without a picture)"
    if "/" in recipe.output.name or "\\" in recipe.output.name or "\0" in recipe.output.name:
        yield f'output.name: "{recipe.output.name}" is not a file name'
    horizon = recipe.view.horizon
    if horizon is not None and _distance(*horizon) <= SHORTEST:
        yield "view.horizon: a line from a point to itself is not a line with two different ends"


def _names(recipe: Recipe) -> Iterator[str]:
    seen: dict[str, int] = {}
    for i, layer in enumerate(recipe.layers):
        if layer.name in seen:
            yield f'layers[{i}].name: "{layer.name}" is the name of layers[{seen[layer.name]}] already (names are unique)'
        seen.setdefault(layer.name, i)


def _layer(recipe: Recipe, i: int, layer: Layer) -> Iterator[str]:
    place = f"layers[{i}]"
    yield from without_engine(layer, place)
    if layer.matte is None and i + 1 < len(recipe.layers):
        yield f"{place}.matte: missing (only the last layer needs none)"
    if isinstance(layer.fill, ExemplarFill) and layer.fill.patch % 2 == 0:
        yield f"{place}.fill.patch: {layer.fill.patch} is not odd (px)"
    if layer.follows is not None:
        yield from _known_layer(recipe, f"{place}.follows.layer", layer.follows.layer)
        yield from _no_flow_in_it(recipe, place, layer)
    match layer.motion:
        case Sway(armature=armature) if _distance(*armature) <= SHORTEST:
            yield f"{place}.motion.armature: a line from a point to itself is not a line with two different ends"
        case Ripple() if recipe.view.horizon is None:
            yield f"view.horizon: missing ({place}.motion, a ripple, needs it)"
        case Bob(waterline=points, water=water):
            if all(_distance(points[0], point) <= SHORTEST for point in points):
                yield f"{place}.motion.waterline: one point is not a line with two different ends"
            yield from _known_layer(recipe, f"{place}.motion.water", water, Ripple)
        case Drift(velocity=velocity, wind=wind) if velocity is not None and wind != 0.5:
            yield f"{place}.motion: velocity and wind are both given (only one of them can hold)"
        case Flow() | Example() as fluid:
            yield from _directions(fluid, f"{place}.motion.strokes")
            yield from _comes_round(recipe, fluid, f"{place}.motion.outline.persistence")


def _no_flow_in_it(recipe: Recipe, place: str, layer: Layer) -> Iterator[str]:
    if isinstance(layer.motion, Flow | Example):
        yield f"{place}.follows: a layer that flows follows no other"
    led = next((other for other in recipe.layers if other.name == layer.follows.layer), None)
    if led is not None and isinstance(led.motion, Flow | Example):
        yield f'{place}.follows.layer: "{led.name}" is not a layer that can be followed (it flows)'


def _comes_round(recipe: Recipe, fluid: Flow | Example, place: str) -> Iterator[str]:
    outline = fluid.outline
    if recipe.loop and outline is not None and outline.moving and outline.persistence > MOST_PERSISTENT:
        yield f"{place}: {outline.persistence:g} is not between 0 and {MOST_PERSISTENT:g} (the recipe loops; an outline that lasts longer does not come back)"


def _directions(flow: Flow | Example, place: str) -> Iterator[str]:
    """At every frame some stroke must say where the flow goes."""
    if not flow.strokes:
        yield f"{place}: none; where does the layer flow? (at least one is needed)"
        return
    for frame, strokes in flow.drawn():
        if not any(stroke.kind != "speed" and stroke.alpha > 0 for stroke in strokes):
            at = "" if frame is None else f" at frame {frame}"
            yield f'{place}: none{at} says where the layer flows (kind "orientation" or "both", alpha above 0)'


def _known_layer(recipe: Recipe, place: str, name: str, kind: type | None = None) -> Iterator[str]:
    named = {layer.name: layer for layer in recipe.layers}
    wanted = [layer.name for layer in recipe.layers if kind is None or isinstance(layer.motion, kind)]
    what = "a ripple layer" if kind is Ripple else "a layer"
    known = f" (there {'is' if len(wanted) == 1 else 'are'} {', '.join(wanted[:20])})" if wanted else " (there is none)"
    if name not in named or (kind is not None and not isinstance(named[name].motion, kind)):
        yield f'{place}: "{name}" is not {what}{known}'


def _cycles(recipe: Recipe) -> Iterator[str]:
    """A layer may not depend on itself, through `follows` and `water`."""
    needs = {layer.name: list(_needs(layer)) for layer in recipe.layers}
    for i, layer in enumerate(recipe.layers):
        way = _way_back(layer.name, needs)
        if way and layer.name == min(way, key=[other.name for other in recipe.layers].index):
            yield f"layers[{i}]: depends on itself in a circle ({' -> '.join([*way, layer.name])})"


def _needs(layer: Layer) -> Iterator[str]:
    if layer.follows is not None:
        yield layer.follows.layer
    if isinstance(layer.motion, Bob):
        yield layer.motion.water


def _way_back(start: str, needs: dict[str, list[str]]) -> list[str]:
    """The names passed from `start` back to `start`, none where there is no such way."""
    ways, seen = [[start]], set()
    while ways:
        way = ways.pop()
        for name in needs.get(way[-1], ()):
            if name == start:
                return way
            if name not in seen:
                seen.add(name)
                ways.append([*way, name])
    return []


def _distance(a, b) -> float:
    return math.dist(a, b)


