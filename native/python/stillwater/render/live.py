"""Frames for a screen, in the process that shows them (a player, Blender's viewport).

Works with what is prepared already, and prepares nothing itself: `stillwater serve` does.
"""

import os
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .. import _stillwater as engine
from ..recipe import parse
from . import preview
from .cache import FOLDER, Cache, Prepared
from .prepare import check_view, digests_of
from .filming import Pace
from .ready import Canvas, Way, keys_of, pace_of, ways_of
from .moments import numbers
from .renderer import frame_renderer
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
        self._plates: dict[Way, tuple[engine.LayerPlates, Pace | None]] = {}
        self._paces: list[Pace | None] = []
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
        key = preview.key_of(document, self._cache, longest)
        if key is None:
            return False
        same = key == self._key
        layers = self._preview if same else self._cache.find(key)
        if layers is None:
            return False
        small = preview.reduced(document.recipe, layers.facts["scale"])
        check_view(small, layers.facts["colour"])
        timeline = Timeline(small)
        ways = ways_of(timeline, digests_of(document, self._cache.known), layers.facts["colour"])
        plates = self._plates_for(key, layers, ways, timeline, self._plates if same else {})
        if plates is None:
            return False
        size, has_alpha = tuple(layers.facts["size"]), layers.facts["has_alpha"]
        paces = [plates[way][1] for way in ways]
        self._renderer = frame_renderer(timeline, [plates[way][0] for way in ways], size, 1.0, paces, has_alpha=has_alpha)
        self._paces = paces
        self._key, self._preview, self._plates, self._timeline = key, layers, plates, timeline
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
            float32, height x width x 4: scene-linear, premultiplied, the bottom row first, as Blender keeps pictures;
            within 1/40 of a level of 256 of what a bake gives. The next call writes over it.

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

    def quick_matte(self, key: str) -> NDArray[np.uint8] | None:
        """The matte that `serve` answered with this key, picture height x width, 0 .. 255, top row first; None where the
        cache has it no more."""
        kept = self._cache.find(key) if self._cache else None
        return None if kept is None else kept.arrays["matte"]

    def _numbers(self, frame: int) -> tuple:
        if self._timeline is None:
            raise engine.BadInput("live: no recipe was taken yet")
        return numbers(self._timeline, frame, self._paces)

    def _index(self, layer: str) -> int:
        if layer not in self.layers:
            raise engine.BadInput(f'layer: "{layer}" is not one of {", ".join(self.layers) or "none"}')
        return self.layers.index(layer)

    def _plates_for(self, key: str, layers: Prepared, ways: list[Way], timeline: Timeline, made: dict) -> dict | None:
        """Plates and pace for each way, those that are there already taken over; None where a part is not prepared."""
        missing = [way for way in ways if way not in made]
        ready = {way: [self._cache.find(each) for each in keys_of(key, way)] for way in missing}
        if any(None in found for found in ready.values()):
            return None
        canvas = Canvas(key, layers, tuple(layers.facts["size"]))
        new = {way: (canvas.plates(way, ready[way], timeline), pace_of(timeline, way, ready[way])) for way in missing}
        return {way: made.get(way) or new[way] for way in ways}
