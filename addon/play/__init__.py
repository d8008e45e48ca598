"""The picture in motion in the viewport, with no bake. Start with stage.py.

    settings   what a scene shows of its pictures
    recipes    the recipe as the scene has it now
    server     the process that prepares what takes longer
    plane      pixels onto the picture's plane, and away again
    stage      one picture: its recipe, its frames, what is missing
    show       all pictures of a scene at its frame
    handlers   when: frames, sliders, undo, files
    panel      what of it is said
"""

import bpy

from . import handlers, panel, settings

CLASSES = [*settings.CLASSES, *panel.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.stillwater_live = bpy.props.PointerProperty(type=settings.STILLWATER_PG_live)
    handlers.register()


def unregister():
    handlers.unregister()
    del bpy.types.Scene.stillwater_live
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
