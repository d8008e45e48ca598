"""Which layers an operator means, and what is done to all of them at once."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from ..properties import arrange, curves, motions
from ..ui import polls

MOTIONS = [(name, name.title(), "", icon, i) for i, (name, icon) in enumerate(motions.ICONS.items())]


def chosen(picture) -> list[int]:
    """The indices of the selected layers, front first; the active one is always among them."""
    return [i for i, layer in enumerate(picture.layers) if layer.selected or i == picture.active_layer]


class OfPicture:
    """An operator on the active picture."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return polls.own_picture(cls, context)


class OfLayers(OfPicture):
    """An operator on the selected layers."""

    @classmethod
    def poll(cls, context):
        if not super().poll(context):
            return False
        picture = context.scene.stillwater.active()
        if picture.active_layer >= len(picture.layers):
            cls.poll_message_set(tip_("Select a layer first"))
            return False
        return True


class OfSeveral(OfLayers):
    """An operator from the active layer to the others that are selected."""

    @classmethod
    def poll(cls, context):
        if not super().poll(context):
            return False
        if len(chosen(context.scene.stillwater.active())) < 2:
            cls.poll_message_set(tip_("Select more layers first, by the boxes in the list"))
            return False
        return True


class STILLWATER_OT_select_layers(OfLayers, bpy.types.Operator):
    """Select layers; the active one always stays selected"""

    bl_idname = "stillwater.select_layers"
    bl_label = "Select Layers"

    action: EnumProperty(
        name="Action", description="Which layers are selected",
        items=[
            ("SELECT", "All", "All layers"),
            ("DESELECT", "None", "Only the active layer"),
            ("INVERT", "Invert", "Those that were not selected"),
            ("MOTION", "Same Motion", "Those with the active layer's motion"),
        ],
    )

    def execute(self, context):
        picture = context.scene.stillwater.active()
        motion = picture.layers[picture.active_layer].motion.type
        for layer in picture.layers:
            layer.selected = {
                "SELECT": True, "DESELECT": False, "INVERT": not layer.selected,
                "MOTION": layer.motion.type == motion,
            }[self.action]
        picture.layers[picture.active_layer].selected = True
        return {"FINISHED"}


class STILLWATER_OT_show_layers(OfLayers, bpy.types.Operator):
    """Show or hide all selected layers"""

    bl_idname = "stillwater.show_layers"
    bl_label = "Show Layers"

    visible: BoolProperty(name="Visible", description="Show the layers, or hide them", default=True)

    @classmethod
    def description(cls, context, properties):
        return tip_("Show all selected layers") if properties.visible else tip_("Hide all selected layers")

    def execute(self, context):
        picture = context.scene.stillwater.active()
        for index in chosen(picture):
            picture.layers[index].visible = self.visible
        return {"FINISHED"}


class STILLWATER_OT_set_motion(OfLayers, bpy.types.Operator):
    """Give all selected layers a motion; the numbers that they have for it stay"""

    bl_idname = "stillwater.set_motion"
    bl_label = "Set Motion"

    type: EnumProperty(name="Motion", description="What the layers do", items=MOTIONS)

    def execute(self, context):
        picture = context.scene.stillwater.active()
        for index in chosen(picture):
            picture.layers[index].motion.type = self.type
        return {"FINISHED"}


class STILLWATER_OT_copy_to_selected(OfSeveral, bpy.types.Operator):
    """Copy a value, with its keys and its driver, to all other selected layers"""

    bl_idname = "stillwater.copy_to_selected"
    bl_label = "Copy to Selected Layers"

    path: StringProperty(
        name="Path", default="motion",
        description="Path of the value in its layer, as motion.sway.amount; motion stands for all that makes its look",
    )
    layer: IntProperty(name="Layer", description="Whose value is copied; -1 = the active one's", default=-1, min=-1)

    def execute(self, context):
        picture = context.scene.stillwater.active()
        source = self.layer if 0 <= self.layer < len(picture.layers) else picture.active_layer
        others = [index for index in chosen(picture) if index != source]
        try:
            paths = _look(picture.layers[source]) if self.path == "motion" else [self.path]
            for path in paths:
                for index in others:
                    _copy(picture, source, index, path)
        except (ValueError, AttributeError):
            self.report({"ERROR"}, rpt_("{path}: is not a value of a layer that can be copied").format(path=self.path))
            return {"CANCELLED"}
        what = "Motion" if self.path == "motion" else _kind(picture.layers[source], self.path).name
        one = len(others) == 1
        sentence = rpt_("{what} copied to 1 layer") if one else rpt_("{what} copied to {count} layers")
        self.report({"INFO"}, sentence.format(what=rpt_(what), count=len(others)))
        return {"FINISHED"}


def can_be_copied(layer, path: str) -> bool:
    """Whether a value at this path of a layer means something in another."""
    if path.split(".")[0] in arrange.OWN or "[" in path:
        return False
    kind = _kind(layer, path)
    return kind is not None and kind.type not in ("POINTER", "COLLECTION") and not kind.is_readonly


def _kind(layer, path: str):
    group, _, name = path.rpartition(".")
    return (layer.path_resolve(group) if group else layer).bl_rna.properties.get(name)


def _look(layer) -> list[str]:
    """The paths of what makes a layer's motion, but for where it is."""
    numbers = layer.motion.numbers()
    names = [name for name in type(numbers).__annotations__ if name not in motions.PLACES] if numbers else []
    return ["motion.type", *(f"motion.{layer.motion.type}.{name}" for name in names)]


def _copy(picture, source: int, target: int, path: str) -> None:
    layer = picture.layers[source]
    if not can_be_copied(layer, path):
        raise ValueError(path)
    group, _, name = path.rpartition(".")
    value = getattr(layer.path_resolve(group) if group else layer, name)
    other = picture.layers[target]
    setattr(other.path_resolve(group) if group else other, name, value)
    curves.copy(picture, source, target, path)


CLASSES = [
    STILLWATER_OT_select_layers,
    STILLWATER_OT_show_layers,
    STILLWATER_OT_set_motion,
    STILLWATER_OT_copy_to_selected,
]
