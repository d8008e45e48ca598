"""What a scene shows of its pictures in the viewport."""

import bpy
from bpy.props import BoolProperty, EnumProperty

from . import show


class STILLWATER_PG_live(bpy.types.PropertyGroup):
    """Of a scene. Nothing here reaches a bake."""

    on: BoolProperty(
        name="Live", description="Show the pictures in motion in the viewport, without a bake", default=True,
        options=set(), update=lambda self, context: show.again(self.id_data),
    )
    view: EnumProperty(
        name="Show", description="What the picture's plane shows", default="picture", options=set(),
        update=lambda self, context: show.scene(self.id_data),
        items=[
            ("picture", "Picture", "All layers in motion"),
            ("layer", "Layer", "The active layer alone"),
            ("matte", "Matte", "How much of each pixel the active layer covers, in gray"),
            ("behind", "Behind", "What is behind the active layer: the picture without it and all before it, filled"),
            ("original", "Original", "The picture as it was opened, to compare"),
        ],
    )


CLASSES = [STILLWATER_PG_live]
