"""The panels: they show what stands in properties and on the node tree, and compute nothing."""

import bpy

from . import lists, panels

CLASSES = [*lists.CLASSES, *panels.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
