"""The mattes of a recipe: read from files, or solved on what is left of the picture."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .. import _stillwater as engine
from ..recipe import Document, RecipeError
from ..recipe.mattes import FileMatte, LabelMatte, LassoMatte, Matte, ScribbleMatte, TrimapMatte
from ..recipe.strokes import Stroke

Progress = Callable[[str, float], bool]

METHODS = {"closed-form": engine.MattingMethod.closed_form, "bayesian": engine.MattingMethod.bayesian}


@dataclass(frozen=True)
class Given:
    """A matte that a file says."""

    matte: object  # engine.MatteInBox

    @property
    def bound(self):
        return self.matte

    def on(self, left: Callable[[], np.ndarray], progress: Progress):
        return self.matte


@dataclass(frozen=True)
class ToSolve:
    """A matte that is solved when its layer's turn comes. `bound`: an engine.MatteInBox that it does not reach beyond."""

    place: str
    trimap: Callable[[np.ndarray], np.ndarray]  # of the picture, H x W x 4
    method: str
    bound: object
    unknown: int  # pixels

    def on(self, left: Callable[[], np.ndarray], progress: Progress, finest: int = 1):
        """On what is left of the picture (gives H x W x 4): an engine.MatteInBox. Throws RecipeError.

        `finest`: 1, or 2, 4, 8: solved on a picture so many times smaller, and enlarged.
        """
        options = engine.MatteOptions()
        options.method = METHODS[self.method]
        options.finest = finest
        try:
            picture = left()
            return in_box(engine.matte(picture, self.trimap(picture), options, progress))
        except (engine.BadInput, engine.NotConverged) as error:
            raise RecipeError(f"{self.place}.{error}") from None


class MatteReader:
    """Reads the mattes of a recipe. `picture`: H x W x 4. Throws RecipeError where something does not fit."""

    def __init__(self, document: Document, picture: np.ndarray):
        self._document, self._picture = document, picture
        self._labels: dict[str, np.ndarray] = {}

    def read(self, place: str, form: Matte) -> Given | ToSolve:
        """One matte; `place` stands in sentences."""
        match form:
            case FileMatte(file=name, channel=channel):
                return Given(in_box(self._image(f"{place}.file", name, engine.read_matte, channel)))
            case LabelMatte(labels=name, value=value):
                if name not in self._labels:
                    self._labels[name] = self._image(f"{place}.labels", name, engine.read_labels)
                return Given(in_box((self._labels[name] == value).astype(np.float32)))
            case TrimapMatte(trimap=name, method=method):
                grey = self._image(f"{place}.trimap", name, engine.read_matte, "Y")
                return self._to_solve(place, lambda picture: engine.trimap_from_grey(grey), method)
            case ScribbleMatte(scribbles=scribbles, method=method):
                strokes = {kind: list(map(stroke, getattr(scribbles, kind))) for kind in ("foreground", "background")}
                return self._to_solve(place, lambda picture: engine.trimap_from_scribbles(size_of(picture), **strokes), method)
            case LassoMatte(lasso=outline, feather=feather, snap=snap, method=method):
                return self._to_solve(
                    place, lambda picture: engine.trimap_from_lasso(picture, outline, feather, snap), method
                )
        raise AssertionError(form)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture."""
        return size_of(self._picture)

    def region(self, place: str, drawn: Stroke) -> np.ndarray:
        """What a stroke covers, H x W, 0 or 1."""
        try:
            return engine.drawn(size_of(self._picture), stroke(drawn), place)
        except engine.BadInput as error:
            raise RecipeError(str(error)) from None

    def check_size(self, place: str, image: np.ndarray) -> None:
        """Throws RecipeError for an image that is not of the picture's size."""
        (width, height), (full_width, full_height) = size_of(image), size_of(self._picture)
        if (width, height) != (full_width, full_height):
            raise RecipeError(f"{place}: {width} x {height} is not the size of the picture, {full_width} x {full_height}")

    def _image(self, place: str, name: str, read: Callable, *arguments) -> np.ndarray:
        try:
            image = read(str(self._document.locate(name)), *arguments)
        except (engine.BadInput, engine.FileError) as error:
            raise RecipeError(f"{place}: {error}") from None
        self.check_size(f"{place}: {name}", image)
        return image

    def _to_solve(self, place: str, trimap: Callable, method: str) -> ToSolve:
        try:
            known = trimap(self._picture)
        except engine.BadInput as error:
            raise RecipeError(f"{place}.{error}") from None
        if not (known == 1).any() or not (known == 0).any():
            missing = "foreground" if not (known == 1).any() else "background"
            raise RecipeError(f"{place}: no pixel of its trimap is {missing} (some must be)")
        return ToSolve(place, trimap, method, in_box((known > 0).astype(np.float32)), int((known == 0.5).sum()))


def in_box(matte: np.ndarray):
    """An engine.MatteInBox of a whole matte, H x W."""
    rows, columns = np.flatnonzero(matte.any(axis=1)), np.flatnonzero(matte.any(axis=0))
    if not rows.size:
        return engine.MatteInBox(np.zeros((0, 0), np.float32), (0, 0, 0, 0))
    top, bottom, left, right = int(rows[0]), int(rows[-1]) + 1, int(columns[0]), int(columns[-1]) + 1
    return engine.MatteInBox(matte[top:bottom, left:right].copy(), (left, top, right - left, bottom - top))


def whole(matte, size: tuple[int, int]) -> np.ndarray:
    """A matte in a box as H x W; `size`: width, height."""
    x, y, width, height = matte.box
    plane = np.zeros(size[::-1], np.float32)
    plane[y : y + height, x : x + width] = matte.pixels
    return plane


def stroke(drawn: Stroke):
    """As the engine wants it."""
    return engine.Stroke([[*point, 1.0][:3] for point in drawn.points], drawn.width)


def size_of(image: np.ndarray) -> tuple[int, int]:
    return image.shape[1], image.shape[0]
