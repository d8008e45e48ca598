"""The picture itself: its file, its size, its colours."""

import os

from bpy.app.translations import pgettext_iface as iface_

from ..ui import sidebar
from . import place
from . import scene as settings


class _Picture(sidebar.OfPicture):
    bl_label = "Picture"
    bl_order = 0
    bl_options = set()

    def draw_header_preset(self, context):
        row = self.layout.row()
        row.emboss = "NONE"
        row.operator("stillwater.fit_view", text="", icon="HOME")

    def draw(self, context):
        layout, scene = self.layout, context.scene
        picture = scene.stillwater.active()
        _file(context, layout, picture)
        if not place.is_whole(scene, picture):
            layout.operator("stillwater.show_picture", text="Set Up in Scene", icon="OUTLINER_OB_IMAGE")
        elif scene.camera != picture.camera:
            layout.operator("stillwater.show_picture", icon="VIEW_CAMERA")
        _colours(context, layout, scene)


def _file(context, layout, picture) -> None:
    row = layout.row(align=True)
    name = os.path.basename(picture.picture.replace("\\", "/")) or iface_("No file")
    size = iface_("{width} x {height} px").format(width=picture.picture_size[0], height=picture.picture_size[1])
    row.label(text=f"{name}, {size}" if picture.picture_size[0] else name, icon="IMAGE_DATA")
    row.operator("stillwater.replace_picture", text="", icon="FILE_FOLDER")
    row.operator("stillwater.reload_picture", text="", icon="FILE_REFRESH")
    if picture.missing:
        sidebar.say(context, layout, iface_("{path} is not there").format(path=picture.picture), "ERROR")
        layout.operator("stillwater.replace_picture", text="Find Picture", icon="VIEWZOOM")
    layout.use_property_split = True
    layout.prop(picture, "colour_space")


def _colours(context, layout, scene) -> None:
    former = scene.stillwater.former.view_transform
    if not settings.is_standard(scene):
        sentence = iface_("View transform {name}: renders differ from the picture's own colors")
        sidebar.say(context, layout, sentence.format(name=scene.view_settings.view_transform), "INFO")
        layout.operator("stillwater.standard_view", icon="COLOR")
    elif settings.can_go_back(scene):
        sidebar.say(context, layout, iface_("View transform Standard: renders equal the picture"), "COLOR")
        layout.operator("stillwater.former_view", text=iface_("Back to {name}").format(name=former), icon="LOOP_BACK")


CLASSES = sidebar.in_both_editors("picture", _Picture)
