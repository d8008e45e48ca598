"""From a line drawn around something to a layer that moves: its name and motion first, then one stroke."""

import bpy

from .. import strokes
from ..properties import arrange, motions
from ..strokes import draw_mode, roles
from ..ui import polls
from . import order, placing, preset_files

OUTLINE = "outline"


class STILLWATER_OT_layer_from_outline(order.OfMotion, bpy.types.Operator):
    """Add a layer with this motion, and draw its outline on the picture: one line around it, and it moves"""

    bl_idname = "stillwater.layer_from_outline"
    bl_label = "New Layer from Outline"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and polls.on_a_plane(cls, context)

    def execute(self, context):
        picture = context.scene.stillwater.active()
        try:
            layer = order.new_layer(picture, self.motion, self.preset)
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        layer.matte.form = "lasso"
        try:
            draw_mode.enter(context, picture, layer, roles.by_key(OUTLINE))
        except ValueError as error:
            arrange.remove_layers(picture, [picture.active_layer])
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        context.scene.stillwater.drawing.new_layer = True
        return {"FINISHED"}


class STILLWATER_MT_layer_from_outline(bpy.types.Menu):
    bl_label = "New Layer from Outline"

    def draw(self, context):
        layout = self.layout
        layout.operator_context = "EXEC_DEFAULT"
        name = "stillwater.layer_from_outline"
        for kind in preset_files.KINDS[:-1]:
            icon = motions.ICONS[kind]
            for path in preset_files.paths(kind):
                added = layout.operator(name, text=preset_files.name_of(path), icon=icon)
                added.motion, added.preset = kind, str(path)
                icon = "BLANK1"
            layout.separator()
        layout.operator(name, text="Still", icon=motions.ICONS["still"]).motion = "still"


def place(scene, picture, layer, role: roles.Role) -> None:
    """Once the outline is drawn: what the layer's motion misses is taken from it. The artist draws it anew to change it.

    Nothing where it can't be read: the panel says what is missing.
    """
    try:
        outline = strokes.drawn(scene, picture)(layer.id, OUTLINE) if role.key == OUTLINE else None
    except ValueError:
        return
    drawn = strokes.replaced(scene, picture, layer)
    motion, view = layer.motion, picture.view
    match motion.type if outline else "":
        case "sway" if "armature_tip" not in drawn and tuple(motion.sway.armature_root) == tuple(motion.sway.armature_tip):
            motion.sway.armature_root, motion.sway.armature_tip = placing.sway_line(outline)
        case "bob" if "waterline" not in drawn and len(motion.bob.waterline) == 0:
            for point in placing.waterline(outline):
                motion.bob.waterline.add().place = point
        case "ripple" if "use_horizon" not in drawn and not view.use_horizon:
            view.horizon_start, view.horizon_end = placing.horizon(outline, picture.picture_size[0])
            view.use_horizon = True


CLASSES = [STILLWATER_OT_layer_from_outline, STILLWATER_MT_layer_from_outline]
