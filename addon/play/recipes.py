"""The recipe as the scene has it now, as cheaply as a live picture needs it.

F-curves are sampled over the whole range, as a bake does: what animates a rate counts by its integral. The samples are
kept until an action changes. A driver can't be asked for another frame without going there: what was seen of it at
the frames shown so far is held between them.
"""

from bisect import bisect_right
from collections import defaultdict
from pathlib import Path

from .. import strokes, versions
from ..bake import places
from ..recipe.animation import Animation
from ..recipe.write import frames_to_sample, recipe_of

_sampled: dict[tuple, dict] = {}  # curves' values, by scene, picture and range
_seen: dict[tuple, dict[str, dict[int, tuple]]] = defaultdict(dict)  # of what drivers move: path -> frame -> numbers


class AnimationNow(Animation):
    """The values of one picture's animated properties, without going through the scene's frames."""

    def __init__(self, frames: range, curves: dict, seen: dict):
        self.frames = frames
        self._values = dict(curves)
        for path, numbers in seen.items():
            known = sorted(numbers)
            held = [numbers[known[max(0, bisect_right(known, frame) - 1)]] for frame in frames]
            for index, column in enumerate(zip(*held, strict=True)):
                self._values[path, index] = list(column)


def now(scene, picture) -> tuple[dict, Path]:
    """The picture's recipe at the scene's frame, and the folder its paths start at. Throws ValueError and OSError.

    Where layers have a star, the others are not visible in it.
    """
    folder = places.folder_of(picture)
    prefix = picture.path_from_id()
    frames = frames_to_sample(scene.frame_start, scene.frame_end)
    animation = AnimationNow(frames, _curves(scene, prefix, frames), _drivers(scene, prefix))
    recipe = recipe_of(scene, picture, animation, places.locate_from(folder), strokes.drawn(scene, picture))
    for layer, said in zip(picture.layers, recipe["layers"], strict=True):
        said["visible"] = layer.seen()
    return recipe, folder


def is_driven(scene, picture) -> bool:
    """Whether its numbers must be looked at anew at every frame."""
    return bool(_driven(scene, picture.path_from_id()))


def forget_curves() -> None:
    """Curves may have changed."""
    _sampled.clear()


def forget() -> None:
    """What was sampled and seen belongs to another file, or another state of this one."""
    _sampled.clear()
    _seen.clear()


def _curves(scene, prefix: str, frames: range) -> dict:
    data = scene.animation_data
    if data is None or data.action is None:
        return {}
    key = (scene.session_uid, prefix, frames)
    if key not in _sampled:
        _sampled[key] = {
            (curve.data_path, curve.array_index): [curve.evaluate(frame) for frame in frames]
            for curve in versions.curves_of(data.action, data.action_slot)
            if curve.data_path.startswith(prefix) and not curve.mute
        }
    return _sampled[key]


def _driven(scene, prefix: str) -> set[str]:
    data = scene.animation_data
    if data is None:
        return set()
    paths = {driver.data_path for driver in data.drivers if not driver.mute} | versions.stripped_paths(data)
    return {path for path in paths if path.startswith(prefix)}


def _drivers(scene, prefix: str) -> dict:
    driven, seen = _driven(scene, prefix), _seen[scene.session_uid, prefix]
    for path in seen.keys() - driven:
        del seen[path]
    for path in driven:
        value = scene.path_resolve(path)
        numbers = tuple(value) if hasattr(value, "__len__") else (value,)
        seen.setdefault(path, {})[scene.frame_current] = numbers
    return seen
