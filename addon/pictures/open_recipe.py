"""A recipe becomes a picture of the scene, and the scene is set up to show it."""

from fractions import Fraction
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, StringProperty

from .. import engine, strokes, versions
from ..bake import job, places
from ..compositor import tree as node
from ..properties import arrange, image
from ..recipe.read import NoPlace, clips_drawn_on, fill_picture, refuse, strokes_of
from ..ui import polls
from . import place
from . import scene as settings
from .open_picture import make_ready


def open_recipe(scene, path: Path):
    """Adds the recipe's picture to `scene` and returns it. Throws ValueError and OSError with a sentence.

    The scene gets the recipe's frames and frame rate.
    """
    recipe = engine.read_recipe(str(path))
    refuse(recipe)
    folder = path.resolve().parent
    for clip in clips_drawn_on(recipe):
        engine.clip_facts(folder / clip)
    shown, size = image.load(str(folder / recipe["picture"]))
    if recipe["size"] is not None and size != tuple(recipe["size"]):
        bpy.data.images.remove(shown)
        sentence = rpt_("size: {said} is not the picture's ({found})")
        raise ValueError(sentence.format(said=list(recipe["size"]), found=list(size)))

    settings.keep(scene)
    picture = arrange.add_picture(scene, path.stem if path.stem != "recipe" else folder.name)
    fill_picture(
        picture,
        recipe,
        places.locate_in(folder),
        lambda curve, index, first, values: versions.set_curve(scene, curve, index, list(enumerate(values, first))),
        arrange.add_layer,
    )
    shown.filepath = picture.picture
    picture.image, picture.picture_size = shown, size
    image.follow(picture)
    place.ensure(scene, picture)
    _use_time(scene, recipe)
    for layer, part in zip(picture.layers, recipe["layers"], strict=True):
        strokes.lay_down(scene, picture, layer.id, strokes_of(part))
    frames = places.locate_in(places.frames_of(picture))(".")
    node.describe(node.ensure(scene, picture), scene, picture, frames, job.layers_alone(picture))
    return picture


def _use_time(scene, recipe: dict) -> None:
    scene.frame_start, scene.frame_end = recipe["frames"]
    rate = Fraction(recipe["fps"]).limit_denominator(1001)
    scene.render.fps = max(1, round(recipe["fps"]))
    scene.render.fps_base = scene.render.fps / float(rate)


class STILLWATER_OT_load_recipe(bpy.types.Operator):
    """Open a recipe as a picture of this scene, with its size, frames, frame rate and compositor"""

    bl_idname = "stillwater.load_recipe"
    bl_label = "Open Recipe"
    bl_options = {"REGISTER", "UNDO"}

    filepath: StringProperty(
        name="Recipe", description="File of the recipe", subtype="FILE_PATH", options={"SKIP_SAVE"}
    )
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})
    filter_folder: BoolProperty(default=True, options={"SKIP_SAVE", "HIDDEN"})

    @classmethod
    def poll(cls, context):
        if engine.problem():
            cls.poll_message_set(engine.problem())
            return False
        return polls.own_scene(cls, context)

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            picture = open_recipe(context.scene, Path(bpy.path.abspath(self.filepath)))
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, error.translated(rpt_) if isinstance(error, NoPlace) else str(error))
            return {"CANCELLED"}
        try:
            settings.use_standard(context.scene)
        except ValueError as error:
            self.report({"WARNING"}, str(error))
        make_ready(context, picture)
        context.view_layer.update()
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_load_recipe]
