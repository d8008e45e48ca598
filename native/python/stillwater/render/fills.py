"""How holes are filled: what a recipe says, its files read, made ready for the engine."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .. import _stillwater as engine
from ..recipe import RecipeError
from ..recipe.mattes import ExemplarFill
from .mattes import Given, MatteReader, Progress, ToSolve, whole


@dataclass(frozen=True)
class Exemplar:
    """A filling from patches."""

    fill: ExemplarFill
    source: Given | ToSolve | None
    regions: list[np.ndarray]  # of its touch-ups, H x W
    size: tuple[int, int]  # width and height of the picture

    def on(self, left: Callable[[], np.ndarray], progress: Progress):
        """For the engine, on what is left of the picture (gives H x W x 4). Throws RecipeError."""
        source = None if self.source is None else whole(self.source.on(left, progress), self.size)
        fill, places = self.fill, zip(self.regions, self.fill.touch_up, strict=True)
        return engine.ExemplarFill(
            patch=fill.patch,
            radius=fill.radius,
            grow=math.ceil(fill.grow),
            source=source,
            touch_ups=[engine.TouchUp(region, place.radius, place.seed) for region, place in places],
        )


def exemplar(place: str, fill: ExemplarFill, reader: MatteReader) -> Exemplar:
    """Reads what a filling names. Throws RecipeError with all that is wrong."""
    problems, regions, source = [], [], None
    try:
        source = None if fill.source is None else reader.read(f"{place}.source", fill.source)
    except RecipeError as error:
        problems += error.problems
    for i, touch_up in enumerate(fill.touch_up):
        try:
            regions.append(reader.region(f"{place}.touch_up[{i}].stroke", touch_up.stroke))
        except RecipeError as error:
            problems += error.problems
    if problems:
        raise RecipeError(*problems)
    return Exemplar(fill, source, regions, reader.size)
