"""The compositor's node: start with tree.py."""

import bpy

from . import operators, state

CLASSES = [*state.CLASSES, *operators.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.CompositorNodeTree.stillwater = bpy.props.PointerProperty(type=state.STILLWATER_PG_frames)
    bpy.types.NODE_MT_compositor_node_add_all.append(operators.draw_menu)


def unregister():
    bpy.types.NODE_MT_compositor_node_add_all.remove(operators.draw_menu)
    del bpy.types.CompositorNodeTree.stillwater
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
