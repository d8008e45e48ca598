"""A scene's pictures: new ones, and ones to be removed."""

import bpy

from ..properties import arrange


class STILLWATER_OT_add_picture(bpy.types.Operator):
    """Add an empty picture to the scene"""

    bl_idname = "stillwater.add_picture"
    bl_label = "New Picture"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        picture = arrange.add_picture(context.scene, "Picture")
        arrange.add_layer(picture, "Background")
        return {"FINISHED"}


class STILLWATER_OT_remove_picture(bpy.types.Operator):
    """Remove the active picture from the scene; its frames and its node stay"""

    bl_idname = "stillwater.remove_picture"
    bl_label = "Remove Picture"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.scene.stillwater.active() is not None

    def execute(self, context):
        arrange.remove_picture(context.scene, context.scene.stillwater.active_picture)
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_add_picture, STILLWATER_OT_remove_picture]
