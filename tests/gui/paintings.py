"""Pictures that the window tests open."""

from pathlib import Path

import bpy
import numpy as np


def clouds(folder: Path, width: int = 960, height: int = 540) -> tuple[Path, Path]:
    """White clouds in a blue sky over a green field, and the matte of the clouds. Returns both files."""
    y, x = np.mgrid[0:height, 0:width]
    picture = np.empty((height, width, 3))
    picture[:] = np.where((y < 0.7 * height)[..., None], (0.35, 0.55, 0.85), (0.25, 0.4, 0.15))
    matte = np.zeros((height, width))
    for across, down, size in ((0.2, 0.25, 60), (0.26, 0.22, 80), (0.6, 0.35, 72), (0.66, 0.32, 56), (0.85, 0.2, 48)):
        distance = np.hypot((x - across * width) / 1.6, y - down * height)
        matte = np.maximum(matte, np.clip((size - distance) / 6, 0, 1))
    picture += matte[..., None] * (0.95 - picture)
    return (
        _save(folder / "clouds.png", picture),
        _save(folder / "matte.png", np.repeat(matte[..., None], 3, 2)),
    )


def _save(path: Path, pixels: np.ndarray) -> Path:
    """Writes H x W x 3, 0..1, rows top to bottom, as an 8-bit file."""
    height, width, _ = pixels.shape
    image = bpy.data.images.new(path.stem, width, height)
    image.pixels = np.dstack([pixels[::-1], np.ones((height, width))]).astype(np.float32).ravel()
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    bpy.data.images.remove(image)
    return path
