"""A small picture that sways, on a plane in the scene, ready to be shown live."""

import time

import bpy
import numpy as np
import recipes
from pixels import HEIGHT, WIDTH, oiio

TREE = {"type": "sway", "armature": [[16, 16], [16, -16]], "amount": 3}


def write(folder, **changes):
    """A recipe of a picture of 16 x 8, most of which sways in a strong wind, with its files; returns the recipe's path."""
    recipe = {
        "stillwater": 1,
        "picture": "picture.exr",
        "frames": [5, 8],
        "wind": {"speed": 20},
        "layers": [{"name": "tree", "matte": {"file": "matte.png"}, "motion": TREE}, {"name": "behind"}],
        "output": {"depth": "float"},
        **changes,
    }
    path = recipes.write(folder, recipe)
    noise = np.random.default_rng(1)
    picture = noise.uniform(0.2, 0.8, (HEIGHT, WIDTH, 3)).astype(np.float32)
    matte = np.ones((HEIGHT, WIDTH, 1), np.float32)
    matte[:, 10:] = 0
    for name, pixels, kind in (("picture.exr", picture, "float"), ("matte.png", matte, "uint8")):
        image = oiio.ImageBuf(oiio.ImageSpec(WIDTH, HEIGHT, pixels.shape[2], kind))
        image.set_pixels(oiio.ROI(), pixels)
        assert image.write(str(folder / name))
    return path


def set_up(scene, folder, **changes):
    """Opens the recipe in a saved file and puts its picture on a plane; returns the picture."""
    path = write(folder / "lake", **changes)
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "file.blend"))
    bpy.ops.stillwater.load_recipe(filepath=str(path))
    picture = scene.stillwater.pictures[0]
    plane = bpy.data.objects.new("Plane", None)
    plane.empty_display_type, plane.empty_display_size = "IMAGE", 8
    plane.empty_image_offset = -0.5, -0.5
    scene.collection.objects.link(plane)
    picture.image = bpy.data.images.load(str(folder / "lake" / "picture.exr"))
    plane.data = picture.image
    picture.plane, picture.picture_size = plane, (WIDTH, HEIGHT)
    bpy.context.view_layer.update()
    return picture


def wait(extension, seconds=20):
    """Stays until nothing is asked of the server any more."""
    deadline = time.monotonic() + seconds
    while extension.play.server.tick() is not None:
        assert time.monotonic() < deadline, "the server does not answer"
        time.sleep(0.02)


def pixels_of(image):
    """What an image of Blender's holds, top row first."""
    width, height = image.size
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(height, width, 4)[::-1]
