"""A scene's pictures: from a file on disk to one that can be drawn on, and away again. Start with open_picture.py.

    place        plane, camera, strokes: where a picture lies in the scene
    scene        camera, render size, view transform, compositor: how the scene is set for it, and was before
    open_picture, open_recipe, change (resize), show, remove    what a person does
    saving       paths and frames when the .blend goes elsewhere; older files
"""

import bpy

from . import change, menus, open_picture, open_recipe, panel, remove, saving, show

CLASSES = [
    *open_picture.CLASSES, *open_recipe.CLASSES, *change.CLASSES, *show.CLASSES, *remove.CLASSES, *menus.CLASSES,
    *panel.CLASSES,
]  # fmt: skip


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for name, draw in menus.PLACES:
        getattr(bpy.types, name).append(draw)
    for name, handler in saving.HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    for name, handler in reversed(saving.HANDLERS):
        getattr(bpy.app.handlers, name).remove(handler)
    for name, draw in reversed(menus.PLACES):
        getattr(bpy.types, name).remove(draw)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
