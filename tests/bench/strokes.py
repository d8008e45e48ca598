"""A stroke of 10,000 points, from Blender's drawing to what the recipe holds."""

from __future__ import annotations

from bench import Row
from blender import inside

LIMIT = 20.0  # ms
TYPES = {"POLY": "as drawn", "CATMULL_ROM": "Catmull-Rom", "BEZIER": "Bezier"}


def rows():
    measured = inside("strokes")
    for kind, name in TYPES.items():
        yield Row(f"10,000 points read and converted, {name}", measured[kind], LIMIT, 1.0)
