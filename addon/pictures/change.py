"""Another file for a picture, or the same one again after it changed on disk."""

import os

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import BoolProperty, StringProperty

from ..compositor import tree as node
from ..properties import image
from ..ui import polls
from . import place
from .resize import resize


def read(scene, picture, path: str) -> bool:
    """Reads the picture from `path`, now and from now on. True where its size changed. Throws ValueError.

    Nothing is changed by a file that can't be read.
    """
    fresh, size = image.load(path)
    file_format = fresh.file_format
    stored = image.stored(path)
    if picture.image is None:
        picture.image = fresh
    else:
        bpy.data.images.remove(fresh)
    with image.held():
        picture.picture = stored
    shown = picture.image
    shown.filepath, shown.file_format = stored, file_format
    image.follow(picture)
    shown.reload()
    shown.update_tag()
    picture.missing = False
    changed = resize(scene, picture, size)
    if picture.tree is not None:
        node.show(node.ensure(scene, picture))
    if picture.plane is not None:
        place.ensure(scene, picture)
    return changed


def _told(operator, context, path: str, done: str) -> set[str]:
    """Reads the active picture from `path` and reports what happened."""
    scene = context.scene
    picture = scene.stillwater.active()
    old = tuple(picture.picture_size)
    try:
        changed = read(scene, picture, path)
    except ValueError as error:
        operator.report({"ERROR"}, str(error))
        return {"CANCELLED"}
    context.view_layer.update()
    if changed:
        sentence = rpt_(
            "{name} is now {new[0]} x {new[1]} pixels, not {old[0]} x {old[1]}; strokes and places went with it"
        )
        done = sentence.format(name=picture.name, new=picture.picture_size, old=old)
        if any(layer.matte.form != "none" or layer.fill.method == "file" for layer in picture.layers):
            done += rpt_(". Mattes and painted backgrounds from files need the new size too")
    operator.report({"INFO"}, done)
    return {"FINISHED"}


class STILLWATER_OT_replace_picture(bpy.types.Operator):
    """Choose another file for the active picture, or the same one where it is now. Layers and strokes stay"""

    bl_idname = "stillwater.replace_picture"
    bl_label = "Replace Picture"
    bl_options = {"REGISTER", "UNDO"}

    filepath: StringProperty(
        name="Picture", description="File of the new picture", subtype="FILE_PATH", options={"SKIP_SAVE"}
    )
    filter_image: BoolProperty(default=True, options={"SKIP_SAVE", "HIDDEN"})
    filter_folder: BoolProperty(default=True, options={"SKIP_SAVE", "HIDDEN"})

    @classmethod
    def poll(cls, context):
        return polls.own_picture(cls, context)

    def invoke(self, context, event):
        if not self.filepath:
            self.filepath = bpy.path.abspath(context.scene.stillwater.active().picture)
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        path = bpy.path.abspath(self.filepath)
        return _told(self, context, path, rpt_("The picture is now {file}").format(file=os.path.basename(path)))


class STILLWATER_OT_reload_picture(bpy.types.Operator):
    """Read the active picture's file again. At another size, strokes and places go with it"""

    bl_idname = "stillwater.reload_picture"
    bl_label = "Reload Picture"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not polls.own_picture(cls, context):
            return False
        if not context.scene.stillwater.active().picture:
            cls.poll_message_set(tip_("This picture has no file yet: choose one with Replace Picture"))
            return False
        return True

    def execute(self, context):
        picture = context.scene.stillwater.active()
        image.take_over(picture)
        path = bpy.path.abspath(picture.picture)
        return _told(self, context, path, rpt_("Read again: {file}").format(file=os.path.basename(path)))


CLASSES = [STILLWATER_OT_replace_picture, STILLWATER_OT_reload_picture]
