"""The list of layers, front on top."""

import bpy

from .. import strokes
from ..properties import motions
from . import missing


class STILLWATER_UL_layers(bpy.types.UIList):
    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index):
        active = index == active_data.active_layer
        row = layout.row(align=True)
        box = row.row(align=True)
        box.enabled = not active  # the active one is always selected
        box.prop(item, "selected", text="", emboss=False,
                 icon="CHECKBOX_HLT" if item.selected or active else "CHECKBOX_DEHLT")
        named = row.row(align=True)
        named.active = item.visible
        named.prop(item, "name", text="", emboss=False, icon=motions.ICONS[item.motion.type])
        if missing.of(active_data, index, strokes.replaced(context.scene, active_data, item)):
            row.label(text="", icon="ERROR")
        row.prop(item, "solo", text="", emboss=False, icon="SOLO_ON" if item.solo else "SOLO_OFF")
        row.prop(item, "visible", text="", emboss=False, icon="HIDE_OFF" if item.visible else "HIDE_ON")


CLASSES = [STILLWATER_UL_layers]
