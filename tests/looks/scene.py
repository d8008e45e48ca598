"""A picture cut into parts that move: by its label map and a guess, or by polygons drawn by hand."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from guess_motions import STILL, depth, guess_motion, shore
from label_colours import label_map, regions
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy import ndimage

WIDEST = 640  # pixels
FRINGE = 2  # pixels; label maps and polygons end inside of what they cut out


@dataclass
class Part:
    """One layer: where it is (None: wherever nothing else is) and how it moves."""

    name: str
    matte: NDArray[np.bool_] | None
    motion: dict[str, Any]
    follows: dict[str, Any] | None = None


@dataclass
class Scene:
    """One picture, its parts from front to back, and what it says of wind and view."""

    name: str
    picture: Image.Image
    parts: list[Part]
    wind: dict[str, Any] = field(default_factory=dict)
    view: dict[str, Any] = field(default_factory=dict)


def opened(path: Path) -> Image.Image:
    """The picture, not wider than WIDEST."""
    with Image.open(path) as file:
        picture = file.convert("RGB")
    if picture.width <= WIDEST:
        return picture
    return picture.resize((WIDEST, round(picture.height * WIDEST / picture.width)), Image.Resampling.LANCZOS)


def scene_of_labels(name: str, picture: Path, labels: Path) -> Scene:
    """Every region of the label map a part, the rearmost without a matte."""
    image = opened(picture)
    with Image.open(labels) as file:
        drawn = file.convert("RGB").resize(image.size, Image.Resampling.NEAREST)
    parts, horizons = [], []
    for number, region in enumerate(regions(label_map(np.asarray(drawn)))):
        motion = guess_motion(region)
        parts.append(Part(f"{motion['type']} {number}", region, motion))
        if motion["type"] == "ripple":
            horizons.append(shore(region)[0])
    parts.sort(key=lambda part: depth(part.matte, part.motion))
    if not parts:
        parts.append(Part("all", None, STILL))
    parts[-1].matte = None
    view = {"horizon": [[0, min(horizons)], [image.width, min(horizons)]]} if horizons else {}
    return Scene(name, image, parts, view=view)


def polygon_matte(polygons: list[list[list[float]]], size: tuple[int, int]) -> NDArray[np.bool_]:
    """The union of polygons in shares of the picture's width and height."""
    canvas = Image.new("L", size)
    for polygon in polygons:
        ImageDraw.Draw(canvas).polygon([(x * size[0], y * size[1]) for x, y in polygon], fill=255)
    return np.asarray(canvas) > 0


def in_pixels(points: list[list[float]], size: tuple[int, int]) -> list[list[float]]:
    """Shares of the picture's sides as picture pixels."""
    return [[x * size[0], y * size[1]] for x, y in points]


def scene_of_polygons(name: str, picture: Path, drawn: dict[str, Any]) -> Scene:
    """The parts as polygons.json has them: places in shares of the picture's sides, all else as in a recipe."""
    image = opened(picture)
    parts = []
    for given in drawn["layers"]:
        motion = dict(given.get("motion", STILL))
        for places in {"armature", "waterline"} & set(motion):
            motion[places] = in_pixels(motion[places], image.size)
        matte = polygon_matte(given["polygons"], image.size) if "polygons" in given else None
        parts.append(Part(given["name"], matte, motion, given.get("follows")))
    view = dict(drawn.get("view", {}))
    if "horizon" in view:
        view["horizon"] = in_pixels(view["horizon"], image.size)
    return Scene(name, image, parts, drawn.get("wind", {}), view)


def write_recipe(scene: Scene, folder: Path, frames: int) -> Path:
    """Picture, mattes and recipe.json in the folder."""
    (folder / "mattes").mkdir(parents=True, exist_ok=True)
    scene.picture.save(folder / "picture.png")
    layers = []
    for part in scene.parts:
        layer: dict[str, Any] = {"name": part.name}
        if part.matte is not None:
            file = f"mattes/{part.name.replace(' ', '_')}.png"
            whole = ndimage.binary_dilation(part.matte, iterations=FRINGE)
            Image.fromarray(np.where(whole, 255, 0).astype(np.uint8)).save(folder / file)
            layer |= {"matte": {"file": file}, "feather": 1.5}
        if part.follows:
            layer["follows"] = part.follows
        if part.motion["type"] != "still":
            layer["motion"] = part.motion
        layers.append(layer)
    recipe = {"stillwater": 1, "picture": "picture.png", "frames": [1, frames], "wind": scene.wind, "layers": layers}
    if scene.view:
        recipe["view"] = scene.view
    path = folder / "recipe.json"
    path.write_text(json.dumps(recipe, indent=1), encoding="utf-8")
    return path
