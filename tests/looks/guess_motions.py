"""What a region of a picture probably is, from its place and shape alone, and the motion that suits it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Motion = dict[str, Any]
STILL: Motion = {"type": "still"}
DRIFT: Motion = {"type": "drift"}
BORDER = 0.01  # of the height: so near is at the border
TINY = 0.006  # share of the picture
WIDE = 0.5  # of the picture's width
FLAT = 0.08  # of the picture's height: how far the shore departs from a line
SHORE = 0.7  # share of the columns where it must not
SKY = 0.65  # of the picture's height: sky ends above
UPRIGHT = 0.75  # height for a width
TALL = 0.15  # of the picture's height


def top_edge(region: NDArray[np.bool_]) -> NDArray[np.int64]:
    """The first row of each column that has one."""
    columns = np.flatnonzero(region.any(axis=0))
    return region[:, columns].argmax(axis=0)


def armature(region: NDArray[np.bool_]) -> list[list[float]]:
    """From the middle of the region's lowest twentieth to the middle of its highest."""
    y, x = np.nonzero(region)
    slab = max(1.0, 0.05 * (y.max() + 1 - y.min()))
    low, high = y > y.max() - slab, y < y.min() + slab
    return [[float(x[low].mean()) + 0.5, float(y.max() + 1)], [float(x[high].mean()) + 0.5, float(y.min())]]


def shore(region: NDArray[np.bool_]) -> tuple[float, float]:
    """The row where water of this shape meets the land, and the share of its columns that agree."""
    edge = top_edge(region)
    near = abs(edge - np.median(edge)) <= FLAT * region.shape[0]
    return float(edge[near].min()), float(near.mean())


def guess_motion(region: NDArray[np.bool_]) -> Motion:
    """Top: drift. Bottom, wide and flat: ripple. Upright: sway. Else still."""
    height, width = region.shape
    rows, columns = np.flatnonzero(region.any(axis=1)), np.flatnonzero(region.any(axis=0))
    box_height, box_width = rows[-1] + 1 - rows[0], columns[-1] + 1 - columns[0]
    top, bottom = rows[0] <= BORDER * height, rows[-1] + 1 >= (1 - BORDER) * height
    if region.mean() < TINY or (top and bottom and box_width > WIDE * width):
        return STILL
    if top and box_width > WIDE * width:
        return DRIFT if np.percentile(np.nonzero(region)[0], 95) < SKY * height else STILL
    if bottom and box_width > WIDE * width:
        return {"type": "ripple"} if shore(region)[1] > SHORE else STILL
    if rows[-1] < 0.55 * height and box_height < UPRIGHT * box_width:
        return DRIFT
    if box_height > max(UPRIGHT * box_width, TALL * height) and rows[-1] > 0.4 * height:
        return {"type": "sway", "armature": armature(region)}
    return STILL


def depth(region: NDArray[np.bool_], motion: Motion) -> int:
    """Larger lies further back: what sways, what floats in the air, what stands, water, and the sky behind it all."""
    if motion["type"] == "drift":
        return 4 if region[0].any() else 1
    return ["sway", "drift", "still", "ripple"].index(motion["type"])
