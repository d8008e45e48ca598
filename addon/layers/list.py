"""The list of layers and what changes it."""

import bpy
from bpy.props import EnumProperty

from .. import strokes
from ..properties import arrange

ICONS = {"still": "PINNED", "sway": "FORCE_WIND", "ripple": "MOD_OCEAN", "bob": "MOD_WAVE", "drift": "OUTLINER_OB_VOLUME"}


class STILLWATER_UL_layers(bpy.types.UIList):
    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index):
        layout.prop(item, "name", text="", emboss=False, icon=ICONS[item.motion.type])
        layout.prop(item, "visible", text="", emboss=False, icon="HIDE_OFF" if item.visible else "HIDE_ON")


class STILLWATER_OT_layer(bpy.types.Operator):
    """Change the active picture's list of layers"""

    bl_idname = "stillwater.layer"
    bl_label = "Layers"
    bl_options = {"REGISTER", "UNDO"}

    action: EnumProperty(
        name="Action",
        items=[
            ("add", "Add", "A new layer before the active one"),
            ("remove", "Remove", "The active layer"),
            ("up", "Forward", "The active layer towards the viewer"),
            ("down", "Back", "The active layer away from the viewer"),
        ],
    )

    @classmethod
    def poll(cls, context):
        return context.scene.stillwater.active() is not None

    def execute(self, context):
        picture = context.scene.stillwater.active()
        index, count = picture.active_layer, len(picture.layers)
        match self.action:
            case "add":
                arrange.add_layer(picture, "Layer" if count else "Background")
                arrange.move_layer(picture, count, min(index, count))
                to = index
            case "remove" if index < count:
                strokes.remove_roles(picture, picture.layers[index].id)
                arrange.remove_layer(picture, index)
                to = index - 1 if index == count - 1 else index
            case "up" if 0 < index < count:
                to = index - 1
                arrange.move_layer(picture, index, to)
            case "down" if index < count - 1:
                to = index + 1
                arrange.move_layer(picture, index, to)
            case _:
                return {"CANCELLED"}
        picture.active_layer = max(0, to)
        return {"FINISHED"}


CLASSES = [STILLWATER_UL_layers, STILLWATER_OT_layer]
