"""Where a steady flow carries things, and the flow between two pictures."""

from typing import Literal

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


def optical_flow(
    a: ArrayLike, b: ArrayLike, quality: Literal["fast", "medium", "best"] = "medium"
) -> NDArray[np.float32]:
    """Where what is seen at each pixel of one picture is in another.

    Args:
        a, b: height x width, or height x width x 3 or 4 (colours count by their Rec. 709 luma, alpha does not), at
            least 16 pixels a side. Any range of numbers, also negative ones.
        quality: how carefully; each step takes several times as long as the one before.

    Returns:
        float32, height x width x 2, pixels, x right, y down. 0 where nothing is seen.

    Raises:
        ValueError: an array of another shape, sizes that differ, numbers that are not finite, an unknown quality.

    Source: Kroeger et al. 2016 (dense inverse search), with variational refinement (Brox et al. 2004).
    """
    return engine.optical_flow(_grey(a), _grey(b), quality)


def _grey(image: ArrayLike) -> NDArray[np.float32]:
    pixels = np.asarray(image, np.float32)
    if pixels.ndim == 3 and pixels.shape[2] in (3, 4):
        return engine.luma(np.ascontiguousarray(pixels[..., :3]))
    return pixels
