"""Frames for a screen, in the process that shows them (a player, Blender's viewport).

Works with what is prepared already, and prepares nothing itself: `stillwater serve` does.
"""

import os
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .. import _stillwater as engine
from ..recipe import Document, parse
from ..recipe.stochastic import Drift
from . import preview
from .cache import FOLDER, Cache, Prepared
from .prepare import check_view, layer_images
from .renderer import frame_renderer, numbers
from .resolve import Timeline


class Live:
    """One picture as its recipe has it now.

        live = Live()
        if live.take(recipe, folder, longest=960):
            pixels = live.frame(12)

    Source: DESIGN.md, "How a frame is made".
    """

    def __init__(self) -> None:
        self._cache: Cache | None = None
        self._learnt: dict[str, list] = {}
        self._key = ""
        self._preview: Prepared | None = None
        self._plates: dict[tuple, engine.LayerPlates] = {}
        self._timeline: Timeline | None = None
        self._renderer: engine.FrameRenderer | None = None
        self._pixels = np.zeros((0, 0, 4), np.float32)

    def learn(self, files: Mapping[str, list]) -> None:
        """Takes the `files` of a "done" from `serve`, so that they need not be read here."""
        self._learnt |= files
        if self._cache:
            self._cache.learn(self._learnt)

    def take(
        self,
        recipe: Mapping,
        folder: str | os.PathLike[str],
        longest: int = 960,
        cache: str | os.PathLike[str] | None = None,
    ) -> bool:
        """Takes a recipe, a new one or one that has changed. Frames are those of the picture made small.

        Args:
            recipe: as JSON has it.
            folder: where its relative paths start.
            longest: of the frames' sides, pixels; a smaller picture keeps its size.
            cache: folder of the cache, the one that `serve` and bakes have; None = in `folder`.

        Returns:
            True where frames can be had: changed numbers cost a rebuild of the motions. False where something must
            be prepared first (a matte, the picture, another size); frames are then those of the recipe before.

        Raises:
            RecipeError: with all that is wrong; frames are those of the recipe before.
        """
        document = parse(recipe, folder)
        place = Path(cache) if cache else Path(folder) / FOLDER
        if self._cache is None or self._cache.folder != place:
            self._cache = Cache(place)
            self._cache.learn(self._learnt)
        found = preview.find(document, self._cache, longest)
        if found is None:
            return False
        key, layers = found
        small = Document(preview.reduced(document.recipe, layers.facts["scale"]), document.folder)
        check_view(small.recipe, layers.facts["colour"])
        if key != self._key:
            self._key, self._preview, self._plates = key, layers, {}
        self._build(small)
        return True

    @property
    def ready(self) -> bool:
        """Whether there are frames at all."""
        return self._renderer is not None

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of a frame, pixels; (0, 0) before there are any."""
        return self._renderer.size if self._renderer else (0, 0)

    @property
    def layers(self) -> list[str]:
        """The names of the layers that there are frames of, front first."""
        return [layer.name for layer in self._timeline.recipe.layers] if self._timeline else []

    @property
    def scale(self) -> float:
        """Pixels of a frame for a pixel of the picture; 1 before there are frames."""
        return self._preview.facts["scale"] if self._preview else 1.0

    def frame(self, frame: int, layer: str | None = None, matte: bool = False) -> NDArray[np.float32]:
        """One frame, in any order.

        Args:
            frame: any, also outside of the recipe's range.
            layer: name of one that is shown alone, over nothing; None = all of them.
            matte: how much of each pixel is covered, as grey, instead of the colours.

        Returns:
            float32, height x width x 4: scene-linear, premultiplied, the bottom row first, as Blender keeps pictures.
            The next call writes over it.

        Raises:
            ValueError: no recipe was taken yet, or it has no such layer.
        """
        index = -1 if layer is None else self._index(layer)
        moment, states = self._numbers(frame)
        width, height = self.size
        if self._pixels.shape[:2] != (height, width):
            self._pixels = np.zeros((height, width, 4), np.float32)
        self._renderer.render_for_screen(self._pixels, moment, states, layer=index, coverage=matte)
        return self._pixels

    def moved(self, frame: int, layer: str, points: list[tuple[float, float]]) -> list[tuple[float, float]]:
        """Where points of the still picture, as part of a layer, are at a frame; picture pixels.

        Raises ValueError where no recipe was taken yet, or it has no such layer.
        """
        moment, states = self._numbers(frame)
        scale = self.scale
        small = [(x * scale, y * scale) for x, y in points]
        moved = self._renderer.moved(self._index(layer), moment, states, small)
        return [(x / scale, y / scale) for x, y in moved]

    def gust(self, frame: int, points: list[tuple[float, float]]) -> list[tuple[float, float, float]]:
        """The wind at points of the picture (pixels) at a frame.

        Returns (right, away, factor) for each: the unit vector of its heading over the ground, and how many times the
        mean speed it has there, never negative. Raises ValueError where no recipe was taken yet.
        """
        moment, _ = self._numbers(frame)
        wind = moment.wind
        field = engine.GustField(wind.gust_size, wind.seed, self.size)
        angle, scale = np.radians(wind.direction), self.scale
        right, away = float(np.cos(angle)), float(np.sin(angle))
        return [(right, away, field.factor((x * scale, y * scale), moment)) for x, y in points]

    def coverage(self, layer: str) -> NDArray[np.float32]:
        """How much of each pixel of the still picture a layer covers.

        Returns float32, height x width at the frames' scale, top row first. Raises ValueError where no recipe was
        taken yet, or it has no such layer.
        """
        index = self._index(layer)
        width, height = self.size
        whole = np.zeros((height, width), np.float32)
        part = self._preview.arrays.get(f"colour{index}")
        if part is not None:
            x, y, wide, high = self._preview.facts["colour"][index]
            whole[y : y + high, x : x + wide] = part[..., 3]
        return whole

    def _numbers(self, frame: int) -> tuple:
        if self._timeline is None:
            raise engine.BadInput("live: no recipe was taken yet")
        return numbers(self._timeline, frame)

    def _index(self, layer: str) -> int:
        if layer not in self.layers:
            raise engine.BadInput(f'layer: "{layer}" is not one of {", ".join(self.layers) or "none"}')
        return self.layers.index(layer)

    def _build(self, document: Document) -> None:
        timeline = Timeline(document.recipe)
        facts = self._preview.facts
        size, has_alpha = tuple(facts["size"]), facts["has_alpha"]
        colour = layer_images(self._preview, "colour")
        alpha = layer_images(self._preview, "alpha") if has_alpha else [None] * len(colour)
        wanted = [(i, axes if drifts(document, i) else None) for i, axes in enumerate(timeline.endless)]
        self._plates = {
            way: self._plates.get(way) or engine.make_plates(colour[way[0]], alpha[way[0]], size, 1.0, way[1])
            for way in wanted
        }
        plates = [self._plates[way] for way in wanted]
        self._renderer = frame_renderer(timeline, plates, size, 1.0, has_alpha=has_alpha)
        self._timeline = timeline


def drifts(document: Document, index: int) -> bool:
    """Whether a layer drifts, or follows one that does."""
    layers = document.recipe.layers
    layer = layers[index]
    if isinstance(layer.motion, Drift):
        return True
    return layer.follows is not None and drifts(document, [each.name for each in layers].index(layer.follows.layer))
