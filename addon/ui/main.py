"""The panel that holds the others: whether the engine is there, which picture."""

from .. import engine
from . import sidebar


class _Main(sidebar.Part):
    bl_label = "Stillwater"

    def draw(self, context):
        layout, settings = self.layout, context.scene.stillwater
        if engine.problem():
            sidebar.say(context, layout, engine.problem(), "ERROR")
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


CLASSES = sidebar.in_both_editors("", _Main)
