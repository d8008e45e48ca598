"""Choosing the picture that the scene shows, and the colours in which it is shown."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import IntProperty

from ..ui import polls
from . import place
from . import scene as settings
from .change import read
from .open_picture import make_ready


class STILLWATER_OT_show_picture(bpy.types.Operator):
    """Look at the active picture: camera and render become its own. What was deleted of these is made again"""

    bl_idname = "stillwater.show_picture"
    bl_label = "Show Picture"
    bl_options = {"REGISTER", "UNDO"}

    index: IntProperty(
        name="Picture", description="Number of the picture in the scene's list; -1 is the active one",
        default=-1, min=-1, options={"SKIP_SAVE", "HIDDEN"},
    )

    @classmethod
    def poll(cls, context):
        return polls.own_picture(cls, context)

    def execute(self, context):
        scene = context.scene
        if self.index >= len(scene.stillwater.pictures):
            self.report({"ERROR"}, rpt_("The scene has no picture {index}").format(index=self.index))
            return {"CANCELLED"}
        if self.index >= 0:
            scene.stillwater.active_picture = self.index
        picture = scene.stillwater.active()
        if picture.image is None:
            try:
                read(scene, picture, bpy.path.abspath(picture.picture))
            except ValueError as error:
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
        place.ensure(scene, picture)
        if not make_ready(context, picture):
            self.report({"INFO"}, rpt_("Your compositor stays as it is; the Stillwater node stands beside it"))
        context.view_layer.update()
        return {"FINISHED"}


class STILLWATER_OT_fit_view(bpy.types.Operator):
    """See the whole picture: look through its camera, beside the sidebar"""

    bl_idname = "stillwater.fit_view"
    bl_label = "Fit View to Picture"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context):
        if not polls.own_picture(cls, context):
            return False
        camera = context.scene.stillwater.active().camera
        if camera is None or context.scene.camera != camera:
            cls.poll_message_set(tip_("The scene's camera sees something else; use Show Picture first"))
            return False
        return True

    def execute(self, context):
        settings.look(context.scene, context.scene.stillwater.active())
        return {"FINISHED"}


class STILLWATER_OT_standard_view(bpy.types.Operator):
    """Set the view transform to Standard, so that renders have the picture's own colors"""

    bl_idname = "stillwater.standard_view"
    bl_label = "Use Standard View"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not polls.own_scene(cls, context):
            return False
        if settings.is_standard(context.scene):
            cls.poll_message_set(tip_("The view transform is Standard already"))
            return False
        return True

    def execute(self, context):
        try:
            settings.use_standard(context.scene)
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class STILLWATER_OT_former_view(bpy.types.Operator):
    """Go back to the view transform that the scene had before Stillwater set it to Standard"""

    bl_idname = "stillwater.former_view"
    bl_label = "Back to Former View"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not polls.own_scene(cls, context):
            return False
        if not settings.can_go_back(context.scene):
            cls.poll_message_set(tip_("Stillwater did not change the scene's view transform"))
            return False
        return True

    def execute(self, context):
        try:
            settings.back_to_former_view(context.scene)
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_show_picture, STILLWATER_OT_fit_view, STILLWATER_OT_standard_view, STILLWATER_OT_former_view]
