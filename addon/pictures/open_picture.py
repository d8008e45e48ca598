"""From a file on disk to a picture that can be drawn on."""

import os

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, StringProperty

from ..properties import arrange, image
from ..ui import polls
from . import place
from . import scene as settings

EXTENSIONS = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr", ".hdr", ".tga", ".bmp", ".webp", ".jp2", ".dpx", ".psd")


def open_picture(scene, path: str):
    """Adds the file as a picture of `scene`, on a plane, with a Background layer. Throws ValueError with a sentence."""
    shown, size = image.load(path)
    picture = arrange.add_picture(scene, os.path.splitext(os.path.basename(path))[0])
    picture.picture = shown.filepath = image.stored(path)
    picture.image, picture.picture_size = shown, size
    image.follow(picture)
    arrange.add_layer(picture, "Background")
    place.ensure(scene, picture)
    return picture


def make_ready(context, picture) -> bool:
    """The views look at the picture, and drawing would go to its strokes. What show() of scene.py returns."""
    scene = context.scene
    free = settings.show(scene, picture)
    settings.look(scene, picture)
    select_strokes(context, picture)
    return free


def select_strokes(context, picture) -> None:
    """Makes the picture's strokes the one selected and active object."""
    leave_mode(context)
    strokes = picture.strokes
    if strokes.name not in context.view_layer.objects:  # its collection is excluded there
        return
    for item in context.selected_objects:
        item.select_set(False)
    strokes.select_set(True)
    context.view_layer.objects.active = strokes


def leave_mode(context) -> None:
    """Back to object mode: objects are added, chosen and removed there."""
    if context.mode != "OBJECT" and bpy.ops.object.mode_set.poll():
        bpy.ops.object.mode_set(mode="OBJECT")


class OfFiles:
    """An operator that opens pictures from files."""

    filepath: StringProperty(name="Picture", subtype="FILE_PATH", options={"SKIP_SAVE", "HIDDEN"})
    directory: StringProperty(subtype="DIR_PATH", options={"SKIP_SAVE", "HIDDEN"})
    files: CollectionProperty(type=bpy.types.OperatorFileListElement, options={"SKIP_SAVE", "HIDDEN"})
    filter_image: BoolProperty(default=True, options={"SKIP_SAVE", "HIDDEN"})
    filter_folder: BoolProperty(default=True, options={"SKIP_SAVE", "HIDDEN"})

    use_render: BoolProperty(
        name="Camera and Render", default=True,
        description="The scene's camera and render size become the picture's, and renders show it."
        " A compositor of your own stays as it is",
    )
    use_standard: BoolProperty(
        name="Standard View", default=True,
        description="Set the view transform to Standard, so that renders have the picture's own colors",
    )
    frame_rate: EnumProperty(
        name="Frame Rate", description="Frame rate of the whole scene. A still picture has none of its own", default="KEEP",
        items=[
            ("KEEP", "Keep the Scene's", "Frame rate and frame range stay as they are"),
            *((rate, rate, f"{rate} frames per second") for rate in settings.RATES),
        ],
    )

    @classmethod
    def poll(cls, context):
        return polls.own_scene(cls, context)

    def invoke(self, context, event):
        if self.directory or self.filepath:  # dropped onto the viewport
            return self.execute(context)
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        opened, problems = None, []
        for path in self._paths():
            try:
                opened = open_picture(context.scene, path)
            except ValueError as error:
                problems.append(str(error))
        for problem in problems:
            self.report({"WARNING" if opened else "ERROR"}, problem)
        if opened is None:
            return {"CANCELLED"}
        self._set_up(context, opened)
        context.view_layer.update()
        return {"FINISHED"}

    def _paths(self) -> list[str]:
        names = [file.name for file in self.files if file.name]
        paths = [os.path.join(self.directory, name) for name in names] or [self.filepath]
        return [bpy.path.abspath(path) for path in paths]

    def _set_up(self, context, picture) -> None:
        settings.keep(context.scene)
        settings.use_rate(context.scene, self.frame_rate)
        if self.use_standard:
            try:
                settings.use_standard(context.scene)
            except ValueError as error:
                self.report({"WARNING"}, str(error))
        if not self.use_render:
            select_strokes(context, picture)
        elif not make_ready(context, picture):
            self.report({"INFO"}, rpt_("Your compositor stays as it is; the Stillwater node stands beside it"))


class STILLWATER_OT_open_picture(OfFiles, bpy.types.Operator):
    """Open a still picture and make the scene ready to animate it: plane, camera, strokes, compositor"""

    bl_idname = "stillwater.open_picture"
    bl_label = "Open Picture"
    bl_options = {"REGISTER", "UNDO"}


class STILLWATER_OT_drop_picture(OfFiles, bpy.types.Operator):
    """Open a still picture in Stillwater. Blender asks by this name what is to become of a file that is dropped"""

    bl_idname = "stillwater.drop_picture"
    bl_label = "Open in Stillwater"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}


class STILLWATER_FH_picture(bpy.types.FileHandler):
    """A picture that is dropped onto the 3D viewport."""

    bl_idname = "STILLWATER_FH_picture"
    bl_label = "Stillwater Picture"
    bl_import_operator = STILLWATER_OT_drop_picture.bl_idname
    bl_file_extensions = ";".join(EXTENSIONS)

    @classmethod
    def poll_drop(cls, context):
        return context.area is not None and context.area.type == "VIEW_3D"


CLASSES = [STILLWATER_OT_open_picture, STILLWATER_OT_drop_picture, STILLWATER_FH_picture]
