"""The roles that the active layer's and the picture's strokes have: drawn, typed or not yet, with a button each."""

import bpy
from bpy.app.translations import pgettext_iface as iface_

from ..properties import names
from ..ui import sidebar
from . import draw_mode, read, roles


class _Strokes(sidebar.OfPicture):
    bl_label = "Strokes"
    bl_order = 2
    bl_options = set()

    def draw(self, context):
        layout, picture = self.layout, context.scene.stillwater.active()
        if context.scene.stillwater.drawing.role:
            layout.operator("stillwater.stop_drawing", icon="CHECKMARK")
            sidebar.say(context, layout, draw_mode.hint(context.scene), "INFO")
            _draw_brush(layout, context.scene)
        layer = picture.layers[picture.active_layer] if picture.active_layer < len(picture.layers) else None
        column = layout.column(align=True)
        for role in [*(_offered(picture, layer) if layer else ()), *roles.of_motion("")]:
            _draw_role(context, column, picture, layer if roles.is_of_layer(role) else None, role)
        if context.mode == "EDIT_GREASE_PENCIL":
            layout.operator_menu_enum("stillwater.change_role", "role")
            if layer is not None and layer.motion.type in roles.FLUIDS:
                layout.operator("stillwater.set_flow")


def _draw_brush(layout, scene) -> None:
    """What the next stroke says of itself, beside where it goes."""
    picture, role = draw_mode.drawn(scene)
    layer = names.layer_by_id(picture, scene.stillwater.drawing.layer_id) if picture is not None else None
    if layer is not None and role.brushed:
        column = layout.column(align=True)
        column.use_property_split = True
        said = ("stroke_alpha",) if role.motion == "example" else ("stroke_speed", "stroke_local", "stroke_alpha")
        sidebar.draw(column, layer.motion.flow, *said)


def _offered(picture, layer) -> list[roles.Role]:
    """The roles that a layer has, those of its motion first, and those that would cut it out where it must be; touch-ups
    once there is a hole."""
    last = layer == picture.layers[-1]
    offered = [role for role in roles.of_layer(layer) if role.of != "fill.exemplar" or layer.matte.form != "none"]
    shown = offered if last else [role for role in roles.ROLES if role in offered or roles.begins(layer, role)]
    return sorted(shown, key=lambda role: not role.motion)


def _draw_role(context, layout, picture, layer, role: roles.Role) -> None:
    layer_id, drawing = layer.id if layer else "", context.scene.stillwater.drawing
    drawn = read.is_drawn(context.scene, picture, layer_id, role)
    known = drawn or role.is_typed(layer.motion.numbers() if layer else picture.view)
    row = layout.row(align=True)
    row.operator(
        "stillwater.draw_stroke", text=role.name, icon="CHECKMARK" if known else "GREASEPENCIL",
        depress=(drawing.role, drawing.picture_id, drawing.layer_id) == (role.key, picture.id, layer_id),
    ).role = role.key
    if drawn:
        row.operator("stillwater.delete_strokes", text="", icon="X").role = role.key


class STILLWATER_TL_stroke(bpy.types.WorkSpaceTool):
    bl_space_type = "VIEW_3D"
    bl_context_mode = draw_mode.MODE
    bl_idname = draw_mode.TOOL
    bl_label = "Stillwater Stroke"
    bl_description = "Draw with Blender's brush on the picture. The role's button in the sidebar says what a stroke is"
    bl_icon = "brush.generic"
    bl_options = {"USE_BRUSHES"}

    def draw_settings(context, layout, tool):
        hint = draw_mode.hint(context.scene)
        text = hint or iface_("Choose what to draw in the sidebar, tab Stillwater")
        if context.region.type == "TOOL_HEADER":
            layout.label(text=text, icon="INFO")
        else:
            sidebar.say(context, layout, text, "INFO")
        if hint:
            layout.operator("stillwater.stop_drawing", icon="CHECKMARK")


CLASSES = sidebar.in_viewport("strokes", _Strokes)
