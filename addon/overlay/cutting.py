"""A matte while it is drawn: what lies outside it is veiled, by a colour or as if it were transparent.

Knows nothing of Blender; `live` is a stillwater.Live, `sketch` a play/stage.py Sketch, or None.
"""

from dataclasses import dataclass

import numpy as np

TINT, STRENGTH = (0.85, 0.05, 0.1), 0.55  # as the red film of a darkroom
LIGHT, DARK = 0.6, 0.35
SQUARE = 8  # px of a veil
LARGEST = 1024  # px: the longer side of a veil


@dataclass(frozen=True)
class Cut:
    """How much of each pixel belongs to a layer."""

    coverage: np.ndarray  # height x width, 0 .. 1
    scale: float  # its pixels for one of the picture


def cut(layer: str, live, sketch, picture_width: int) -> Cut | None:
    """What is known of a layer's matte: its sketch while there is one, else what frames are made of."""
    if sketch is not None and sketch.layer == layer:
        step = max(1, -(-max(sketch.matte.shape) // LARGEST))
        small = sketch.matte[step // 2 :: step, step // 2 :: step].astype(np.float32) / 255
        return Cut(small, 1 / step if picture_width == sketch.matte.shape[1] else small.shape[1] / picture_width)
    if live is not None and layer in live.layers:
        return Cut(live.coverage(layer), live.scale)
    return None


def veil(coverage: np.ndarray, checker: bool) -> np.ndarray:
    """Height x width x 4, straight alpha, to be laid over the picture, top row first."""
    height, width = coverage.shape
    made = np.empty((height, width, 4), np.float32)
    if checker:
        rows, columns = np.arange(height) // SQUARE, np.arange(width) // SQUARE
        made[..., :3] = np.where((rows[:, None] + columns) % 2, LIGHT, DARK)[..., None]
        made[..., 3] = 1 - coverage
    else:
        made[..., :3] = TINT
        made[..., 3] = STRENGTH * (1 - coverage)
    return made
