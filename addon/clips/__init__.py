"""The clip of a layer that looks like one. Where it lies in the scene is strokes/clip_plane.py.

    operators    choosing it, showing it
    pick         its speed at the place that is clicked
    draw_source  what is taken from it, drawn on it
    editor       an Image Editor that shows it
    places       which of its pixels lies under the mouse, in a viewport or an Image Editor
"""

import bpy

from . import draw_source, editor, operators, pick

CLASSES = [*operators.CLASSES, *pick.CLASSES, *draw_source.CLASSES, *editor.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    editor.begin()


def unregister():
    editor.end()
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
