"""What cannot be seen in the picture itself, drawn over it in the 3D viewport. Start with shapes.py.

    water      the water's plane in the picture, by its view
    outline    the outline of a matte
    cutting    a matte while it is drawn, and what veils the rest
    flow_field a flow at the size of a sketch: in colours, and as lines to draw
    flow       the flow of a layer while it is drawn
    propose    the flow that the picture proposes, as strokes
    shapes     the lines that are drawn, in the picture's pixels
    settings   which of them
    draw       onto the screen
"""

import bpy

from . import draw, flow, propose, settings

CLASSES = [*settings.CLASSES, *propose.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.stillwater_overlay = bpy.props.PointerProperty(type=settings.STILLWATER_PG_overlay)
    bpy.types.VIEW3D_PT_overlay.append(settings.draw)
    draw.begin()


def unregister():
    draw.end()
    flow.forget()
    bpy.types.VIEW3D_PT_overlay.remove(settings.draw)
    del bpy.types.Scene.stillwater_overlay
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
