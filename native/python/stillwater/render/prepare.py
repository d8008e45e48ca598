"""The files of a recipe, read and checked."""

import os
from collections.abc import Callable, Generator, Iterator
from dataclasses import dataclass, field

import numpy as np

from .. import _stillwater as engine
from ..recipe import Document, Recipe, RecipeError
from ..recipe.mattes import ExemplarFill, FileFill, FileMatte, LabelMatte
from ..recipe.stochastic import Ripple
from .cache import Cache
from .events import Preparing
from .keys import layer_keys, stack_key

LARGEST_SIDE = 16384


@dataclass
class Images:
    """What the files hold: picture H x W x 4 premultiplied, mattes (engine.MatteInBox or None) and fills for peel()."""

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
        problems, labels = [], {}
        for i, layer in enumerate(self.recipe.layers):
            yield Preparing(round(0.1 + 0.3 * i / len(self.recipe.layers), 3), f"reading {layer.name}")
            for read, kept in ((self._matte, images.mattes), (self._fill, images.fills)):
                try:
                    kept.append(read(i, layer, images, labels))
                except RecipeError as error:
                    problems += error.problems
        if problems:
            raise RecipeError(*problems)
        return images

    def _path(self, name: str):
        return self.document.locate(name)

    def _matte(self, i, layer, images: Images, labels: dict):
        place = f"layers[{i}].matte"
        match layer.matte:
            case FileMatte(file=name, channel=channel):
                place += ".file"
                matte = _read(place, engine.read_matte, str(self._path(name)), channel)
            case LabelMatte(labels=name, value=value):
                place += ".labels"
                if name not in labels:
                    labels[name] = _read(place, engine.read_labels, str(self._path(name)))
                matte = (labels[name] == value).astype(np.float32)
            case None:
                return None
        self._check_size(f"{place}: {layer.matte.file if isinstance(layer.matte, FileMatte) else layer.matte.labels}", matte, images)
        x, y, width, height = box = _box(matte)
        if not width:
            images.warnings.append(f"layers[{i}].matte: covers no pixel; the layer is not seen")
        return engine.MatteInBox(matte[y : y + height, x : x + width].copy(), box)

    def _fill(self, i, layer, images: Images, _labels):
        if i + 1 == len(self.recipe.layers):
            return engine.Fill.none  # nothing lies behind the last layer
        if isinstance(layer.fill, ExemplarFill):
            return engine.Fill.push_pull
        if not isinstance(layer.fill, FileFill):
            return engine.Fill.none
        place = f"layers[{i}].fill.file"
        painted, said = self._picture(place, layer.fill.file)
        images.warnings += said
        self._check_size(f"{place}: {layer.fill.file}", painted.image, images)
        return painted.image

    def _picture(self, place: str, name: str):
        """A picture, and what is odd about it."""
        space = engine.colour_space_named(self.recipe.colour_space)
        picture = _read(place, engine.read_picture, str(self._path(name)), space)
        if not picture.bad_pixels:
            return picture, []
        many = "1 pixel is not a finite number and counts" if picture.bad_pixels == 1 else (
            f"{picture.bad_pixels} pixels are not finite numbers and count"
        )  # fmt: skip
        return picture, [f"{place}: {many} as 0"]

    def _check_size(self, place: str, image: np.ndarray, images: Images) -> None:
        (height, width), (full_height, full_width) = image.shape[:2], images.picture.shape[:2]
        if (height, width) != (full_height, full_width):
            raise RecipeError(f"{place}: {width} x {height} is not the size of the picture, {full_width} x {full_height}")


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


def filled_otherwise(recipe: Recipe) -> Iterator[str]:
    """A warning where the recipe asks for a filling that has no engine yet."""
    places = [f"layers[{i}].fill" for i, layer in enumerate(recipe.layers[:-1]) if isinstance(layer.fill, ExemplarFill)]
    if places:
        yield f"{', '.join(places)}: exemplar filling has no engine yet; filled by a smooth push-pull"


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
    """Where each matte is above 0: x, y, width, height."""
    height, width = images.picture.shape[:2]
    return [(0, 0, width, height) if matte is None else tuple(matte.box) for matte in images.mattes]


def _box(matte: np.ndarray) -> tuple[int, int, int, int]:
    rows, columns = np.flatnonzero(matte.any(axis=1)), np.flatnonzero(matte.any(axis=0))
    if not rows.size:
        return 0, 0, 0, 0
    return int(columns[0]), int(rows[0]), int(columns[-1] - columns[0] + 1), int(rows[-1] - rows[0] + 1)


def _files(recipe: Recipe) -> Iterator[tuple[str, str]]:
    """Every file that the recipe names, with its place."""
    yield "picture", recipe.picture
    for i, layer in enumerate(recipe.layers):
        if isinstance(layer.matte, FileMatte):
            yield f"layers[{i}].matte.file", layer.matte.file
        if isinstance(layer.matte, LabelMatte):
            yield f"layers[{i}].matte.labels", layer.matte.labels
        if isinstance(layer.fill, FileFill) and i + 1 < len(recipe.layers):
            yield f"layers[{i}].fill.file", layer.fill.file


def _why(error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        return "there is no such file"
    if isinstance(error, IsADirectoryError):
        return "is a folder, not an image"
    return os.strerror(error.errno) if error.errno else str(error)


def _read(place: str, function, *arguments):
    try:
        return function(*arguments)
    except (engine.BadInput, engine.FileError) as error:
        raise RecipeError(f"{place}: {error}") from None

