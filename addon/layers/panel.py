"""The list of layers, and what the active one is and does."""

from .. import strokes
from ..ui import sidebar


class _Layers(sidebar.OfPicture):
    bl_label = "Layers"
    bl_order = 1
    bl_options = set()

    def draw(self, context):
        picture = context.scene.stillwater.active()
        row = self.layout.row()
        row.template_list("STILLWATER_UL_layers", "", picture, "layers", picture, "active_layer", rows=4)
        column = row.column(align=True)
        for action, icon in (("add", "ADD"), ("remove", "REMOVE"), ("up", "TRIA_UP"), ("down", "TRIA_DOWN")):
            column.operator("stillwater.layer", text="", icon=icon).action = action
        if picture.active_layer < len(picture.layers):
            self.layout.use_property_split = True
            layer = picture.layers[picture.active_layer]
            _draw_layer(self.layout, layer, strokes.replaced(context.scene, picture, layer))


def _draw_layer(layout, layer, drawn: set[str]) -> None:
    for name in ("opacity", "feather"):
        layout.prop(layer, name)
    layout.prop(layer.follows, "layer")
    if layer.follows.layer_id:
        layout.prop(layer.follows, "mirror")
    layout.prop(layer.matte, "form")
    for name in {"file": ("file", "channel"), "labels": ("labels", "value")}.get(layer.matte.form, ()):
        layout.prop(layer.matte, name)
    layout.prop(layer.fill, "method")
    if layer.fill.method == "file":
        layout.prop(layer.fill, "file")
    layout.prop(layer.motion, "type")
    if layer.motion.type != "still":
        _draw_motion(layout, getattr(layer.motion, layer.motion.type), drawn)


def _draw_motion(layout, motion, drawn: set[str]) -> None:
    """`drawn`: the numbers that strokes stand for (panel Strokes)."""
    column = layout.column()
    for name in type(motion).__annotations__:
        if name in drawn:
            continue
        if name == "waterline":
            column.label(text=f"Waterline: {len(motion.waterline)} points")
        elif not name.endswith("_id"):
            column.prop(motion, name)


CLASSES = sidebar.in_both_editors("layers", _Layers)
