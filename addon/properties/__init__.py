"""What the artist says, kept in the .blend: Scene.stillwater.pictures[i].layers[j], named as in the recipe."""

import bpy

from . import cut_out, drawing, layer, motions, picture

CLASSES = [*motions.CLASSES, *cut_out.CLASSES, *layer.CLASSES, *drawing.CLASSES, *picture.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.stillwater = bpy.props.PointerProperty(type=picture.STILLWATER_PG_scene)


def unregister():
    del bpy.types.Scene.stillwater
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
