"""A boat's waterline, point by point; drawing it is easier."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import FloatVectorProperty, IntProperty

from ..properties.motions import FAR
from .selection import OfLayers


class OfBoat(OfLayers):
    """An operator on the waterline of the active layer."""

    @classmethod
    def poll(cls, context):
        if not super().poll(context):
            return False
        picture = context.scene.stillwater.active()
        if picture.layers[picture.active_layer].motion.type != "bob":
            cls.poll_message_set(tip_("Select a layer with the motion Bob first"))
            return False
        return True

    @staticmethod
    def line(context):
        picture = context.scene.stillwater.active()
        return picture.layers[picture.active_layer].motion.bob.waterline


class STILLWATER_OT_add_waterline_point(OfBoat, bpy.types.Operator):
    """Add a point at the end of the active layer's waterline"""

    bl_idname = "stillwater.add_waterline_point"
    bl_label = "Add Waterline Point"

    place: FloatVectorProperty(
        name="Place", description="px from the picture's top left corner, y down", size=2, subtype="XYZ",
        min=-FAR, max=FAR, precision=1,
    )

    def invoke(self, context, event):
        line = self.line(context)
        self.place = line[-1].place if len(line) else (0, 0)
        return self.execute(context)

    def execute(self, context):
        self.line(context).add().place = self.place
        return {"FINISHED"}


class STILLWATER_OT_remove_waterline_point(OfBoat, bpy.types.Operator):
    """Remove a point of the active layer's waterline"""

    bl_idname = "stillwater.remove_waterline_point"
    bl_label = "Remove Waterline Point"

    index: IntProperty(name="Index", description="Number of the point; -1 = the last one", default=-1, min=-1)

    def execute(self, context):
        line = self.line(context)
        index = self.index if self.index >= 0 else len(line) - 1
        if not 0 <= index < len(line):
            sentence = rpt_("The waterline has {count} points, and none with the index {index}")
            self.report({"WARNING"}, sentence.format(count=len(line), index=self.index))
            return {"CANCELLED"}
        line.remove(index)
        return {"FINISHED"}


class STILLWATER_OT_clear_waterline(OfBoat, bpy.types.Operator):
    """Remove all points of the active layer's waterline"""

    bl_idname = "stillwater.clear_waterline"
    bl_label = "Clear Waterline"

    def execute(self, context):
        self.line(context).clear()
        return {"FINISHED"}


CLASSES = [
    STILLWATER_OT_add_waterline_point,
    STILLWATER_OT_remove_waterline_point,
    STILLWATER_OT_clear_waterline,
]
