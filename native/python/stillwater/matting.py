"""Soft layers from what an artist scribbles: mattes, and colours without the old background."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _stillwater as engine
from .images import write
from .layers import _premultiplied

if TYPE_CHECKING:
    from .recipe.mattes import LassoMatte, ScribbleMatte

Array = NDArray[np.float32]
Progress = Callable[[str, float], bool]

METHODS = {"closed-form": engine.MattingMethod.closed_form, "bayesian": engine.MattingMethod.bayesian}


def trimap(
    picture: ArrayLike,
    *,
    scribbles: Mapping[str, Sequence[Mapping[str, Any]]] | None = None,
    lasso: Sequence[Sequence[float]] | None = None,
    feather: float = 8.0,
    snap: float = 0.0,
) -> Array:
    """What is known of each pixel, from strokes or from an outline: one of the two is given.

    Args:
        picture: height x width x 3 or 4, display-referred. Of scribbles only its size matters.
        scribbles: {"foreground": [stroke], "background": [stroke]}; a stroke is {"points": [[x, y] or [x, y, pressure]],
            "width": 10}, in pixels, pressure 0..1 scales the width. However thin, it draws at least the pixels it
            passes. All else is unknown.
        lasso: [[x, y], ...], the corners of an outline: inside is foreground, outside background.
        feather: px, 0 .. 1000; so far on both sides of the outline is unknown.
        snap: px, 0 .. 1000; how far the outline is pulled to edges (live wire).

    Returns:
        height x width: 1 foreground, 0 background, 0.5 unknown.

    Raises:
        ValueError: not one of the two is given; no foreground or no background stroke, or none of them touches the
            picture; strokes that contradict each other (which, and where); numbers out of range; an outline with
            nothing inside or outside.

    Source: Mortensen and Barrett 1995, "Intelligent scissors for image composition" (`snap`).
    """
    if (scribbles is None) == (lasso is None):
        raise engine.BadInput("trimap: one of scribbles and lasso is given, not both or none")
    image = _colours(picture)
    if lasso is not None:
        return engine.trimap_from_lasso(image, [_place(f"lasso[{i}]", point) for i, point in enumerate(lasso)], feather, snap)
    if unknown := set(scribbles) - {"foreground", "background"}:
        raise engine.BadInput(f"scribbles: {', '.join(sorted(unknown))} is not foreground or background")
    strokes = {kind: _strokes(f"scribbles.{kind}", scribbles.get(kind, ())) for kind in ("foreground", "background")}
    return engine.trimap_from_scribbles((image.shape[1], image.shape[0]), **strokes)


def matte(
    picture: ArrayLike,
    trimap: ArrayLike,
    method: Literal["closed-form", "bayesian"] = "closed-form",
    *,
    finest: int = 1,
    progress: Progress | None = None,
) -> Array:
    """The matte of what a trimap cuts out of a picture.

    Args:
        picture: height x width x 3 or 4, display-referred. It counts as opaque: alpha, where there is one, is laid over
            black.
        trimap: height x width: 0.9 and above is foreground, 0.1 and below background, all between unknown.
        method: "closed-form" or "bayesian".
        finest: 2, 4 or 8 solves the closed form on a picture so many times smaller, and enlarges the matte by the picture's
            detail: a preview. 1 solves it all.
        progress: called with a phase and the share 0..1 that is done, at most ten times a second; answers False to
            cancel.

    Returns:
        height x width, alpha 0..1; 1 and 0 where the trimap knows.

    Raises:
        ValueError: sizes differ, a colour is not a finite number, no pixel is foreground, or none is background, or
            `finest` is another number.
        stillwater.Cancelled: `progress` said so.

    Source: Levin, Lischinski and Weiss 2008, "A closed-form solution to natural image matting", eq. 12 and 13.
    """
    options = engine.MatteOptions()
    options.method, options.finest = _method(method), finest
    return engine.matte(_colours(picture), trimap, options, progress)


def foreground(picture: ArrayLike, alpha: ArrayLike, *, progress: Progress | None = None) -> tuple[Array, Array]:
    """The colours that a picture is mixed from: picture = alpha * foreground + (1 - alpha) * background.

    Args:
        picture: height x width x 3 or 4, display-referred, counts as opaque.
        alpha: height x width, 0..1.
        progress: as of `matte`.

    Returns:
        foreground and background, each height x width x 3: both are given at every pixel, smoothly where alpha says
        nothing of them.

    Raises:
        ValueError: sizes differ, or numbers are not finite or outside 0..1.
        stillwater.Cancelled: `progress` said so.

    Source: Germer, Uelwer, Conrad and Harmeling 2020, "Fast multi-level foreground estimation", eq. 4.
    """
    front, back = engine.foreground_and_background(_colours(picture), alpha, progress=progress)
    return front[..., :3], back[..., :3]


def drawn_trimap(picture: ArrayLike, drawn: ScribbleMatte | LassoMatte) -> Array:
    """The trimap of what a recipe's matte draws. Raises as `trimap` does."""
    import msgspec

    given = msgspec.to_builtins(drawn)
    given.pop("method")
    return trimap(picture, **given)


def cut_out(picture: ArrayLike, alpha: ArrayLike) -> Array:
    """What a matte cuts out of a picture, in its own colours: height x width x 4, straight alpha."""
    alpha = np.asarray(alpha, np.float32)
    return np.concatenate([foreground(picture, alpha)[0], alpha[..., None]], axis=2)


def write_matte(path: str | os.PathLike[str], alpha: ArrayLike) -> None:
    """Writes a matte so that it is read back as it was: grey, in OpenEXR (whose colours are scene-linear) white with alpha."""
    grey = np.asarray(alpha, np.float32)[..., None]
    white = np.ones_like(grey)
    linear = os.fspath(path).lower().endswith(".exr")
    write(path, np.concatenate([white, white, white, grey] if linear else [grey, grey, grey, white], axis=2))


def _colours(picture: ArrayLike) -> Array:
    """Height x width x 3, or x 4 premultiplied, as the engine takes it."""
    picture = np.asarray(picture, np.float32)
    return picture if picture.ndim == 3 and picture.shape[2] == 3 else _premultiplied(picture)


def _strokes(name: str, strokes: Sequence[Mapping[str, Any]]) -> list:
    given = []
    for i, stroke in enumerate(strokes):
        if not {"points"} <= set(stroke) <= {"points", "width"}:
            raise engine.BadInput(f"{name}[{i}]: {', '.join(sorted(stroke)) or 'nothing'} is not points and width")
        points = [_place(f"{name}[{i}].points[{k}]", point, pressure=True) for k, point in enumerate(stroke["points"])]
        given.append(engine.Stroke(points, stroke.get("width", 10.0)))
    return given


def _place(name: str, point: Sequence[float], *, pressure: bool = False) -> list[float]:
    """[x, y], or with `pressure` [x, y, pressure], 1 where none is given."""
    numbers = [float(number) for number in point]
    if len(numbers) != 2 and not (pressure and len(numbers) == 3):
        raise engine.BadInput(f"{name}: {len(numbers)} numbers are not x, y{' or x, y, pressure' if pressure else ''}")
    return [*numbers, 1.0][:3] if pressure else numbers


def _method(name: str):
    if name not in METHODS:
        raise engine.BadInput(f"method: {name!r} is not one of {', '.join(METHODS)}")
    return METHODS[name]
