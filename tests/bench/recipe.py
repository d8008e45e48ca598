"""The recipe of 30 layers, each with a number that is keyed, over 1,000 frames."""

from __future__ import annotations

from bench import Row
from blender import inside

LIMIT = 50.0  # ms


def rows():
    yield Row("recipe of 30 layers with an F-curve each, 1,000 frames", inside("recipe")["recipe"], LIMIT, 1.0)
