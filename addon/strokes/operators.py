"""Draw strokes of a role, give strokes another role, delete them."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from ..ui import polls
from . import brush, change, draw_mode, gp_layers, roles

ITEMS = [(role.key, role.name, role.hint, role.icon, role.number) for role in roles.ROLES]


class OfRole:
    """An operator about one role of one layer."""

    bl_options = {"REGISTER", "UNDO"}

    role: EnumProperty(name="Role", description="What the strokes say", items=ITEMS, options={"SKIP_SAVE"})
    layer: StringProperty(name="Layer", description="Its name; empty = the active one", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        return polls.own_picture(cls, context) and polls.on_a_plane(cls, context)

    def execute(self, context):
        picture, role = context.scene.stillwater.active(), roles.by_key(self.role)
        try:
            return self.do(context, picture, self.layer_of(picture, role), role)
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

    def layer_of(self, picture, role: roles.Role):
        """The layer that is meant; None for a role of the picture itself. Throws ValueError where none has it."""
        if not roles.is_of_layer(role):
            return None
        index = picture.layers.find(self.layer) if self.layer else picture.active_layer
        if not 0 <= index < len(picture.layers):
            sentence = rpt_("{layer}: {picture} has no such layer")
            raise ValueError(sentence.format(layer=self.layer or rpt_("Active layer"), picture=picture.name))
        layer = picture.layers[index]
        if not roles.has(layer, role) and not roles.begins(layer, role):
            raise ValueError(_not_its_role(layer, role))
        return layer


def _not_its_role(layer, role: roles.Role) -> str:
    what, _, form = role.of.partition(".")
    if not what:
        sentence = rpt_("{layer}: only a layer with the motion {motion} has a {role}")
        return sentence.format(layer=layer.name, motion=rpt_(role.motion.title()), role=rpt_(role.name))
    if what == "fill" or layer.fill.method != "exemplar" and what == "source":
        sentence = rpt_("{layer}: only a layer whose Fill is Exemplar has a {role}")
        return sentence.format(layer=layer.name, role=rpt_(role.name))
    group = layer.matte if what == "matte" else layer.fill.source
    kind = group.bl_rna.properties["form"].enum_items[form].name
    sentence = rpt_("{layer}: only a layer whose {what} is {kind} has a {role}")
    named = {"matte": rpt_("Matte"), "source": rpt_("Source")}[what]
    return sentence.format(layer=layer.name, what=named, kind=rpt_(kind), role=rpt_(role.name))


class STILLWATER_OT_draw_stroke(OfRole, bpy.types.Operator):
    """Draw on the picture; what a stroke says stands in the status bar"""

    bl_idname = "stillwater.draw_stroke"
    bl_label = "Draw Stroke"
    bl_property = "role"

    @classmethod
    def description(cls, context, properties):
        return tip_(roles.by_key(properties.role).hint)

    def invoke(self, context, event):
        if self.properties.is_property_set("role"):
            return self.execute(context)
        context.window_manager.invoke_search_popup(self)
        return {"RUNNING_MODAL"}

    def do(self, context, picture, layer, role):
        if layer is not None:
            roles.begin(layer, role)
        draw_mode.enter(context, picture, layer, role)
        if role.of.startswith("fill."):  # that is where it is seen
            context.scene.stillwater_live.view = "behind"
        return {"FINISHED"}


class STILLWATER_OT_stop_drawing(bpy.types.Operator):
    """Leave draw mode; of a role that takes one stroke the last drawn stays"""

    bl_idname = "stillwater.stop_drawing"
    bl_label = "Done"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not context.scene.stillwater.drawing.role:
            cls.poll_message_set(tip_("No Stillwater stroke is being drawn"))
            return False
        return True

    def execute(self, context):
        draw_mode.finish(context.scene)
        return {"FINISHED"}


def in_edit_mode(cls, context) -> bool:
    """Whether strokes of the picture can be selected; the sentence why not is the operator's."""
    if context.mode != "EDIT_GREASE_PENCIL" or context.object != context.scene.stillwater.active().strokes:
        cls.poll_message_set(tip_("Select strokes of the picture in edit mode first"))
        return False
    return True


class STILLWATER_OT_change_role(OfRole, bpy.types.Operator):
    """Give the selected strokes another role or layer"""

    bl_idname = "stillwater.change_role"
    bl_label = "Change Role"
    bl_property = "role"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and in_edit_mode(cls, context)

    def do(self, context, picture, layer, role):
        if layer is not None:
            roles.begin(layer, role)
        part = gp_layers.ensure(picture, layer.id if layer else "", role)
        if part.hide or part.lock:
            raise ValueError(rpt_("{name}: is hidden or locked; show and unlock it first").format(name=part.name))
        return change.move_selected(context, picture, part, role)


class STILLWATER_OT_delete_strokes(OfRole, bpy.types.Operator):
    """Delete all strokes of this role"""

    bl_idname = "stillwater.delete_strokes"
    bl_label = "Delete Strokes"

    def do(self, context, picture, layer, role):
        drawings = [
            key.drawing
            for part in gp_layers.of(picture, layer.id if layer else "", role)
            for key in part.frames
            if len(key.drawing.curve_offsets) > 1
        ]
        for drawing in drawings:
            drawing.remove_strokes()
        return {"FINISHED"} if drawings else {"CANCELLED"}


class STILLWATER_OT_set_flow(bpy.types.Operator):
    """Give the selected strokes another speed and weight"""

    bl_idname = "stillwater.set_flow"
    bl_label = "Set Flow of Strokes"
    bl_options = {"REGISTER", "UNDO"}

    speed: FloatProperty(
        name="Speed", description="Speed that the strokes say [px/frame]", default=2, min=0, max=1000, soft_max=20
    )
    local: BoolProperty(name="Local", description="The strokes change only what is near them")
    alpha: FloatProperty(
        name="Weight", description="How strongly the strokes count against the others (0..1)", subtype="FACTOR",
        default=1, min=0, max=1,
    )

    @classmethod
    def poll(cls, context):
        return polls.own_picture(cls, context) and in_edit_mode(cls, context)

    def invoke(self, context, event):
        picture = context.scene.stillwater.active()
        if picture.active_layer < len(picture.layers):
            said = brush.of_layer(picture.layers[picture.active_layer].motion.flow)
            self.speed, self.local, self.alpha = said["speed"], said["local"], said["alpha"]
        return self.execute(context)

    def execute(self, context):
        said = {"speed": self.speed, "local": self.local, "alpha": self.alpha}
        if not change.set_flow(context, context.scene.stillwater.active(), said):
            self.report({"ERROR"}, rpt_("No selected stroke says how something flows"))
            return {"CANCELLED"}
        return {"FINISHED"}


CLASSES = [
    STILLWATER_OT_draw_stroke,
    STILLWATER_OT_stop_drawing,
    STILLWATER_OT_change_role,
    STILLWATER_OT_delete_strokes,
    STILLWATER_OT_set_flow,
]
