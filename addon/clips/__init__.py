"""The clip of a layer that looks like one. Where it lies in the scene is strokes/clip_plane.py.

    operators    choosing it, showing it
    pick         its speed at the place that is clicked
    places       which of its pixels lies under the mouse, in a viewport or an Image Editor
"""

import bpy

from . import operators, pick

CLASSES = [*operators.CLASSES, *pick.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
