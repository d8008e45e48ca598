"""The hashes that say whether something must be computed again.

A frame's key holds what that frame reads: resolved numbers, integrals, the loop, the layers' preparation, what shapes
the file, and the version of each engine used. It does not hold the recipe's text, the package's version, the frame
range or anything of a layer that is not seen. So a longer range keeps the frames it has.
"""

import msgspec

from ..recipe import Recipe
from ..recipe.fluids import Example
from ..recipe.mattes import ExemplarFill, FileFill, FileMatte, LabelMatte, TrimapMatte
from ..recipe.stochastic import Bob, Drift, Ripple, Sway
from .hashing import hashed
from .resolve import LayerNow, Now, Timeline

# Raised by who changes what an engine computes: frames and preparations made by another version are made again.
ENGINES = {
    "picture": 1,
    "layers": 8,
    "frame": 5,
    "wind": 1,
    "still": 1,
    "sway": 2,
    "ripple": 3,
    "bob": 1,
    "drift": 3,
    "flow": 2,
    "clip": 4,
    "appearance": 1,
    "example": 2,
}


def layer_keys(recipe: Recipe, digests: dict[str, str]) -> list[str]:
    """Of each layer cut out of the picture, front first: holds what it and those in front of it depend on.

    `digests`: the hash of each file the recipe names.
    """
    key = hashed(["picture", digests[recipe.picture], recipe.colour_space, _versions("picture", "layers")])
    keys = []
    for i, layer in enumerate(recipe.layers):
        fill = fill_facts(layer.fill, digests) if i + 1 < len(recipe.layers) else None  # nothing lies behind the last
        key = hashed([key, matte_facts(layer.matte, digests), fill, layer.feather])
        keys.append(key)
    return keys


def stack_key(recipe: Recipe, digests: dict[str, str]) -> str:
    """Of all layers cut out of the picture."""
    return hashed(["stack", layer_keys(recipe, digests)[-1]])


class FrameKeys:
    """The keys of a recipe's frames, written at `scale` into files of one kind."""

    def __init__(self, timeline: Timeline, stack: str, size: tuple[int, int], scale: float, digests: dict[str, str]):
        """`digests`: the hash of each file the recipe names."""
        self._timeline, self._digests = timeline, digests
        recipe = timeline.recipe
        self._needed = needed_layers(recipe)
        kinds = {type(recipe.layers[i].motion) for i in self._needed}
        self._has_waves = Ripple in kinds
        self._has_time = bool(kinds & {Ripple, Sway})
        self._drifts_in_loop = recipe.loop and Drift in kinds
        motions = {kind.__struct_config__.tag for kind in kinds} | ({"wind"} if self._has_time else set())
        motions |= {"flow", "clip", "appearance"} if Example in kinds else set()
        output = recipe.output
        self.fixed = {
            "stack": stack,
            "size": size,
            "scale": scale,
            "layers": [self._layer(i) for i in range(len(recipe.layers))],
            "view": self._view(),
            "depth": output.depth,
            "compression": output.compression,
            "names": [layer.name for layer in recipe.layers if layer.visible] if output.layers else None,
            "engines": _versions("picture", "layers", "frame", *motions),
        }

    def of(self, frame: int) -> str:
        """The key of one frame; it reads its own moment, and for the flow the next one."""
        now, after = self._timeline.at(frame), self._timeline.at(frame + 1)
        return hashed({**self.fixed, "now": self._read(now), "after": self._read(after)})

    def _read(self, now: Now):
        layers = {
            str(i): [layer.opacity if self._timeline.recipe.layers[i].visible else None, layer.motion, *_outline(layer)]
            for i, layer in enumerate(now.layers)
            if i in self._needed
        }
        moment = now.moment
        if not self._has_time:  # what drifts through a loop reads where in it it is
            return [[moment.frame, moment.first_frame, moment.loop_frames] if self._drifts_in_loop else None, layers]
        if moment.wind.gusts == 0:  # then nothing of the gusts is read
            wind = msgspec.structs.replace(moment.wind, gust_size=0, seed=0, travel=(0, 0))
            moment = msgspec.structs.replace(moment, wind=wind, loop_travel=(0, 0))
        return [moment, layers]

    def _layer(self, i: int):
        layers = self._timeline.recipe.layers
        if i not in self._needed:
            return None
        place = {layer.name: place for place, layer in enumerate(layers)}
        layer = layers[i]
        follows = layer.follows and [place[layer.follows.layer], layer.follows.mirror]
        water = place[layer.motion.water] if isinstance(layer.motion, Bob) else None
        endless = self._timeline.endless[i]
        facts = {"visible": layer.visible, "follows": follows, "water": water, "endless": endless}
        if (track := self._timeline.films[i]) is not None:
            facts["film"] = film_facts(track.example, self._digests, self._timeline.recipe)
        return facts

    def _view(self):
        recipe = self._timeline.recipe
        mirrors = any(recipe.layers[i].follows and recipe.layers[i].follows.mirror for i in self._needed)
        if self._has_waves:
            return recipe.view
        return recipe.view.horizon if mirrors else None


def _outline(layer: LayerNow) -> list:
    return [] if layer.outline is None else [layer.outline]


def needed_layers(recipe: Recipe) -> set[int]:
    """The layers that are seen, and those that they follow or float on."""
    place = {layer.name: i for i, layer in enumerate(recipe.layers)}
    waiting = [i for i, layer in enumerate(recipe.layers) if layer.visible]
    needed = set()
    while waiting:
        i = waiting.pop()
        if i in needed:
            continue
        needed.add(i)
        layer = recipe.layers[i]
        if layer.follows is not None:
            waiting.append(place[layer.follows.layer])
        if isinstance(layer.motion, Bob):
            waiting.append(place[layer.motion.water])
    return needed


def _versions(*engines: str) -> dict[str, int]:
    return {engine: ENGINES[engine] for engine in engines}


def matte_facts(matte, digests: dict[str, str]):
    """What a matte is, its file by what it holds."""
    if matte is None:
        return None
    match matte:
        case FileMatte():
            return ["file", digests[matte.file], matte.channel]
        case LabelMatte():
            return ["labels", digests[matte.labels], matte.value]
        case TrimapMatte():
            return ["trimap", digests[matte.trimap], matte.method]
    return ["drawn", matte]


def film_facts(example: Example, digests: dict[str, str], recipe: Recipe):
    """All of a film that does not change from frame to frame: the clip by what it holds, its strokes by its fields."""
    return [digests[example.clip], look_facts(example), recipe.fps, recipe.frames if recipe.loop else None]


def look_facts(example: Example) -> list:
    """The recipe's words on a film, but for its clip, what its fields are made of (flowing.py's Painting), and its speed."""
    elsewhere = ("clip", "strokes", "refine", "freeze", "speed", "outline")
    return [getattr(example, name) for name in example.__struct_fields__ if name not in elsewhere]


def fill_facts(fill, digests: dict[str, str]):
    """How a hole is filled, a file by what it holds."""
    match fill:
        case FileFill():
            return ["file", digests[fill.file]]
        case ExemplarFill():
            source = matte_facts(fill.source, digests)
            return ["exemplar", fill.patch, fill.radius, fill.grow, source, fill.touch_up]
    return ["none"]
