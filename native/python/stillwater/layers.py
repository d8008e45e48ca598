"""Images displaced and laid over each other."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _stillwater


def displace(image: ArrayLike, map: ArrayLike) -> NDArray[np.float32]:
    """The image sampled where a displacement map says: `out(p) = image(p + map(p))`.

    Catmull-Rom with the exact weights of each place; beyond its sides the image's edge repeats. Works premultiplied,
    so that no colour of transparent pixels shows.

    Args:
        image: height x width x 3 or 4, display-referred, straight alpha.
        map: height x width x 2, (x, y) in pixels, of the result's size; what `sway`, `ripple`, `bob`, `drift` give.

    Returns:
        height x width x 4, straight alpha, of the map's size.

    Raises:
        ValueError: an array of another shape, or an empty one.

    Source: Chuang et al. 2005, 3 (inverse warp, always from the original); Catmull and Rom 1974.
    """
    return _straight(_stillwater.displace(_premultiplied(image), map))


def over(front: ArrayLike, back: ArrayLike) -> NDArray[np.float32]:
    """The front laid over the back, on display-referred values.

    Args:
        front: height x width x 3 or 4, straight alpha.
        back: the same size.

    Returns:
        height x width x 4, straight alpha.

    Raises:
        ValueError: sizes differ.

    Source: Porter and Duff 1984, "over".
    """
    return _straight(_stillwater.over(_premultiplied(front), _premultiplied(back)))


def _premultiplied(image: ArrayLike) -> NDArray[np.float32]:
    image = np.asarray(image, np.float32)
    if image.ndim == 3 and image.shape[2] == 3:
        image = np.concatenate([image, np.ones_like(image[..., :1])], axis=2)
    if image.ndim != 3 or image.shape[2] != 4:
        raise _stillwater.BadInput(f"image: an array of {' x '.join(map(str, image.shape))} is not height x width x 3 or 4")
    return np.concatenate([image[..., :3] * image[..., 3:], image[..., 3:]], axis=2)


def _straight(image: NDArray[np.float32]) -> NDArray[np.float32]:
    alpha = image[..., 3:]
    return np.concatenate([np.divide(image[..., :3], alpha, out=image[..., :3].copy(), where=alpha > 0), alpha], axis=2)
