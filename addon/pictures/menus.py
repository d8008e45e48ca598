"""Where pictures are found besides the sidebar: File > Import, Add > Image, Object and its right-click menu."""

import bpy

from . import place


class STILLWATER_MT_picture(bpy.types.Menu):
    """What can be done with the active picture."""

    bl_label = "Stillwater"

    def draw(self, context):
        layout = self.layout
        layout.operator("stillwater.open_picture", text="Open Picture...", icon="IMAGE_DATA")
        layout.operator("stillwater.load_recipe", text="Open Recipe...", icon="FILE_FOLDER")
        layout.separator()
        layout.operator("stillwater.show_picture", icon="VIEW_CAMERA")
        layout.operator("stillwater.fit_view", icon="HOME")
        layout.operator("stillwater.replace_picture", text="Replace Picture...", icon="FILE_FOLDER")
        layout.operator("stillwater.reload_picture", icon="FILE_REFRESH")
        layout.separator()
        layout.operator("stillwater.standard_view", icon="COLOR")
        layout.operator("stillwater.former_view", icon="LOOP_BACK")
        layout.separator()
        layout.operator("stillwater.remove_picture", icon="X")
        layout.operator("stillwater.remove_picture", text="Remove Picture and Delete Its Files...").delete_files = True


def _import(self, context):
    self.layout.operator("stillwater.open_picture", text="Stillwater Picture")
    self.layout.operator("stillwater.load_recipe", text="Stillwater Recipe (.json)")


def _add(self, context):
    self.layout.operator("stillwater.open_picture", text="Stillwater Picture...", icon="IMAGE_DATA")


def _object(self, context):
    self.layout.separator()
    self.layout.menu("STILLWATER_MT_picture")


def _context(self, context):
    """On an object that was made for a picture: what can be done with that picture."""
    pictures = context.scene.stillwater.pictures
    hit = next((i for i, picture in enumerate(pictures) if context.object in place.parts(picture)), None)
    if hit is None:
        return
    self.layout.separator()
    if hit == context.scene.stillwater.active_picture:
        self.layout.menu("STILLWATER_MT_picture")
    else:
        self.layout.operator("stillwater.show_picture", icon="VIEW_CAMERA").index = hit


CLASSES = [STILLWATER_MT_picture]
PLACES = [
    ("TOPBAR_MT_file_import", _import),
    ("VIEW3D_MT_image_add", _add),
    ("VIEW3D_MT_object", _object),
    ("VIEW3D_MT_object_context_menu", _context),
]
