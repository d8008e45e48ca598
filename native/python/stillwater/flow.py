"""Where a steady flow carries things."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _stillwater as engine
from .layers import _premultiplied, _straight


def flow_map(velocity: ArrayLike, frames: float | ArrayLike) -> NDArray[np.float32]:
    """Where the fluid takes each pixel in a time, minus where it was.

    One map whatever the time: made along the streamlines by classical Runge-Kutta, so that maps of two times, one after
    the other, are the map of their sum, and a picture carried far is sampled once only.

    Args:
        velocity: height x width x 2, (x right, y down), px/frame; beyond its sides the nearest pixel's holds.
        frames: the time, -10,000 .. 10,000; negative = where the fluid came from. Also height x width: a time of its
            own for each pixel.

    Returns:
        float32, height x width x 2, pixels.

    Raises:
        ValueError: an array of another shape, numbers that are not finite, a time out of range.

    Source: Okabe et al. 2009, 3 (W^k, as one map); METHODS.md 2.
    """
    times = np.asarray(frames, np.float32) if np.ndim(frames) else float(frames)
    return engine.flow_map(velocity, times)


def advect(image: ArrayLike, velocity: ArrayLike, frames: float) -> NDArray[np.float32]:
    """The image after a time in a steady flow: sampled once, Catmull-Rom, where the fluid was.

    Args:
        image: height x width x 3 or 4, display-referred, straight alpha; beyond its sides it goes on mirrored.
        velocity: height x width x 2, px/frame.
        frames: the time, -10,000 .. 10,000; negative = before.

    Returns:
        float32, height x width x 4, straight alpha.

    Raises:
        ValueError: an array of another shape, sizes that differ, numbers that are not finite, a time out of range.

    Source: Okabe et al. 2009, 3: W(I)(x) = I(x - v(x)), for any time.
    """
    return _straight(engine.advect(_premultiplied(image), velocity, frames))
