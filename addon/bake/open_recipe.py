"""A recipe becomes a picture of the scene, and the scene is set up to show it."""

from fractions import Fraction
from pathlib import Path

import bpy

from .. import engine, versions
from ..compositor import tree as node
from ..properties import arrange
from ..recipe.read import fill_picture, refuse
from . import job, places


def open_recipe(scene, path: Path):
    """Adds the recipe's picture to `scene` and returns it. Throws ValueError and OSError with a sentence.

    The scene gets the picture's size, frames and frame rate, the view transform that changes no colour, and a node
    whose Image is what renders show.
    """
    recipe = engine.read_recipe(str(path))
    refuse(recipe)
    folder = path.resolve().parent
    size = _size_of(folder / recipe["picture"])
    if recipe["size"] is not None and size != tuple(recipe["size"]):
        raise ValueError(f"size: {list(recipe['size'])} is not the picture's ({list(size)})")

    _set_up(scene, recipe, size)
    picture = arrange.add_picture(scene, path.stem if path.stem != "recipe" else folder.name)
    fill_picture(
        picture,
        recipe,
        places.locate_in(folder),
        lambda curve, index, first, values: versions.set_curve(scene, curve, index, list(enumerate(values, first))),
        arrange.add_layer,
    )
    tree = node.ensure(scene, picture)
    node.describe(tree, scene, picture, places.locate_in(places.frames_of(picture))("."), job.layers_alone(picture))
    node.show(tree)
    node.wire(scene, tree)
    return picture


def _size_of(path: Path) -> tuple[int, int]:
    image = bpy.data.images.load(str(path))
    size = tuple(image.size)
    bpy.data.images.remove(image)
    if 0 in size:
        raise ValueError(f"{path}: Blender can't read this picture")
    return size


def _set_up(scene, recipe: dict, size: tuple[int, int]) -> None:
    scale = recipe["output"]["scale"]
    render = scene.render
    render.resolution_x, render.resolution_y = (max(1, round(length * scale)) for length in size)
    render.resolution_percentage = 100
    scene.frame_start, scene.frame_end = recipe["frames"]
    rate = Fraction(recipe["fps"]).limit_denominator(1001)
    render.fps = max(1, round(recipe["fps"]))
    render.fps_base = render.fps / float(rate)
    scene.display_settings.display_device = "sRGB"
    scene.view_settings.view_transform = "Standard"
    scene.view_settings.look = "None"
    scene.view_settings.exposure, scene.view_settings.gamma = 0, 1
