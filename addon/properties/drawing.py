"""Which strokes are being drawn just now, and the settings to go back to."""

import bpy
from bpy.props import BoolProperty, StringProperty


class STILLWATER_PG_drawing(bpy.types.PropertyGroup):
    """Empty but while a stroke's button holds Blender in draw mode; in the scene, so that undo and files keep it."""

    role: StringProperty(options={"HIDDEN"})  # a key of strokes/roles.py; empty = nothing is being drawn
    picture_id: StringProperty(options={"HIDDEN"})
    layer_id: StringProperty(options={"HIDDEN"})
    placement: StringProperty(options={"HIDDEN"})
    lock_axis: StringProperty(options={"HIDDEN"})
    auto_key: BoolProperty(options={"HIDDEN"})
    new_layer: BoolProperty(options={"HIDDEN"})  # of a layer that was made for it: one stroke, and it is done
    shelf: BoolProperty(options={"HIDDEN"})  # viewports showed the shelf of brushes


CLASSES = [STILLWATER_PG_drawing]
