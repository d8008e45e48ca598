"""Water."""

from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray

from .. import _stillwater as engine
from .wind import Place, Size, Wind


@dataclass(frozen=True)
class Ripple:
    """A plane of waves, as the recipe's `ripple` names it.

    amplitude: 1 is the significant height of a grown sea at the wind (0.53 m at 5 m/s; phillips, pierson-moskowitz).
    roughness: how many times the tile is repeated over the same water.
    tile: side of the periodic field, m, 10 .. 2000. resolution: samples a side, a power of two, 16 .. 2048.
    mode: "height" = displaced by the height, "normal" = by the slope, 0.04 of the picture's width for a slope of 1.
    spectrum: "phillips", "pierson-moskowitz", "jonswap" or "tma".
    fetch: length of open water under the wind, km (jonswap, tma). depth: m (tma).
    seed: of the noise.
    """

    amplitude: float = 1.0
    roughness: float = 1.0
    tile: float = 60.0
    resolution: int = 256
    mode: str = "height"
    spectrum: str = "phillips"
    fetch: float = 100.0
    depth: float = 200.0
    seed: int = 0


def water(
    size: Size,
    frame: float,
    horizon: tuple[Place, Place],
    given: Ripple,
    *,
    fov: float = 50,
    height: float = 1.7,
    wind: Wind | None = None,
    fps: float = 24,
    loop: int | None = None,
) -> engine.Displacement:
    """The engine's displacement of one moment's water; the arguments are those of `ripple`, `given` a Ripple."""
    moment = (wind or Wind()).moment(frame, fps, loop)
    native = engine.Ripple(**asdict(given))
    view = engine.View(horizon=horizon, fov=fov, height=height)
    return engine.RippleMotion(native, view, moment.wind, size).at(moment, native)


def ripple(
    size: Size,
    frame: float,
    horizon: tuple[Place, Place],
    *,
    fov: float = 50,
    height: float = 1.7,
    wind: Wind | None = None,
    fps: float = 24,
    loop: int | None = None,
    amplitude: float = 1.0,
    roughness: float = 1.0,
    tile: float = 60.0,
    resolution: int = 256,
    mode: str = "height",
    spectrum: str = "phillips",
    fetch: float = 100.0,
    depth: float = 200.0,
    seed: int = 0,
    forward: bool = False,
) -> NDArray[np.float32]:
    """Displacement map of a plane of waves, seen in perspective. On and above the horizon nothing moves.

    size: (width, height) of the picture, pixels.
    frame: from 1 on, may be fractional.
    horizon: ((x, y), (x, y)), two points of it, picture pixels; any tilt, in the picture or not.
    fov: horizontal field of view, degrees, 5 .. 150. height: of the eye over the water, m.
    wind: a Wind; None = the default one. Its direction, over the ground: 0 = right along the horizon, 90 = away.
    fps: frames per second. loop: period in frames; frequencies are rounded to multiples of its inverse.
    amplitude, roughness, tile, resolution, mode, spectrum, fetch, depth, seed: see Ripple.
    forward: False = where to sample minus here (what the nearest crest shows); True = where the point of the still
        picture goes minus where it was.

    Returns float32, height x width x 2 (x, y), pixels. Raises BadInput (a ValueError).
    Source: Chuang et al. 2005, 3.3, eq. 10 to 13; Tessendorf 2001, 4.3; METHODS.md 1.
    """
    given = Ripple(amplitude, roughness, tile, resolution, mode, spectrum, fetch, depth, seed)
    displacement = water(size, frame, horizon, given, fov=fov, height=height, wind=wind, fps=fps, loop=loop)
    return displacement.forward_map(size) if forward else displacement.displacement_map(size)


def wave_heights(
    seconds: float,
    *,
    tile: float = 60.0,
    resolution: int = 256,
    spectrum: str = "phillips",
    fetch: float = 100.0,
    depth: float = 200.0,
    seed: int = 0,
    wind: Wind | None = None,
    loop_seconds: float | None = None,
) -> NDArray[np.float32]:
    """The water's heights at a time, amplitude 1, over the periodic tile.

    seconds: since frame 1. loop_seconds: period; frequencies are rounded to multiples of its inverse; None = none.
    tile: side, m. resolution, spectrum, fetch, depth, seed: see Ripple. wind: a Wind; None = the default one.

    Returns float32, resolution x resolution, m: rows away from the viewer, columns to the right.
    Deep water, omega^2 = g k; for "tma", whose water may be shallow, omega^2 = g k tanh(k depth).
    Raises BadInput (a ValueError).
    Source: Tessendorf 2001, eq. 36 to 43; METHODS.md 1.
    """
    wind = wind or Wind()
    return engine.wave_heights(
        tile=tile,
        resolution=resolution,
        spectrum=spectrum,
        fetch=fetch,
        depth=depth,
        seed=seed,
        speed=wind.speed,
        direction=wind.direction,
        seconds=seconds,
        period=loop_seconds or 0.0,
    )
