"""A picture taken apart into its layers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _stillwater
from .layers import _premultiplied, _straight

Array = NDArray[np.float32]
Filling = Literal["exemplar", "smooth", "none"]


def peel(
    picture: ArrayLike,
    mattes: Sequence[ArrayLike],
    fill: Filling | ArrayLike | Sequence[Filling | ArrayLike] = "exemplar",
    *,
    patch: int = 9,
    radius: float | None = None,
    grow: int = 2,
    seed: int = 0,
    progress: Callable[[str, float], bool] | None = None,
) -> list[Array]:
    """The layers of a picture: each is taken off, front to back, and what it hid is painted in behind it.

    Laid over each other (`over`) they give the picture: exactly where mattes are 0 or 1, else to rounding.

    Args:
        picture: height x width x 3 or 4, display-referred, counts as opaque.
        mattes: of each layer, the front first: height x width, 0..1. What is left behind all of them is the last layer.
        fill: what lies behind a layer: "exemplar" (patches of what is left, `inpaint`), "smooth", "none" (transparent
            behind what it covers wholly), or a painted background, height x width x 3. One for all, or one for each.
        patch, radius, grow, seed: of "exemplar", as of `inpaint`.
        progress: called with a phase and the share 0..1 of one layer that is done; answers False to cancel.

    Returns:
        One more than there are mattes: height x width x 4, straight alpha, colours free of what lies behind.

    Raises:
        ValueError: sizes differ, not one fill for all or for each, or as of `inpaint`.
        stillwater.Cancelled: `progress` said so.

    Source: Chuang et al. 2005, 3.1; DESIGN.md (the remainder that both sides share).
    """
    image = _premultiplied(picture)
    image[..., 3] = 1
    fills = list(fill) if isinstance(fill, Sequence) and not isinstance(fill, str) else [fill] * len(mattes)
    if len(fills) != len(mattes):
        raise _stillwater.BadInput(f"fill: {len(fills)} are not one for all, or one for each of {len(mattes)} mattes")
    exemplar = _stillwater.ExemplarFill(patch=patch, radius=radius, grow=grow, seed=seed)
    peeling, layers = _stillwater.Peeling(image), []
    for i, (matte, how) in enumerate(zip(mattes, fills, strict=True)):
        kind = _filling(f"fill[{i}]", how, exemplar)
        layer, _ = peeling.take(np.asarray(matte, np.float32), kind, 0.0, f"mattes[{i}]", progress)
        layers.append(layer)
    return [_whole(layer, image.shape) for layer in (*layers, peeling.rest())]


def _filling(name: str, how, exemplar):
    kinds = {"exemplar": exemplar, "smooth": _stillwater.Fill.push_pull, "none": _stillwater.Fill.none}
    if not isinstance(how, str):
        return _premultiplied(how)
    if how not in kinds:
        raise _stillwater.BadInput(f"{name}: {how!r} is not one of {', '.join(kinds)}, or a painted background")
    return kinds[how]


def _whole(layer, shape: tuple[int, ...]) -> Array:
    whole = np.zeros(shape, np.float32)
    x, y, width, height = layer.box
    whole[y : y + height, x : x + width] = layer.pixels
    return _straight(whole)
