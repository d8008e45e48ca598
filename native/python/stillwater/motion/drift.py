"""Clouds."""

from math import cos, radians

import numpy as np
from numpy.typing import NDArray

from .. import _stillwater as engine
from .wind import Size, Wind


def drift(
    size: Size,
    frame: float,
    *,
    velocity: tuple[float, float] | None = None,
    wind: float = 0.5,
    under: Wind | None = None,
    forward: bool = False,
) -> NDArray[np.float32]:
    """Displacement map of a layer that passes evenly. The map leads outside the picture; the layer is cyclic.

    size: (width, height) of the picture, pixels.
    frame: from 1 on, where the layer is at its place; may be fractional.
    velocity: (x, y), px/frame; None = the wind's.
    wind: without a velocity, px/frame to the right for each m/s of the wind's part along the picture.
    under: the Wind that counts there; None = the default one.
    forward: False = where to sample minus here; True = where the point of the still picture goes minus where it was.

    Returns float32, height x width x 2 (x, y), pixels: the same everywhere. Raises BadInput (a ValueError).
    In a loop that no whole turns close, two copies are cross-faded, which one map can't say: that is the renderer's.
    Source: Chuang et al. 2005, 3.1; METHODS.md 1.
    """
    if velocity is None:
        under = under or Wind()
        velocity = (wind * under.speed * cos(radians(under.direction)), 0)
    displacement = engine.Translation(tuple(v * (frame - 1) for v in velocity))
    return displacement.forward_map(size) if forward else displacement.displacement_map(size)
