"""Outlines that move: layers made ready for them, and the outlines followed through the layer's own film."""

from collections.abc import Callable

import numpy as np

from .. import _stillwater as engine
from .cache import Prepared

LEVELS = 255  # in which coverage is kept
SMALLEST = 16  # px, of what optical flow is found in


def with_room(layer, room: int, size: tuple[int, int]):
    """The layer (engine.LayerImage of a picture of `size`) with so many clear pixels around, as far as the picture goes."""
    x, y, width, height = layer.box
    left, top = min(room, x), min(room, y)
    right, bottom = min(room, size[0] - x - width), min(room, size[1] - y - height)
    pixels = np.pad(np.asarray(layer.pixels), ((top, bottom), (left, right), (0, 0)))
    return engine.LayerImage(pixels, (x - left, y - top, left + width + right, top + height + bottom))


def opened(layer):
    """The layer's colours without its outline, in its box."""
    return engine.LayerImage(engine.extend_colours(np.asarray(layer.pixels)), layer.box)


def follow(
    film: Callable[[int], np.ndarray],
    matte: np.ndarray,
    persistence: float,
    start: np.ndarray,
    before: range,
    frames: range,
    beat: Callable[[], None],
) -> Prepared:
    """The outlines of `frames`: array outlines, frames x height x width, 0 .. 255; array last, the one after them.

    `film`: an opaque frame as height x width x 3 or more colours; `matte`: alpha, of that size; `start`: the outline of the first of
    `before` and `frames`.
    """
    outline, kept, there = start, [], None
    for frame in [*before, *frames]:
        beat()
        if frame in frames:
            kept.append(np.rint(outline * LEVELS).astype(np.uint8))
        here = _luma(film(frame)) if there is None else there
        there = _luma(film(frame + 1))
        outline = engine.moved_outline(outline, matte, _motion(here, there), persistence)
    return Prepared({"outlines": np.stack(kept), "last": outline}, {})


def _luma(frame: np.ndarray) -> np.ndarray:
    return engine.luma(np.ascontiguousarray(frame[..., :3]))


def _motion(here: np.ndarray, there: np.ndarray) -> np.ndarray:
    """Of two frames of any size."""
    height, width = here.shape
    sides = (0, max(0, SMALLEST - height)), (0, max(0, SMALLEST - width))
    return engine.optical_flow(np.pad(here, sides, "edge"), np.pad(there, sides, "edge"), "medium")[:height, :width].copy()
