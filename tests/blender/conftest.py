"""A fresh file for each test, a picture in it, and frames that its node shows; or a recipe that can be baked."""

import importlib

import bpy
import numpy as np
import pytest
import recipes
from pixels import HEIGHT, PACKAGE, WIDTH, oiio, set_up, write_frame

TREE = {"type": "sway", "armature": [[16, 16], [16, -16]], "amount": 3}


@pytest.fixture
def extension():
    """The installed extension."""
    return importlib.import_module(PACKAGE)


@pytest.fixture
def scene():
    """The scene of an empty file, set up for small renders."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    set_up(scene)
    return scene


@pytest.fixture
def picture(extension, scene):
    """A picture of the scene with one layer."""
    picture = extension.properties.arrange.add_picture(scene, "Lake")
    extension.properties.arrange.add_layer(picture, "all")
    return picture


@pytest.fixture
def baked(extension, scene, picture, tmp_path):
    """The picture's tree, wired to the render, with frames 5 to 8; and the frames by number."""
    frames = {number: write_frame(tmp_path / "frames" / f"frame_{number:04d}.exr", number) for number in range(5, 9)}
    tree = extension.compositor.tree.ensure(scene, picture)
    tree.stillwater.folder, tree.stillwater.first, tree.stillwater.last = str(tmp_path / "frames"), 5, 8
    extension.compositor.tree.show(tree)
    extension.compositor.tree.wire(scene, tree)
    return tree, frames


@pytest.fixture
def painted(scene, tmp_path):
    """A recipe of a picture of 16 x 8, all of which sways in a strong wind, opened in a saved file."""
    recipe = {
        "stillwater": 1,
        "picture": "picture.exr",
        "frames": [5, 8],
        "wind": {"speed": 20},
        "layers": [{"name": "tree", "matte": {"file": "matte.png"}, "motion": TREE}, {"name": "behind"}],
        "output": {"depth": "float"},
    }
    path = recipes.write(tmp_path / "lake", recipe)
    noise = np.random.default_rng(1)
    picture = noise.uniform(0.2, 0.8, (HEIGHT, WIDTH, 3)).astype(np.float32)
    matte = np.ones((HEIGHT, WIDTH, 1), np.float32)
    for name, pixels, kind in (("picture.exr", picture, "float"), ("matte.png", matte, "uint8")):
        image = oiio.ImageBuf(oiio.ImageSpec(WIDTH, HEIGHT, pixels.shape[2], kind))
        image.set_pixels(oiio.ROI(), pixels)
        assert image.write(str(tmp_path / "lake" / name))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.stillwater.load_recipe(filepath=str(path))
    return tmp_path / "stillwater" / "lake" / "frames"
