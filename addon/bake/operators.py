"""Bake, cancel, open a recipe."""

from pathlib import Path

import bpy
from bpy.props import BoolProperty, StringProperty

from .. import engine
from . import job, open_recipe


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


class STILLWATER_OT_load_recipe(bpy.types.Operator):
    """Open a recipe as a picture of this scene, with its size, frames, frame rate and compositor"""

    bl_idname = "stillwater.load_recipe"
    bl_label = "Open Recipe"
    bl_options = {"REGISTER", "UNDO"}

    filepath: StringProperty(name="Recipe", subtype="FILE_PATH", options={"SKIP_SAVE"})
    filter_glob: StringProperty(default="*.json", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        if engine.problem():
            cls.poll_message_set(engine.problem())
            return False
        return True

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            open_recipe.open_recipe(context.scene, Path(bpy.path.abspath(self.filepath)))
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_bake, STILLWATER_OT_cancel, STILLWATER_OT_load_recipe]
