"""The list of layers, what each does, and the wind and view that they share."""

import bpy

from . import list, panel, wind_and_view

CLASSES = [*list.CLASSES, *panel.CLASSES, *wind_and_view.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
