"""Frames of files that were closed without ever being saved: they stay until somebody says that they may go."""

import shutil

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_

from . import places


class STILLWATER_OT_clear_unsaved(bpy.types.Operator):
    """Delete frames and caches of files that were closed without ever being saved. Undo does not bring them back"""

    bl_idname = "stillwater.clear_unsaved"
    bl_label = "Delete Frames of Unsaved Files"

    @classmethod
    def poll(cls, context):
        if not places.leftovers():
            cls.poll_message_set(tip_("There are none"))
            return False
        return True

    def invoke(self, context, event):
        return context.window_manager.invoke_confirm(self, event)

    def execute(self, context):
        folders = places.leftovers()
        size = sum(path.stat().st_size for folder in folders for path in folder.rglob("*") if path.is_file())
        try:
            for folder in folders:
                shutil.rmtree(folder)
        except OSError as error:
            self.report({"ERROR"}, rpt_("Not all can be deleted: {why}").format(why=error))
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("{count} folders deleted, {size} MB").format(count=len(folders), size=size // 10**6))
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_clear_unsaved]
