"""A fresh file for each test, a picture in it, and frames that its node shows."""

import importlib

import bpy
import pytest
from pixels import PACKAGE, set_up, write_frame


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
