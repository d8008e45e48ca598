"""Holes of a picture filled with what the rest of it is made of."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _stillwater
from .layers import _premultiplied, _straight

Progress = Callable[[str, float], bool]


def inpaint(
    picture: ArrayLike,
    hole: ArrayLike,
    patch: int = 9,
    radius: float | None = None,
    seed: int = 0,
    source: ArrayLike | None = None,
    grow: int = 2,
    progress: Progress | None = None,
) -> NDArray[np.float32]:
    """Fill a hole with copies from the rest of the picture: lines, horizons and textures go on through it.

    Coarse to fine: structure first on the coarsest level, then rounds of search and vote; at last every pixel is a copy
    of one of the source, seams lie where they are seen least, and what differs along them is spread smoothly. Another
    seed gives another filling.

    Args:
        picture: height x width x 3 or 4, display-referred, straight alpha. What it holds in the hole is not read.
        hole: height x width, bool or 0..1; filled where it is at least one half.
        patch: side of the patches that are compared, px, odd, 3..63. About the size of the texture's details.
        radius: how far a patch may come from, px; None = from anywhere.
        seed: of the random search, 0 or more.
        source: height x width, bool or 0..1; patches come from where it is at least one half. None = from anywhere.
        grow: patches come from no nearer to the hole's edge than this, px, 0..1000. Never changes pixels of the result.
        progress: is called with a phase's name and the share of the whole that is done; answers False to cancel.

    Returns:
        height x width x 4, straight alpha. Pixels outside the hole are those of the picture, bit by bit.

    Raises:
        ValueError: another shape, size, or range than above; numbers that are not finite; a hole that covers
            everything; a patch larger than the picture; nothing to copy from (within the radius).
        stillwater.Cancelled: `progress` said so.

    Source: Criminisi, Perez and Toyama 2003, equations 1 - 3 (order); Barnes et al. 2009 (search); Wexler et al. 2007
    (vote); Pritch et al. 2009 (shift map); Perez et al. 2003, equation 7 (blending).
    """
    given = _with_alpha(picture)
    filled = _straight(
        _stillwater.inpaint(
            _premultiplied(given), np.asarray(hole, np.float32), patch=patch, radius=radius, seed=_checked(seed),
            grow=grow, source=None if source is None else np.asarray(source, np.float32), progress=progress,
        )
    )  # fmt: skip
    return np.where(np.asarray(hole, np.float32)[..., None] >= 0.5, filled, given)


def make_cyclic(
    picture: ArrayLike,
    along_x: bool = True,
    along_y: bool = False,
    known: ArrayLike | None = None,
    patch: int = 9,
    seed: int = 0,
    progress: Progress | None = None,
) -> NDArray[np.float32]:
    """Make a picture endless: it wraps without a seam, so that it can drift for ever.

    The picture is kept as it is and continued, along the axes asked for, by a strip a quarter of its side wide, filled
    as `inpaint` does, that leads from its end to its beginning. The result is one period.

    Args:
        picture: height x width x 3 or 4, display-referred, straight alpha.
        along_x, along_y: the axes.
        known: height x width, bool or 0..1; what is below one half (hidden by something in front) is filled too.
            None = all is known.
        patch: see `inpaint`.
        seed: see `inpaint`.
        progress: see `inpaint`.

    Returns:
        height x width x 4, straight alpha; sides that were continued are a quarter longer (rounded up). Known pixels
        are those of the picture, bit by bit.

    Raises:
        ValueError: another shape or size; nothing known; numbers that are not finite; a patch out of its range.
        stillwater.Cancelled: `progress` said so.

    Source: Chuang et al. 2005, 3 (clouds as a cyclic texture); see `inpaint`.
    """
    given = _with_alpha(picture)
    whole = _straight(
        _stillwater.make_cyclic_by_exemplars(
            _premultiplied(given), along_x=along_x, along_y=along_y, patch=patch, seed=_checked(seed),
            progress=progress, known=None if known is None else np.asarray(known, np.float32),
        )
    )  # fmt: skip
    kept = True if known is None else np.asarray(known, np.float32)[..., None] > 0.5
    height, width = given.shape[:2]
    whole[:height, :width] = np.where(kept, given, whole[:height, :width])
    return whole


def _checked(seed: int) -> int:
    if not 0 <= seed < 2**63:
        raise _stillwater.BadInput(f"seed: {seed} is not between 0 and {2**63 - 1}")
    return seed


def _with_alpha(picture: ArrayLike) -> NDArray[np.float32]:
    picture = np.asarray(picture, np.float32)
    if picture.ndim == 3 and picture.shape[2] == 3:
        return np.concatenate([picture, np.ones_like(picture[..., :1])], axis=2)
    return picture
