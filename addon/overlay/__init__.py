"""What cannot be seen in the picture itself, drawn over it in the 3D viewport. Start with shapes.py.

    water      the water's plane in the picture, by its view
    outline    the outline of a matte
    cutting    a matte while it is drawn, and what veils the rest
    shapes     the lines that are drawn, in the picture's pixels
    settings   which of them
    draw       onto the screen
"""

import bpy

from . import draw, settings

CLASSES = settings.CLASSES


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.stillwater_overlay = bpy.props.PointerProperty(type=settings.STILLWATER_PG_overlay)
    bpy.types.VIEW3D_PT_overlay.append(settings.draw)
    draw.begin()


def unregister():
    draw.end()
    bpy.types.VIEW3D_PT_overlay.remove(settings.draw)
    del bpy.types.Scene.stillwater_overlay
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
