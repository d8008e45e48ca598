"""Live frames of a picture of noise, most of which flows: what a player shows, all in memory.

The reference is the time that a frame has: 60 frames a second at 960 x 540, 24 at 1920 x 1080.
"""

from __future__ import annotations

import numpy as np
from bench import Row, medians
from stillwater import _stillwater as engine

PERIOD = 60
COVERED = 0.9  # of the picture's width and height


def rows():
    for width, height, rate in ((960, 540, 60), (1920, 1080, 24)):
        (seconds,) = medians(player(width, height), runs=25)
        yield Row(f"flow, a live frame, {width}x{height}", seconds * 1e3, 1e3 / rate, 1.0)


def swirls(width: int, height: int) -> np.ndarray:
    """Four whirls over a current, some 2 px a frame at 960 px."""
    y, x = np.mgrid[:height, :width].astype(np.float32) / np.float32(height)
    u, v = 1.2 + np.sin(3 * y + x), np.cos(3 * x - y)
    return np.ascontiguousarray(np.stack([u, v], axis=-1) * (width / 960), np.float32)


def player(width: int, height: int):
    """A function that shows the next frame."""
    engine.set_threads(0)
    rng = np.random.default_rng(1)
    picture = rng.random((height, width, 4), np.float32)
    picture[..., 3] = 1
    matte = np.zeros((height, width), np.float32)
    top, left = round(height * (1 - COVERED) / 2), round(width * (1 - COVERED) / 2)
    matte[top : height - top, left : width - left] = 1
    fluid, back = engine.peel(picture, [matte, None], [engine.Fill.none] * 2, [0.0] * 2)
    x, y, wide, high = fluid.box
    field = np.ascontiguousarray(swirls(width, height)[y : y + high, x : x + wide])
    plates = engine.make_plates(fluid, None, (width, height), 1.0, None, [], [field], PERIOD / 2)
    still = engine.make_plates(back, None, (width, height), 1.0, None)
    layers = [engine.Layer(plates, engine.Flow()), engine.Layer(still)]
    renderer = engine.FrameRenderer((width, height), 1.0, engine.View(), engine.Wind(), layers)
    shown, frame = np.zeros((height, width, 4), np.float32), 0

    def next_frame():
        nonlocal frame
        frame += 1
        flow = engine.Flow(cycle=frame % PERIOD / PERIOD, ways=[-PERIOD / 2, PERIOD / 2], step=1)
        renderer.render_for_screen(shown, engine.Moment(), [engine.LayerState(1.0, flow), engine.LayerState()])

    return next_frame
