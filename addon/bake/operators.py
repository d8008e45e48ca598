"""Bake, cancel."""

import bpy
from bpy.props import BoolProperty

from .. import engine
from . import job


class STILLWATER_OT_bake(bpy.types.Operator):
    """Render the active picture's frames in a worker process; frames that are still right are kept"""

    bl_idname = "stillwater.bake"
    bl_label = "Bake"
    bl_options = {"UNDO"}  # so that undoing a later step does not take the new tree, and with it the bake, away

    fresh: BoolProperty(name="Fresh", description="Make every frame anew", options={"SKIP_SAVE"})
    wait: BoolProperty(
        name="Wait", description="Stay until it is over, as always in background", options={"SKIP_SAVE", "HIDDEN"}
    )

    @classmethod
    def poll(cls, context):
        if engine.problem():
            cls.poll_message_set(engine.problem())
        elif context.scene.stillwater.active() is None:
            cls.poll_message_set("The scene has no Stillwater picture yet")
        else:
            return True
        return False

    def execute(self, context):
        scene = context.scene
        try:
            tree = job.start(scene, scene.stillwater.active(), self.fresh)
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if self.wait or bpy.app.background:
            job.wait(tree)
            return self._tell(tree.stillwater)
        return {"FINISHED"}

    def _tell(self, state):
        if state.warning:
            self.report({"WARNING"}, state.warning)
        if state.state != "done":
            self.report({"ERROR"}, state.message)
            return {"CANCELLED"}
        self.report({"INFO"}, state.message)
        return {"FINISHED"}


class STILLWATER_OT_cancel(bpy.types.Operator):
    """End the bake; the frames made so far are kept"""

    bl_idname = "stillwater.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, context):
        picture = context.scene.stillwater.active()
        return picture is not None and picture.tree is not None and job.running(picture.tree)

    def execute(self, context):
        job.cancel(context.scene.stillwater.active().tree)
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_bake, STILLWATER_OT_cancel]
