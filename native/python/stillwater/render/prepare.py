"""The files of a recipe, read and checked."""

import os
from collections.abc import Callable, Generator, Iterator
from dataclasses import dataclass, field

import numpy as np

from .. import _stillwater as engine
from ..recipe import Document, Recipe, RecipeError
from ..recipe.fluids import Example
from ..recipe.mattes import ExemplarFill, FileFill, Matte
from ..recipe.picture import Layer
from ..recipe.stochastic import Ripple
from .cache import Cache
from .events import Preparing
from .fills import exemplar
from .keys import layer_keys, stack_key
from .mattes import Given, MatteReader, ToSolve

LARGEST_SIDE = 16384


@dataclass
class Images:
    """What the files hold: picture H x W x 4 premultiplied; of each layer its matte (None: all that is left), and its fill
    (engine.Fill, Exemplar, or a painted H x W x 4)."""

    picture: np.ndarray
    has_alpha: bool
    mattes: list = field(default_factory=list)
    fills: list = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


class Sources:
    """The files of a recipe: there, and known by what they hold. Throws RecipeError where one is not."""

    def __init__(self, document: Document, cache: Cache):
        self.document, self.recipe = document, document.recipe
        self.digests = digests_of(document, cache.digest)
        self.layer_keys = layer_keys(self.recipe, self.digests)
        self.key = stack_key(self.recipe, self.digests)
        self.size = self._size()

    def _size(self) -> tuple[int, int]:
        """Of the picture, from its header."""
        path = self.document.locate(self.recipe.picture)
        try:
            facts = engine.inspect_picture(str(path))
        except (engine.BadInput, engine.FileError) as error:
            raise RecipeError(f"picture: {error}") from None
        width, height = facts.width, facts.height
        wanted = self.recipe.size
        if wanted is not None and wanted != (width, height):
            raise RecipeError(f"size: {list(wanted)} is not the size of the picture, {width} x {height}")
        return width, height

    def read(self) -> Generator[Preparing, None, Images]:
        """Reads every file and checks them against each other. Throws RecipeError with all that is wrong."""
        yield Preparing(0, "reading the picture")
        picture, said = self._picture("picture", self.recipe.picture)
        images = Images(picture.image, picture.has_alpha, warnings=said)
        problems, reader = [], MatteReader(self.document, images.picture)
        for i, layer in enumerate(self.recipe.layers):
            yield Preparing(round(0.1 + 0.3 * i / len(self.recipe.layers), 3), f"reading {layer.name}")
            for read, kept in ((self._matte, images.mattes), (self._fill, images.fills)):
                try:
                    kept.append(read(i, layer, images, reader))
                except RecipeError as error:
                    problems += error.problems
        if problems:
            raise RecipeError(*problems)
        return images

    def picture(self) -> np.ndarray:
        """The picture alone, H x W x 4. Throws RecipeError."""
        return self._picture("picture", self.recipe.picture)[0].image

    @staticmethod
    def _matte(i: int, layer: Layer, images: Images, reader: MatteReader) -> Given | ToSolve | None:
        if layer.matte is None:
            return None
        matte = reader.read(f"layers[{i}].matte", layer.matte)
        if not min(matte.bound.box[2:]):
            images.warnings.append(f"layers[{i}].matte: covers no pixel; the layer is not seen")
        return matte

    def _fill(self, i: int, layer: Layer, images: Images, reader: MatteReader):
        if i + 1 == len(self.recipe.layers):
            return engine.Fill.none  # nothing lies behind the last layer
        match layer.fill:
            case ExemplarFill():
                return exemplar(f"layers[{i}].fill", layer.fill, reader)
            case FileFill(file=name):
                painted, said = self._picture(f"layers[{i}].fill.file", name)
                images.warnings += said
                reader.check_size(f"layers[{i}].fill.file: {name}", painted.image)
                return painted.image
        return engine.Fill.none

    def _picture(self, place: str, name: str):
        """A picture, and what is odd about it."""
        space = engine.colour_space_named(self.recipe.colour_space)
        picture = _read(place, engine.read_picture, str(self.document.locate(name)), space)
        if not picture.bad_pixels:
            return picture, []
        many = "1 pixel is not a finite number and counts" if picture.bad_pixels == 1 else (
            f"{picture.bad_pixels} pixels are not finite numbers and count"
        )  # fmt: skip
        return picture, [f"{place}: {many} as 0"]


def digests_of(document: Document, find: Callable) -> dict:
    """What `find` (Cache.digest, Cache.known) answers for each file of a recipe, by the name the recipe has for it.

    Throws RecipeError with every file that can't be read.
    """
    problems, digests = [], {}
    for place, name in _files(document.recipe):
        try:
            digests[name] = find(document.locate(name))
        except OSError as error:
            problems.append(f"{place}: {document.locate(name)}: {_why(error)}")
    if problems:
        raise RecipeError(*problems)
    return digests


def check_view(recipe: Recipe, boxes: list) -> None:
    """Throws RecipeError for a water layer that lies wholly above the horizon. `boxes`: x, y, width, height a layer."""
    view = engine.View(horizon=recipe.view.horizon, fov=recipe.view.fov, height=recipe.view.height)
    problems = []
    for i, (layer, box) in enumerate(zip(recipe.layers, boxes, strict=True)):
        if isinstance(layer.motion, Ripple) and min(box[2:]) > 0 and not view.any_water(tuple(box)):
            line = [list(end) for end in recipe.view.horizon]
            problems.append(
                f"view.horizon: {line} is not above any part of layers[{i}], a ripple (water lies below the horizon)"
            )
    if problems:
        raise RecipeError(*problems)


def boxes_of(images: Images) -> list[tuple[int, int, int, int]]:
    """Where each matte may be above 0: x, y, width, height."""
    height, width = images.picture.shape[:2]
    return [(0, 0, width, height) if matte is None else tuple(matte.bound.box) for matte in images.mattes]


def _files(recipe: Recipe) -> Iterator[tuple[str, str]]:
    """Every file that the recipe names, with its place."""
    yield "picture", recipe.picture
    for i, layer in enumerate(recipe.layers):
        if isinstance(layer.motion, Example):
            yield f"layers[{i}].motion.clip", layer.motion.clip
        yield from _matte_file(f"layers[{i}].matte", layer.matte)
        if i + 1 == len(recipe.layers):
            return
        if isinstance(layer.fill, FileFill):
            yield f"layers[{i}].fill.file", layer.fill.file
        if isinstance(layer.fill, ExemplarFill):
            yield from _matte_file(f"layers[{i}].fill.source", layer.fill.source)


def _matte_file(place: str, matte: Matte | None) -> Iterator[tuple[str, str]]:
    for field in ("file", "labels", "trimap"):
        if hasattr(matte, field):
            yield f"{place}.{field}", getattr(matte, field)


def _why(error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such file"
    if isinstance(error, IsADirectoryError):
        return "is a folder, not a file"
    return os.strerror(error.errno) if error.errno else str(error)


def _read(place: str, function, *arguments):
    try:
        return function(*arguments)
    except (engine.BadInput, engine.FileError) as error:
        raise RecipeError(f"{place}: {error}") from None

