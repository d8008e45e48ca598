"""Scenes for the benches, made of noise: pictures of the paper's sizes with layers of mixed sizes and motions.

A layer is a soft ellipse. Its area is chosen so that all layers together cover the picture a given number of times;
the rim that is neither 0 nor 1 takes a fixed share of it.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image
from stillwater import _stillwater as engine

SOFT_SHARE = 0.12  # of a layer's area


@dataclass(frozen=True)
class Scene:
    """A picture of noise with `layers` layers (the background counts), which cover it `covered` times in all."""

    name: str
    width: int
    height: int
    layers: int
    covered: float = 3.0


# Chuang et al. 2005, figure 6: five pictures of 3 .. 26 layers.
PAPER = [
    Scene("576x480, 13 layers", 576, 480, 13),
    Scene("640x480, 17 layers", 640, 480, 17),
    Scene("720x540, 3 layers", 720, 540, 3),
    Scene("800x600, 24 layers", 800, 600, 24),
    Scene("900x675, 26 layers", 900, 675, 26),
]
LARGE = Scene("1920x1080, 29 layers", 1920, 1080, 29)

WIND = engine.Wind(speed=6, gusts=0.3)


def view(scene: Scene):
    y = 0.35 * scene.height
    return engine.View(horizon=((0, y), (scene.width, y)))


def moment(frame: int):
    wind = engine.Wind(speed=6, gusts=0.3, travel=(6 * (frame - 1) / 24, 0))
    return engine.Moment(frame=frame, fps=24, wind=wind)


def write_recipe(scene: Scene, folder: Path) -> Path:
    """The scene as files, 8 bits each: its picture, its mattes and its recipe, whose path is the answer."""

    def save(name: str, image) -> str:
        Image.fromarray(np.rint(255 * image).astype(np.uint8)).save(folder / name, compress_level=1)
        return name

    layers = [{"name": "back"}]
    for i, matte in reversed(list(enumerate(_shapes(scene)))):
        rows, columns = np.flatnonzero(matte.any(axis=1)), np.flatnonzero(matte.any(axis=0))
        box = (columns[0], rows[0], columns[-1] - columns[0] + 1, rows[-1] - rows[0] + 1)
        motion = _recipe_motion(_motion(scene, i, tuple(map(int, box))), scene)
        layers.insert(0, {"name": str(i), "matte": {"file": save(f"{i}.png", matte)}, "motion": motion})
    recipe = {
        "stillwater": 1,
        "picture": save("picture.png", _noise(scene)[..., :3]),
        "frames": [1, 48],
        "wind": {"speed": 6, "gusts": 0.3},
        "view": {"horizon": view(scene).horizon},
        "layers": layers,
    }
    path = folder / "recipe.json"
    path.write_text(json.dumps(recipe))
    return path


def _recipe_motion(motion, scene: Scene) -> dict:
    match motion:
        case engine.Ripple():
            return {"type": "ripple"}
        case engine.Drift():
            return {"type": "drift", "velocity": [0.7, 0]}
        case engine.Bob():
            return {"type": "bob", "water": str(scene.layers - 2), "waterline": motion.waterline}
        case _:
            return {"type": "sway", "armature": motion.armature, "seed": motion.seed}


class Bed:
    """A scene ready to be rendered: `render(frame)`."""

    def __init__(self, scene: Scene):
        engine.set_threads(0)  # another bench may have asked for one
        self.scene = scene
        shapes = list(_shapes(scene))
        picture = _noise(scene)
        fills = [engine.Fill.push_pull] * scene.layers
        images = engine.peel(picture, [*shapes, None], fills, [0.0] * scene.layers)
        self.boxes = sum(image.box[2] * image.box[3] for image in images)
        self.motions = [_motion(scene, i, image.box) for i, image in enumerate(images)]
        water = next((i for i, m in enumerate(self.motions) if isinstance(m, engine.Ripple)), -1)
        layers = [
            engine.Layer(image, motion=motion, water=water if isinstance(motion, engine.Bob) else -1, endless=(True, False))
            for image, motion in zip(images, self.motions, strict=True)
        ]
        self.renderer = engine.FrameRenderer((scene.width, scene.height), 1.0, view(scene), WIND, layers)
        self.frame = 1

    def render(self, frame: int, flow: bool = False):
        return self.renderer.render(moment(frame), moment(frame + 1), self._states(frame), self._states(frame + 1), flow=flow)

    def next_frame(self, flow: bool = False):
        """The frame after the last one: what a player asks for."""
        self.frame += 1
        return self.render(self.frame, flow)

    def _states(self, frame: int):
        drifted = engine.Drift(offset=(0.7 * (frame - 1), 0))
        return [engine.LayerState(1.0, drifted if isinstance(m, engine.Drift) else m) for m in self.motions]


def _noise(scene: Scene):
    rng = np.random.default_rng(1)
    picture = rng.random((scene.height, scene.width, 4), np.float32)
    picture[..., 3] = 1
    return picture


def _shapes(scene: Scene):
    """One matte for each layer but the last; sizes fall off, places are spread."""
    rng = np.random.default_rng(2)
    weights = 1 / np.arange(1, scene.layers) ** 0.7
    areas = weights / weights.sum() * (scene.covered - 1) * scene.width * scene.height
    y, x = np.mgrid[: scene.height, : scene.width].astype(np.float32)
    for area in rng.permutation(areas):
        aspect = rng.uniform(0.5, 2)
        rx = min(np.sqrt(area / np.pi * aspect), 0.5 * scene.width)
        ry = min(area / np.pi / rx, 0.5 * scene.height)
        cx, cy = rng.uniform(rx, scene.width - rx), rng.uniform(ry, scene.height - ry)
        distance = np.hypot((x - cx) / rx, (y - cy) / ry)
        yield np.clip((1 + SOFT_SHARE / 4 - distance) / (SOFT_SHARE / 2), 0, 1)


def _motion(scene: Scene, i: int, box):
    """Mostly trees, some boats, one water, one bank of clouds, one still; the last is the background."""
    x, y, width, height = box
    if i == scene.layers - 1:
        return None
    if i == scene.layers - 2:
        return engine.Ripple()
    if i == scene.layers - 3:
        return engine.Drift()
    if i % 6 == 4:
        return engine.Bob(waterline=[(x, y + height), (x + width, y + height)])
    return engine.Sway(armature=((x + width / 2, y + height), (x + width / 2, y)), seed=i)
