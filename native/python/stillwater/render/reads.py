"""Why a frame is out of date: what it read when it was rendered, part by part, beside what it would read now.

A frame's file holds its key (keys.py) and after it, as JSON, a digest of each part of the recipe that it reads. The key
alone decides whether the frame stands; the parts only name what changed. Layers go by their names here, so that one
added in front does not make all others look changed.
"""

from pathlib import Path

import msgspec

from .. import _stillwater as engine
from ..recipe.fluids import Example, Flow
from ..recipe.stochastic import Bob, Drift, Ripple, Sway
from .hashing import hashed
from .keys import fill_facts, film_facts, matte_facts, needed_layers
from .resolve import Timeline

# part -> digest; "layers": name -> part -> digest; "engines": name -> version
Parts = dict[str, str | dict[str, int | dict[str, str]]]

WORDS = {
    "picture": "picture changed",
    "output": "output settings changed",
    "timing": "frame rate or loop changed",
    "seed": "seed changed",
    "view": "view changed",
    "wind": "wind changed",
}


class Reads:
    """What the frames of a recipe read. `digests`: the hash of each file; `fixed`: what shapes the frames' files."""

    def __init__(self, timeline: Timeline, digests: dict[str, str], fixed: dict):
        self._timeline, self._digests = timeline, digests
        recipe = timeline.recipe
        self._needed = needed_layers(recipe)
        motions = [recipe.layers[i].motion for i in self._needed]
        self._has_time = any(isinstance(motion, Ripple | Sway) for motion in motions)
        self._is_blown = any(isinstance(motion, Drift) and motion.velocity is None for motion in motions)
        seeds = [recipe.wind.seed, *(motion.seed for motion in motions if isinstance(motion, Ripple | Sway))]
        goes_round = recipe.loop and any(isinstance(motion, Drift | Flow | Example) for motion in motions)
        self._fixed = {
            "engines": fixed["engines"],
            "picture": _digest([digests[recipe.picture], recipe.colour_space, fixed["size"]]),
            "output": _digest([fixed[name] for name in ("scale", "depth", "compression", "names")]),
            "timing": _digest([
                recipe.fps if self._has_time else None,
                recipe.loop and (self._has_time or goes_round) and recipe.frames,
            ]),
            "seed": _digest(recipe.seed if self._has_time and None in seeds else None),
            "view": _digest(fixed["view"]),
            "order": _digest([layer.name for layer in recipe.layers]),
        }  # fmt: skip
        last = len(recipe.layers) - 1
        self._cut = [
            {
                "matte": _digest([matte_facts(layer.matte, digests), layer.feather]),
                "fill": _digest(fill_facts(layer.fill, digests) if i < last else None),
            }
            for i, layer in enumerate(recipe.layers)
        ]

    def of(self, frame: int) -> Parts:
        """The digests of one frame's parts."""
        layers = self._timeline.recipe.layers
        states = [self._timeline.at(at).layers for at in (frame, frame + 1)]  # the flow looks one frame ahead
        moving = {i: self._moving(i, [state[i] for state in states]) for i in self._needed}
        unseen = {"visibility": _digest(None)}
        parts = {layer.name: {**self._cut[i], **moving.get(i, unseen)} for i, layer in enumerate(layers)}
        return {**self._fixed, "wind": _digest(self._wind(frame)), "layers": parts}

    def _moving(self, i: int, states: list) -> dict[str, str]:
        layer = self._timeline.recipe.layers[i]
        water = layer.motion.water if isinstance(layer.motion, Bob) else None
        if isinstance(layer.motion, Drift) and layer.motion.velocity is None:
            motions = [layer.motion.wind]  # how far it comes is the wind's part
        elif isinstance(layer.motion, Sway | Ripple):
            motions = [msgspec.structs.replace(state.motion, seed=layer.motion.seed) for state in states]
        else:
            motions = [state.motion for state in states]
        seen = [state.opacity for state in states] if layer.visible else None
        film = film_facts(layer.motion, self._digests, self._timeline.recipe) if isinstance(layer.motion, Example) else None
        outlines = [state.outline for state in states if state.outline is not None]
        motion = _digest([motions, layer.follows, water, self._timeline.endless[i], film, *outlines])
        return {"motion": motion, "visibility": _digest(seen)}

    def _wind(self, frame: int):
        """The wind as the artist set it: its way in m/s x frames, which another frame rate does not change."""
        if not (self._has_time or self._is_blown):
            return None
        moments = [self._timeline.at(at).moment.wind for at in (frame, frame + 1)]
        has_gusts = self._has_time and any(moment.gusts for moment in moments)
        way = [self._timeline.way(at) for at in (frame, frame + 1)] if has_gusts or self._is_blown else None
        blows = [(moment.speed, moment.direction, moment.gusts) for moment in moments] if self._has_time else None
        wind = self._timeline.recipe.wind
        return [blows, way, [wind.gust_size, wind.seed] if has_gusts else None]


def mark(key: str, parts: Parts) -> str:
    """What is written into a frame's file."""
    return f"{key} {msgspec.json.encode({'parts': parts}, order='deterministic').decode()}"


def read_mark(path: Path) -> tuple[str, Parts]:
    """The key of a frame on disk, and its parts; empty where the file is not there, or has none."""
    key, _, rest = engine.read_frame_key(str(path)).partition(" ")
    try:
        parts = msgspec.json.decode(rest or "{}", type=dict[str, Parts])
    except msgspec.DecodeError:
        parts = {}
    return key, parts.get("parts", {})


def reasons(before: Parts, now: Parts) -> list[str]:
    """What changed, as clauses ("wind changed", "motion of tree changed"), for a frame that does not stand.

    Another frame rate or loop changes what wind and motions come to: they are not named beside it.
    """
    if not before:
        return ["made by something else"]
    in_time = before.get("timing") == now["timing"]
    engines = before.get("engines", {})
    newer = any(engines.get(name, version) != version for name, version in now["engines"].items())
    found = ["the engine is another version"] if newer else []
    found += [
        clause for part, clause in WORDS.items() if before.get(part) != now[part] and (in_time or part != "wind")
    ]
    was, are = before.get("layers", {}), now["layers"]
    found += [f"layer {name} was added" for name in are if name not in was]
    found += [f"layer {name} was removed" for name in was if name not in are]
    if was.keys() == are.keys() and before.get("order") != now["order"]:
        found.append("order of the layers changed")
    for name, parts in are.items():
        told = {part: digest for part, digest in parts.items() if in_time or part != "motion"}
        then = was.get(name, {})
        found += [f"{part} of {name} changed" for part, digest in told.items() if then.get(part, digest) != digest]
    return found or ["something it reads changed"]


def _digest(facts) -> str:
    """Short: it only has to tell a part from what it was."""
    return hashed(facts)[:12]
