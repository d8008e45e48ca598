"""The panel that holds the others: whether the engine is there, which picture."""

from bpy.app.translations import pgettext_iface as iface_

from .. import engine
from ..properties import migrate
from . import sidebar


class _Main(sidebar.Part):
    bl_label = "Stillwater"

    def draw(self, context):
        layout, settings = self.layout, context.scene.stillwater
        if engine.problem():
            sidebar.say(context, layout, engine.problem(), "ERROR")
        if migrate.newer(context.scene):
            sentence = iface_("A newer Stillwater made this scene; update to keep all of it")
            sidebar.say(context, layout, sentence, "ERROR")
        picture = settings.active()
        if picture is None:
            column = layout.column()
            column.scale_y = 1.5
            column.operator("stillwater.open_picture", icon="IMAGE_DATA")
            layout.operator("stillwater.load_recipe", icon="FILE_FOLDER")
            return
        if len(settings.pictures) > 1:
            layout.template_list("UI_UL_list", "stillwater", settings, "pictures", settings, "active_picture", rows=2)
        row = layout.row(align=True)
        row.prop(picture, "name", text="")
        row.operator("stillwater.open_picture", text="", icon="ADD")
        row.operator("stillwater.load_recipe", text="", icon="FILE_FOLDER")
        row.operator("stillwater.remove_picture", text="", icon="X")


CLASSES = sidebar.in_both_editors("", _Main)
