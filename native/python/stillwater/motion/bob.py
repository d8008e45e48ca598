"""Boats."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .. import _stillwater as engine
from .ripple import Ripple
from .ripple import water as water_at
from .wind import Place, Size, Wind


def bob(
    size: Size,
    frame: float,
    waterline: Sequence[Place],
    horizon: tuple[Place, Place],
    *,
    water: Ripple | None = None,
    fov: float = 50,
    height: float = 1.7,
    wind: Wind | None = None,
    fps: float = 24,
    loop: int | None = None,
    amount: float = 1.0,
    forward: bool = False,
) -> NDArray[np.float32]:
    """Displacement map of a boat: it heaves and rolls, as a whole, with the water under its waterline.

    size: (width, height) of the picture, pixels.
    frame: from 1 on, may be fractional.
    waterline: (x, y), two or more, along the hull's waterline, picture pixels.
    horizon, fov, height, wind, fps, loop: of the water, see ripple().
    water: a Ripple; None = the default one.
    amount: strength of heave and roll.
    forward: False = where to sample minus here; True = where the point of the still picture goes minus where it was.

    Returns float32, height x width x 2 (x, y), pixels. Raises BadInput (a ValueError).
    Source: Chuang et al. 2005, 3.4; METHODS.md 1.
    """
    under = water_at(size, frame, horizon, water or Ripple(), fov=fov, height=height, wind=wind, fps=fps, loop=loop)
    displacement = engine.bob(engine.Bob(waterline=waterline, amount=amount), under, size)
    return displacement.forward_map(size) if forward else displacement.displacement_map(size)
