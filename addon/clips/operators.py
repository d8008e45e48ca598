"""Choosing a clip and showing it: below the picture, and in an Image Editor that shows no picture of the artist's."""

import os

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import BoolProperty, StringProperty

from .. import engine, strokes
from ..pictures import scene as settings
from ..properties import image
from ..ui import polls


def example_layer(picture):
    """The active layer where it looks like a clip, else None."""
    layer = picture.layers[picture.active_layer] if picture.active_layer < len(picture.layers) else None
    return layer if layer is not None and layer.motion.type == "example" else None


class OfExample:
    """An operator about the clip of the active layer."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if engine.problem():
            cls.poll_message_set(engine.problem())
            return False
        if not polls.own_picture(cls, context):
            return False
        if example_layer(context.scene.stillwater.active()) is None:
            cls.poll_message_set(tip_("Select a layer with the motion Example first"))
            return False
        return True


class OfClip(OfExample):
    """One that needs it to be chosen."""

    @classmethod
    def poll(cls, context):
        if not super().poll(context) or not polls.on_a_plane(cls, context):
            return False
        if not example_layer(context.scene.stillwater.active()).motion.example.clip:
            cls.poll_message_set(tip_("The layer has no clip yet; press Choose Clip first"))
            return False
        return True


class OnClip(OfClip):
    """One that waits for the mouse on the clip."""

    def begin(self, context, cursor: str, hint: str) -> set[str]:
        """Shows the clip and takes the mouse; `hint` stands in the status bar."""
        picture = context.scene.stillwater.active()
        try:
            strokes.show_clip(picture, example_layer(picture))
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        context.window.cursor_modal_set(cursor)
        context.workspace.status_text_set(hint)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def end(self, context) -> None:
        """Gives the mouse back."""
        context.window.cursor_modal_restore()
        context.workspace.status_text_set(None)

    def cancel(self, context):
        self.end(context)


class STILLWATER_OT_choose_clip(OfExample, bpy.types.Operator):
    """Choose the film whose fluid the layer looks and moves like; best from a camera that stands still"""

    bl_idname = "stillwater.choose_clip"
    bl_label = "Choose Clip"

    filepath: StringProperty(name="Clip", description="File of the clip", subtype="FILE_PATH", options={"SKIP_SAVE"})
    filter_movie: BoolProperty(default=True, options={"SKIP_SAVE", "HIDDEN"})
    filter_folder: BoolProperty(default=True, options={"SKIP_SAVE", "HIDDEN"})

    def invoke(self, context, event):
        if not self.filepath:
            self.filepath = bpy.path.abspath(example_layer(context.scene.stillwater.active()).motion.example.clip)
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        layer, path = example_layer(context.scene.stillwater.active()), bpy.path.abspath(self.filepath)
        try:
            if not self.filepath:
                raise ValueError(rpt_("No clip was chosen"))
            clip = engine.clip_facts(path)
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        layer.motion.example.clip = image.stored(path)
        sentence = rpt_("{file}: {frames} frames of {width} x {height} px")
        said = sentence.format(file=os.path.basename(path), frames=clip.frames, width=clip.width, height=clip.height)
        self.report({"INFO"}, said + (rpt_(", {fps:.4g} a second").format(fps=clip.fps) if clip.fps else ""))
        return {"FINISHED"}


class STILLWATER_OT_show_clip(OfClip, bpy.types.Operator):
    """Show the clip below the picture, where clone sources are drawn on it and its speed is picked"""

    bl_idname = "stillwater.show_clip"
    bl_label = "Show Clip"

    def execute(self, context):
        picture = context.scene.stillwater.active()
        try:
            shown = strokes.show_clip(picture, example_layer(picture))
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if context.view_layer.objects.get(shown.name) == shown:
            shown.hide_viewport = False
            shown.hide_set(False)
        if context.scene.camera == picture.camera is not None:
            settings.look(context.scene, picture, below=shown)
        for area in [area for area in context.screen.areas if area.type == "IMAGE_EDITOR"] if context.screen else ():
            _show_in_editor(area.spaces.active, shown.data)
        return {"FINISHED"}


def _show_in_editor(space, movie) -> None:
    """Leaves an editor alone that shows something else than a clip."""
    if space.image is None or space.image.source == "MOVIE":
        space.image = movie
        space.image_user.frame_start, space.image_user.frame_duration = 1, max(1, movie.frame_duration)
        space.image_user.use_cyclic = space.image_user.use_auto_refresh = True


CLASSES = [STILLWATER_OT_choose_clip, STILLWATER_OT_show_clip]
