"""The list of layers with what the active one still misses; and, below the strokes, what it is and does."""

from bpy.app.translations import pgettext_iface as iface_

from .. import strokes
from ..ui import sidebar
from . import missing, panel_flow, selection
from .presets import STILLWATER_PT_motion_presets


class _Layers(sidebar.OfPicture):
    bl_label = "Layers"
    bl_order = 1
    bl_options = set()

    def draw(self, context):
        picture = context.scene.stillwater.active()
        _draw_list(self.layout, picture)
        self.layout.menu("STILLWATER_MT_layer_from_outline", icon="MOD_OUTLINE")
        if picture.active_layer >= len(picture.layers):
            sidebar.say(context, self.layout, iface_("Add a layer for each part of the picture that moves"), "INFO")
            return
        selected = selection.chosen(picture)
        if len(selected) > 1:
            _draw_selection(self.layout, len(selected))
        layer = picture.layers[picture.active_layer]
        drawn = strokes.replaced(context.scene, picture, layer)
        for sentence in [*missing.of(picture, picture.active_layer, drawn), *strokes.unpaired(context.scene, picture, layer)]:
            sidebar.say(context, self.layout, iface_(sentence), "ERROR")


class _Layer(sidebar.OfPicture):
    bl_label = "Layer"
    bl_order = 3
    bl_options = set()

    @classmethod
    def poll(cls, context):
        picture = context.scene.stillwater.active()
        return super().poll(context) and picture.active_layer < len(picture.layers)

    def draw(self, context):
        picture = context.scene.stillwater.active()
        layer = picture.layers[picture.active_layer]
        self.layout.use_property_split = True
        self.layout.use_property_decorate = True
        _draw_layer(self.layout, layer, strokes.replaced(context.scene, picture, layer))


def _draw_list(layout, picture) -> None:
    row = layout.row()
    row.template_list("STILLWATER_UL_layers", "", picture, "layers", picture, "active_layer", rows=4)
    column = row.column(align=True)
    column.menu("STILLWATER_MT_add_layer", text="", icon="ADD")
    column.operator("stillwater.remove_layer", text="", icon="REMOVE")
    column.separator()
    column.menu("STILLWATER_MT_layers", text="", icon="DOWNARROW_HLT")
    column.separator()
    for direction, icon in (("UP", "TRIA_UP"), ("DOWN", "TRIA_DOWN")):
        column.operator("stillwater.move_layer", text="", icon=icon).direction = direction


def _draw_selection(layout, count: int) -> None:
    box = layout.box().column(align=True)
    box.label(text=iface_("{count} layers are selected").format(count=count), icon="CHECKBOX_HLT")
    row = box.row(align=True)
    row.operator("stillwater.show_layers", text="Show", icon="HIDE_OFF").visible = True
    row.operator("stillwater.show_layers", text="Hide", icon="HIDE_ON").visible = False
    row = box.row(align=True)
    row.menu("STILLWATER_MT_motion")
    row.operator("stillwater.copy_to_selected", text="Copy Motion", icon="COPYDOWN").path = "motion"


def _draw_layer(layout, layer, drawn: set[str]) -> None:
    """`drawn`: the numbers that strokes stand for; they are not shown."""
    layout.prop(layer.motion, "type")
    if layer.motion.numbers() is not None:
        STILLWATER_PT_motion_presets.draw_button(layout, "Presets")
        if layer.motion.type == "example":
            panel_flow.draw_example(layout, layer.motion, drawn)
        else:
            DRAWN[layer.motion.type](layout, layer.motion.numbers(), drawn)
    _draw_matte(layout, layer)
    _draw_fill(layout, layer)
    _draw_rest(layout, layer)


def _draw_sway(layout, sway, drawn: set[str]) -> None:
    sidebar.draw(layout, sway, "amount", "frequency", "shimmer")
    if details := sidebar.fold(layout, "stillwater_sway", "Details"):
        sidebar.draw(details, sway, "foreshortening", "mass", "damping", "seed")
        if "armature_tip" not in drawn:
            sidebar.draw(details, sway, "armature_root", "armature_tip")


def _draw_ripple(layout, ripple, drawn: set[str]) -> None:
    sidebar.draw(layout, ripple, "mode", "amplitude", "tile")
    if details := sidebar.fold(layout, "stillwater_ripple", "Details"):
        sidebar.draw(details, ripple, "roughness", "resolution")
        by = {"jonswap": ("fetch",), "tma": ("fetch", "depth")}.get(ripple.spectrum, ())
        sidebar.draw(details, ripple, "spectrum", *by)
        sidebar.draw(details, ripple, "seed")


def _draw_bob(layout, bob, drawn: set[str]) -> None:
    sidebar.draw(layout, bob, "water", "amount")
    if "waterline" in drawn:
        return
    line = sidebar.fold(layout, "stillwater_waterline", "Details")
    if line is None:
        return
    line.use_property_split = False
    line.label(text=iface_("Waterline of {count} points").format(count=len(bob.waterline)))
    column = line.column(align=True)
    for i, point in enumerate(bob.waterline):
        row = column.row(align=True)
        row.prop(point, "place", text="")
        row.operator("stillwater.remove_waterline_point", text="", icon="X").index = i
    row = line.row(align=True)
    row.operator("stillwater.add_waterline_point", text="Add Point", icon="ADD")
    row.operator("stillwater.clear_waterline", text="Clear", icon="TRASH")


def _draw_drift(layout, drift, drawn: set[str]) -> None:
    sidebar.draw(layout, drift, "use_velocity")
    sidebar.draw(layout, drift, "velocity" if drift.use_velocity else "wind")


DRAWN = {"sway": _draw_sway, "ripple": _draw_ripple, "bob": _draw_bob, "drift": _draw_drift, "flow": panel_flow.draw}
NUMBERS = {
    "file": ("file", "channel"), "labels": ("labels", "value"), "trimap": ("trimap", "method"),
    "scribbles": ("method",), "lasso": ("feather", "snap", "method"),
}  # fmt: skip


def _draw_matte(layout, layer) -> None:
    if part := sidebar.fold(layout, "stillwater_matte", "Matte", closed=False):
        sidebar.draw(part, layer.matte, "form", *NUMBERS.get(layer.matte.form, ()))
        sidebar.draw(part, layer, "feather")


def _draw_fill(layout, layer) -> None:
    part = sidebar.fold(layout, "stillwater_fill", "Behind")
    if part is None:
        return
    fill = layer.fill
    sidebar.draw(part, fill, "method", *{"file": ("file",), "exemplar": ("patch", "radius", "grow")}.get(fill.method, ()))
    if fill.method == "exemplar":
        sidebar.draw(part, fill, "touch_up_radius", "touch_up_seed")
        column = part.column(align=True)
        column.prop(fill.source, "form", text="Source")
        sidebar.draw(column, fill.source, *NUMBERS.get(fill.source.form, ()))


def _draw_rest(layout, layer) -> None:
    if part := sidebar.fold(layout, "stillwater_rest", "Blending and Following"):
        sidebar.draw(part, layer, "opacity")
        sidebar.draw(part, layer.follows, "layer", *(("mirror",) if layer.follows.layer_id else ()))


CLASSES = [*sidebar.in_both_editors("layers", _Layers), *sidebar.in_both_editors("layer", _Layer)]
