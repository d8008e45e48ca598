"""Bake, cancel, check frames."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import BoolProperty, EnumProperty, StringProperty

from .. import engine
from ..ui import polls
from . import job, outdated, ranges


class OfPicture:
    """What operators on one picture share: which, and why they are greyed out."""

    picture: StringProperty(
        name="Picture", description="Its name; empty for the active one", options={"SKIP_SAVE", "HIDDEN"}
    )

    @classmethod
    def poll(cls, context):
        if engine.problem():
            cls.poll_message_set(engine.problem())
            return False
        return polls.own_picture(cls, context)

    def chosen(self, context):
        """The picture that is meant. Throws ValueError."""
        settings = context.scene.stillwater
        if not self.picture:
            return settings.active()
        found = next((picture for picture in settings.pictures if picture.name == self.picture), None)
        if found is None:
            raise ValueError(rpt_("{picture}: the scene has no picture of this name").format(picture=self.picture))
        return found

    def execute(self, context):
        """Does it; what goes wrong is a report."""
        try:
            return self.act(context, self.chosen(context))
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, sentence_of(error))
            return {"CANCELLED"}


def sentence_of(error: Exception) -> str:
    """What an error says, without numbers that only programmers read."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    return str(error)


class STILLWATER_OT_bake(OfPicture, bpy.types.Operator):
    """Render the picture's frames in a worker process; frames that are still right are kept"""

    bl_idname = "stillwater.bake"
    bl_label = "Bake"
    bl_options = {"UNDO"}  # so that undoing a later step does not take the new tree, and with it the bake, away

    range: EnumProperty(name="Range", description="Which frames to bake", items=ranges.ITEMS, options={"SKIP_SAVE"})
    fresh: BoolProperty(name="Fresh", description="Make every frame anew", options={"SKIP_SAVE"})
    wait: BoolProperty(
        name="Wait", description="Stay until it is over, as always in background", options={"SKIP_SAVE", "HIDDEN"}
    )

    def act(self, context, picture):
        tree = job.start(context.scene, picture, self.fresh, ranges.frames_of(context, self.range))
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
    bl_label = "Cancel Bake"

    tree: StringProperty(
        name="Node", description="Whose bake; empty for the active picture's", options={"SKIP_SAVE", "HIDDEN"}
    )

    @classmethod
    def poll(cls, context):
        if not job.running_trees():
            cls.poll_message_set(tip_("Nothing is being baked"))
            return False
        return True

    def execute(self, context):
        picture = context.scene.stillwater.active()
        name = self.tree or (picture.tree.name if picture and picture.tree else "")
        found = [tree for tree in job.running_trees() if tree.name == name]
        for tree in found:
            job.cancel(tree)
        return {"FINISHED"} if found else {"CANCELLED"}


class STILLWATER_OT_check_frames(OfPicture, bpy.types.Operator):
    """Find out which frames are there and right, and why the others are out of date"""

    bl_idname = "stillwater.check_frames"
    bl_label = "Check Frames"

    def act(self, context, picture):
        found = outdated.look(context.scene, picture)
        self.report({"ERROR"} if found.problem else {"INFO"}, "; ".join(found.lines))
        return {"CANCELLED"} if found.problem else {"FINISHED"}


CLASSES = [STILLWATER_OT_bake, STILLWATER_OT_cancel, STILLWATER_OT_check_frames]
