"""A scene's pictures: from a file on disk to one that can be drawn on, and away again."""

import bpy

from . import operators

CLASSES = [*operators.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
