"""Trees, plants, flags."""

import numpy as np
from numpy.typing import NDArray

from .. import _stillwater as engine
from .wind import Place, Size, Wind


def sway(
    size: Size,
    frame: float,
    armature: tuple[Place, Place],
    *,
    wind: Wind | None = None,
    fps: float = 24,
    loop: int | None = None,
    frequency: float = 0.6,
    mass: float = 1.0,
    damping: float = 0.4,
    amount: float = 1.0,
    foreshortening: float = 0.0,
    shimmer: float = 0.0,
    seed: int = 0,
    forward: bool = False,
) -> NDArray[np.float32]:
    """Displacement map of a layer that bends about the root of an armature in the wind.

    size: (width, height) of the picture, pixels.
    frame: from 1 on, may be fractional.
    armature: ((x, y) of the root, (x, y) of the tip), picture pixels; may reach outside the picture.
    wind: a Wind; None = the default one.
    fps: frames per second. loop: period in frames; None = no loop (the motion repeats after 128 s).
    frequency: natural, Hz. mass: relative. damping: 1/s.
    amount: 1 is a tip rms of 0.05 of the armature's length (upright, default wind and numbers).
    foreshortening: 0 .. 1, how much the tip's motion in depth changes the length; 1 = as seen from 30 degrees below.
    shimmer: 0 .. 1, small independent motion of leaves.
    seed: of this layer's share of the wind.
    forward: False = where to sample minus here; True = where the point of the still picture goes minus where it was.

    Returns float32, height x width x 2 (x, y), pixels. Raises BadInput (a ValueError).
    Source: Chuang et al. 2005, 3.1 and 3.2, eq. 3 to 9; METHODS.md 1.
    """
    wind = wind or Wind()
    moment = wind.moment(frame, fps, loop)
    given = engine.Sway(
        armature=armature,
        frequency=frequency,
        mass=mass,
        damping=damping,
        amount=amount,
        foreshortening=foreshortening,
        shimmer=shimmer,
        seed=seed,
    )
    displacement = engine.SwayMotion(given, moment.wind, size).at(moment, given)
    return displacement.forward_map(size) if forward else displacement.displacement_map(size)
