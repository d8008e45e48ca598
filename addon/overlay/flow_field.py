"""A layer's flow at the size of a sketch, in colours, and as lines to draw. Knows nothing of Blender.

Fields are height x width x 2, px/frame, x to the right and y down, as the engine's.
"""

from math import ceil

import numpy as np

from ..recipe.flow import holding

LARGEST = 400  # px: the longer side of a sketch
SATURATED = 0.9  # of the fastest: full colours from here on
WHEEL = 96  # px: side of the legend
SPACING = 0.11  # of the picture's longer side, between lines that are proposed
REACH = 0.45  # of it: how long one may be
LONG_ENOUGH = 0.06
STEP = 2.0  # px of a sketch, along a line
STILL = 0.05  # of the fastest: what is slower has no line
MOST_LINES = 30


def small(picture: np.ndarray) -> tuple[np.ndarray, float]:
    """A picture at the size of a sketch, and how many of its pixels there are for one of the picture: whole pixels are
    averaged."""
    height, width = picture.shape[:2]
    step = max(1, ceil(max(height, width) / LARGEST))
    rows, columns = height // step * step, width // step * step
    if not rows or not columns:
        return np.ascontiguousarray(picture, np.float32), 1.0
    blocks = picture[:rows, :columns].reshape(rows // step, step, columns // step, step, picture.shape[2])
    return np.ascontiguousarray(blocks.mean(axis=(1, 3), dtype=np.float32)), 1 / step


def bound_of(coverage: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """A matte of any size at the size of a sketch."""
    rows = (np.arange(shape[0]) + 0.5) * coverage.shape[0] / shape[0]
    columns = (np.arange(shape[1]) + 0.5) * coverage.shape[1] / shape[1]
    return np.ascontiguousarray(coverage[rows.astype(int)][:, columns.astype(int)], np.float32)


def reduced(motion: dict, scale: float, frame: int) -> dict:
    """What of a recipe's flow says its field at a frame, for a picture of so many pixels for one of its own."""
    strokes = [_reduced(stroke, scale) for stroke in holding(motion["strokes"], frame)]
    for stroke in strokes:
        stroke["speed"] *= scale
    return {
        "strokes": strokes,
        "freeze": [_reduced(stroke, scale) for stroke in motion.get("freeze", ())],
        "refine": {"width": motion["refine"]["width"] * scale, "amount": motion["refine"]["amount"]},
    }


def _reduced(stroke: dict, scale: float) -> dict:
    points = [[point[0] * scale, point[1] * scale, *point[2:]] for point in stroke["points"]]
    kept = {name: value for name, value in stroke.items() if name != "frame"}
    return {**kept, "points": points, "width": stroke["width"] * scale}


def colours(flow: np.ndarray, opacity: float) -> np.ndarray:
    """The flow as colours, height x width x 4, straight alpha: the hue is its direction, the rest its speed."""
    speed = np.hypot(flow[..., 0], flow[..., 1])
    fastest = float(speed.max()) or 1.0
    made = np.empty((*speed.shape, 4), np.float32)
    made[..., :3] = _hue(np.arctan2(flow[..., 1], flow[..., 0]) / (2 * np.pi))
    made[..., 3] = opacity * np.minimum(speed / (SATURATED * fastest), 1)
    return made


def wheel() -> np.ndarray:
    """The legend: which colour flows where, on a round, height x width x 4."""
    y, x = np.mgrid[:WHEEL, :WHEEL] + 0.5 - WHEEL / 2
    radius = np.hypot(x, y)
    made = colours(np.stack([x, y], axis=-1).astype(np.float32), 1.0)
    made[..., 3] *= np.clip(WHEEL / 2 - radius, 0, 1)
    return made


def _hue(turn: np.ndarray) -> np.ndarray:
    """Red flows to the right, and on through yellow, green and blue clockwise."""
    return np.clip(np.abs((turn[..., None] * 6 + np.array([0, 4, 2])) % 6 - 3) - 1, 0, 1).astype(np.float32)


def lines_of(flow: np.ndarray, inside: np.ndarray | None = None) -> list[tuple[np.ndarray, float]]:
    """Lines along a flow that are about evenly apart, (n, 2) each, with the speed on it: what an artist would draw.

    `inside`: height x width, 0 .. 1: where they may lie.
    """
    height, width = flow.shape[:2]
    speed = np.hypot(flow[..., 0], flow[..., 1])
    free = speed > STILL * float(speed.max())
    if inside is not None:
        free &= inside > 0.5
    apart, found = max(4.0, SPACING * max(height, width)), []
    taken = ~free
    rows, columns = (np.arange(apart / 2, side, apart) for side in (height, width))
    for x, y in [(x, y) for y in rows for x in columns]:
        if taken[int(y), int(x)]:
            continue
        line = np.concatenate([_along(flow, taken, (x, y), -1)[:0:-1], _along(flow, taken, (x, y), 1)])
        length = np.linalg.norm(np.diff(line, axis=0), axis=1).sum()
        if length < LONG_ENOUGH * max(height, width):
            continue
        found.append((length, line[:: max(1, len(line) // 24)]))
        _take(taken, line, 0.7 * apart)
    found.sort(key=lambda each: -each[0])
    return [(line, float(np.median(speed[tuple(line.astype(int).T[::-1])]))) for _, line in found[:MOST_LINES]]


def _along(flow: np.ndarray, taken: np.ndarray, place: tuple[float, float], way: int) -> np.ndarray:
    height, width = taken.shape
    points, here = [place], np.array(place)
    for _ in range(int(REACH * max(height, width) / STEP / 2)):
        middle = here + way * STEP / 2 * _direction(flow, here)  # by the midpoint
        step = way * STEP * _direction(flow, middle)
        here = here + step
        inside = 0 <= here[0] < width and 0 <= here[1] < height
        if not step.any() or not inside or taken[int(here[1]), int(here[0])]:
            break
        points.append(tuple(here))
    return np.array(points)


def _direction(flow: np.ndarray, place: np.ndarray) -> np.ndarray:
    """The unit vector of the flow in the pixel of a place; 0 where it is still, or outside."""
    column, row = int(np.floor(place[0])), int(np.floor(place[1]))
    if not (0 <= row < flow.shape[0] and 0 <= column < flow.shape[1]):
        return np.zeros(2)
    velocity = flow[row, column].astype(float)
    return velocity / (np.hypot(*velocity) or 1.0)


def _take(taken: np.ndarray, line: np.ndarray, radius: float) -> None:
    """No other line comes nearer to this one."""
    reach = int(radius)
    y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    disc = np.hypot(x, y) <= radius
    height, width = taken.shape
    for column, row in line.astype(int):
        top, left = max(0, row - reach), max(0, column - reach)
        bottom, right = min(height, row + reach + 1), min(width, column + reach + 1)
        part = disc[top - row + reach : bottom - row + reach, left - column + reach : right - column + reach]
        taken[top:bottom, left:right] |= part
