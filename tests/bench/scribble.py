"""A scribble on a 1280 x 720 picture in Blender, from lifting the pen to the matte over the picture."""

from __future__ import annotations

from bench import Row
from blender import inside


def rows():
    measured = inside("scribble")
    yield Row("in Blender, a scribble 1280x720 until its matte is seen", measured["sketch"] * 1e3, 500, 1.0, "ms")
    yield Row("... and the layers are cut out by it", measured["final"] * 1e3, 2000, 1.0, "ms")
