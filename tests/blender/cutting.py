"""A picture of a disc before a striped ground, and scribbles on it as an artist would leave them."""

import importlib
import time
from pathlib import Path

import bpy
import numpy as np
from pixels import PACKAGE, oiio

strokes = importlib.import_module(f"{PACKAGE}.strokes")


def truth(width: int, height: int, share: float = 1) -> np.ndarray:
    """The disc's matte, 0 .. 1; of one of another radius by its `share`."""
    y, x = np.mgrid[:height, :width] + 0.5
    return np.clip(share * height / 4 + 0.5 - np.hypot(x - width / 2, y - height / 2), 0, 1).astype(np.float32)


def paint(path: Path, size: tuple[int, int]) -> Path:
    """An orange disc, a little noisy, before blue and green stripes."""
    width, height = size
    y, x = np.mgrid[:height, :width]
    noise = np.random.default_rng(1).uniform(-0.03, 0.03, (height, width, 3))
    stripes = ((x + y) // 24 % 2)[..., None]
    behind = np.where(stripes, (0.1, 0.3, 0.6), (0.15, 0.5, 0.3))
    matte = truth(width, height)[..., None]
    pixels = (matte * (0.9, 0.45, 0.1) + (1 - matte) * behind + noise).clip(0, 1).astype(np.float32)
    image = oiio.ImageBuf(oiio.ImageSpec(width, height, 3, "uint8"))
    image.set_pixels(oiio.ROI(), pixels)
    assert image.write(str(path)), image.geterror()
    return path


def open_picture(scene, folder: Path, size=(320, 180)):
    """The picture with two layers: Disc, which is active, and what is behind it."""
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "file.blend"))
    scene = bpy.context.scene
    bpy.ops.stillwater.open_picture(filepath=str(paint(folder / "disc.png", size)))
    picture = scene.stillwater.active()
    bpy.ops.stillwater.add_layer(motion="still")
    picture.layers[0].name, picture.layers[0].motion.type = "Disc", "drift"
    picture.active_layer = 0
    scene.frame_start, scene.frame_end = 1, 3
    return picture


def lay(scene, picture, layer, **said) -> None:
    """Draws strokes of a layer, given as the recipe has them; Blender is told as by its brush."""
    strokes.lay_down(scene, picture, layer.id, said)
    picture.strokes.data.update_tag()
    bpy.context.view_layer.update()


def across(picture, share: float, width: float = 4.0) -> dict:
    """A stroke along an arc around the middle, at a share of the disc's radius."""
    (w, h), angles = picture.picture_size, np.linspace(0, 1.9 * np.pi, 60)
    points = [[w / 2 + share * h / 4 * np.cos(a), h / 2 + share * h / 4 * np.sin(a)] for a in angles]
    return {"points": points, "width": width}


def corners(picture, share: float) -> list:
    """The corners of an outline around the disc."""
    return across(picture, share)["points"]


def scribble(scene, picture) -> None:
    """Foreground and background of the disc."""
    layer = picture.layers[0]
    layer.matte.form = "scribbles"
    lay(scene, picture, layer, foreground=[across(picture, 0.5)])
    lay(scene, picture, layer, background=[across(picture, 1.6)])


def wait_for_sketch(extension, scene, picture, seconds=20.0, interval=0.005) -> float:
    """Stays until there is a sketch of the matte, looked for every `interval` seconds; how long that took."""
    began = time.monotonic()
    while (stage := extension.play.show.stage_of(scene, picture)) is None or stage.sketch is None:
        extension.play.server.tick()
        assert time.monotonic() < began + seconds, stage and stage.problem
        time.sleep(interval)
    return time.monotonic() - began
