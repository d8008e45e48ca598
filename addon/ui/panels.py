"""The same panels in the 3D viewport's sidebar and in the compositor's."""

import textwrap

import bpy

from .. import engine

# Of a sidebar at scale 1, pixels: what its tabs and an icon take, a character on average, its width by default.
BESIDE, CHARACTER, WIDTH = 85, 6.3, 280


class _Sidebar:
    bl_category = "Stillwater"
    bl_region_type = "UI"


    @classmethod
    def poll(cls, context):
        """In node editors only where they show a compositor."""
        return getattr(context.space_data, "tree_type", "CompositorNodeTree") == "CompositorNodeTree"


class _Main(_Sidebar):
    bl_label = "Stillwater"

    def draw(self, context):
        layout, settings = self.layout, context.scene.stillwater
        if engine.problem():
            _say(context, layout, engine.problem(), "ERROR")
        else:
            layout.label(text=f"Engine {engine.version()}", icon="CHECKMARK")
        row = layout.row(align=True)
        row.operator("stillwater.add_picture", icon="ADD")
        row.operator("stillwater.load_recipe", icon="FILE_FOLDER")
        picture = settings.active()
        if picture is None:
            return
        row = layout.row(align=True)
        row.prop(picture, "name", text="")
        if len(settings.pictures) > 1:
            row.prop(settings, "active_picture", text="")
        row.operator("stillwater.remove_picture", text="", icon="X")
        layout.prop(picture, "picture")
        _draw_bake(context, layout, picture)


def _draw_bake(context, layout, picture) -> None:
    state = picture.tree.stillwater if picture.tree else None
    if state is not None and state.state == "running":
        row = layout.row(align=True)
        row.progress(factor=state.share, text=state.message)
        row.operator("stillwater.cancel", text="", icon="X")
    else:
        layout.operator("stillwater.bake", icon="RENDER_ANIMATION")
        if state is not None and state.message:
            _say(context, layout, state.message, "ERROR" if state.state == "failed" else "INFO")
    if state is not None:
        for warning in filter(None, state.warning.split("\n")):
            _say(context, layout, warning, "ERROR")
        layout.operator("stillwater.refresh", icon="FILE_REFRESH")


def _say(context, layout, sentence: str, icon: str) -> None:
    """A sentence over as many lines as the sidebar's width asks for; Blender would cut it off."""
    width = context.region.width / context.preferences.system.ui_scale if context.region else WIDTH
    column = layout.column(align=True)
    for line in textwrap.wrap(sentence, max(12, int((width - BESIDE) / CHARACTER))):
        column.label(text=line, icon=icon)
        icon = "BLANK1"


class _OfPicture(_Sidebar):
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.scene.stillwater.active() is not None


class _Layers(_OfPicture):
    bl_label = "Layers"
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
            _draw_layer(self.layout, picture.layers[picture.active_layer])


def _draw_layer(layout, layer) -> None:
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
        _draw_motion(layout, getattr(layer.motion, layer.motion.type))


def _draw_motion(layout, motion) -> None:
    column = layout.column()
    for name in type(motion).__annotations__:
        if name == "waterline":
            column.label(text=f"Waterline: {len(motion.waterline)} points")
        elif not name.endswith("_id"):
            column.prop(motion, name)


class _Wind(_OfPicture):
    bl_label = "Wind"

    def draw(self, context):
        _draw_all(self.layout, context.scene.stillwater.active().wind)


class _View(_OfPicture):
    bl_label = "View"

    def draw(self, context):
        _draw_all(self.layout, context.scene.stillwater.active().view)


class _Frames(_OfPicture):
    bl_label = "Output"

    def draw(self, context):
        picture = context.scene.stillwater.active()
        self.layout.use_property_split = True
        for name in ("colour_space", "seed", "loop"):
            self.layout.prop(picture, name)
        _draw_all(self.layout, picture.output)


def _draw_all(layout, group) -> None:
    layout.use_property_split = True
    column = layout.column()
    for name in type(group).__annotations__:
        column.prop(group, name)


def _panels(space: str) -> list[type]:
    """The panels of one editor, the main one first."""
    parent = f"STILLWATER_PT_{space.lower()}"
    parts = {"": _Main, "_layers": _Layers, "_wind": _Wind, "_view": _View, "_output": _Frames}
    return [
        type(
            parent + name,
            (part, bpy.types.Panel),
            {"bl_space_type": space, **({"bl_parent_id": parent} if name else {})},
        )
        for name, part in parts.items()
    ]


CLASSES = [*_panels("VIEW_3D"), *_panels("NODE_EDITOR")]
