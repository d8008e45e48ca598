"""One page that shows how a scene moves."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont
from scene import Scene

CELL = 400  # pixels, width
GAP = 4
LINE = 16
COLUMNS = 4
SHOWN = 6  # frames
GAIN = 4.0  # of the difference picture
TIME_STEP = 6  # rows of a slice for a frame
HUES = [(230, 60, 50), (60, 170, 75), (255, 225, 25), (0, 110, 220), (245, 130, 48), (145, 30, 180), (70, 240, 240)]

Frames = NDArray[np.float32]  # time x height x width x 3, 0 .. 1


def as_image(values: NDArray[np.float32]) -> Image.Image:
    return Image.fromarray((np.clip(values, 0, 1) * 255 + 0.5).astype(np.uint8))


def map_of(scene: Scene) -> Image.Image:
    """The parts, each in a colour of its own, over the grey picture; what lies in front covers."""
    shown = np.asarray(scene.picture.convert("L").convert("RGB")).astype(np.float32) / 255
    for number, part in reversed(list(enumerate(scene.parts))):
        matte = np.ones(shown.shape[:2], bool) if part.matte is None else part.matte
        shown[matte] = 0.45 * shown[matte] + 0.55 * np.array(HUES[number % len(HUES)], np.float32) / 255
    image = as_image(shown)
    pen = ImageDraw.Draw(image)
    for part in scene.parts:
        if "armature" in part.motion:
            pen.line([tuple(point) for point in part.motion["armature"]], fill="white", width=3)
    if "horizon" in scene.view:
        pen.line([tuple(point) for point in scene.view["horizon"]], fill="black", width=2)
    return image


def difference(frames: Frames) -> Image.Image:
    """How far each pixel strays from the first frame at most."""
    return as_image(GAIN * abs(frames - frames[0]).max(axis=(0, 3), keepdims=True)[0].repeat(3, axis=-1))


def middle_row(matte: NDArray[np.bool_]) -> int:
    """The row above which lies a third of the region: where trees move and water is not yet large."""
    return int(np.searchsorted(np.cumsum(matte.sum(axis=1)), matte.sum() / 3))


def slices(scene: Scene, frames: Frames) -> list[tuple[str, Image.Image]]:
    """For each part that moves, one of its rows over time (downwards)."""
    covered = np.zeros(frames.shape[1:3], bool)
    found = []
    for part in scene.parts:
        matte = ~covered if part.matte is None else part.matte
        covered |= matte
        if part.motion["type"] == "still" or not matte.any():
            continue
        row = middle_row(matte)
        found.append((f"{part.name}: row {row} over time", as_image(frames[:, row].repeat(TIME_STEP, axis=0))))
    return found


def write_sheet(scene: Scene, frames: Frames, path: Path) -> None:
    """The picture, its parts, SHOWN frames, the difference and the slices."""
    picked = np.unique(np.linspace(0, len(frames) - 1, SHOWN).round().astype(int))
    cells = [(scene.name, scene.picture), (", ".join(part.name for part in scene.parts), map_of(scene))]
    cells += [(f"frame {index + 1}", as_image(frames[index])) for index in picked]
    cells += [(f"largest difference to frame 1, x {GAIN:g}", difference(frames)), *slices(scene, frames)]
    cells = [(title, image.resize((CELL, round(image.height * CELL / image.width)))) for title, image in cells]
    rows = [cells[start : start + COLUMNS] for start in range(0, len(cells), COLUMNS)]
    heights = [max(image.height for _, image in row) + LINE + GAP for row in rows]
    sheet = Image.new("RGB", (COLUMNS * (CELL + GAP) + GAP, sum(heights) + GAP), (24, 24, 24))
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(12)
    top = GAP
    for row, height in zip(rows, heights, strict=True):
        for column, (title, image) in enumerate(row):
            left = GAP + column * (CELL + GAP)
            pen.text((left, top), title[:66], font=font, fill="white")
            sheet.paste(image, (left, top + LINE))
        top += height
    sheet.save(path)
