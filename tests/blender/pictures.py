"""Pictures to open, and what the camera and the compositor make of them."""

from pathlib import Path

import bpy
import numpy as np
from bpy_extras.object_utils import world_to_camera_view
from pixels import oiio

WIDTH, HEIGHT = 48, 32


def paint(path: Path, size=(WIDTH, HEIGHT), seed=1) -> Path:
    """A picture of random colours; its name's ending says how it is written."""
    path.parent.mkdir(parents=True, exist_ok=True)
    kind = "float" if path.suffix == ".exr" else "uint8"
    colours = np.random.default_rng(seed).uniform(0, 1, (size[1], size[0], 3)).astype(np.float32)
    image = oiio.ImageBuf(oiio.ImageSpec(*size, 3, kind))
    image.set_pixels(oiio.ROI(), colours)
    assert image.write(str(path)), image.geterror()
    return path


def look_at(scene, place) -> tuple[float, float]:
    """Where the scene's camera sees a place: (0, 0) is the lower left corner of the render, (1, 1) the upper right."""
    bpy.context.view_layer.update()
    return tuple(world_to_camera_view(scene, scene.camera, place.xyz))[:2]


def rendered(scene, path: Path) -> np.ndarray:
    """The scene's render, scene-linear: rows from the top, R, G, B."""
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(path)
    bpy.context.window.scene = scene
    bpy.ops.render.render(write_still=True)
    return oiio.ImageBuf(str(path)).get_pixels("float")[..., :3]
