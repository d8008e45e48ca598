"""Which overlays a scene shows. Blender's own Overlays switch turns off all of them."""

import bpy
from bpy.props import BoolProperty

from . import draw as drawing
from . import flow


class STILLWATER_PG_overlay(bpy.types.PropertyGroup):
    """Of a scene; Blender has no place for it in a viewport."""

    sway_lines: BoolProperty(
        name="Sway Lines", description="From the root to the tip of what sways, as it bends at this frame",
        default=True, options=set(),
    )
    wind: BoolProperty(
        name="Wind", description="Where the wind blows to, how strongly, and its gusts at this frame",
        default=True, options=set(),
    )
    water: BoolProperty(
        name="Water Plane", description="The water's plane up to the horizon, while the active layer is water or floats",
        default=True, options=set(),
    )
    waterlines: BoolProperty(
        name="Waterlines", description="Along the hulls of what floats, where the water has them at this frame",
        default=True, options=set(),
    )
    outline: BoolProperty(
        name="Matte Outline", description="Around the active layer, at rest; it marches while its matte is drawn",
        default=True, options=set(),
    )
    tint: BoolProperty(
        name="Matte Tint", description="While a matte is drawn, a color over all that is not part of its layer",
        default=True, options=set(),
    )
    checker: BoolProperty(
        name="Matte Checker", description="While a matte is drawn, a checkerboard instead of all that is not part of its layer",
        default=False, options=set(),
    )
    flow: BoolProperty(
        name="Flow", description="While a flow is drawn, streaks that run along it; faint ones where the picture proposes it",
        default=True, options=set(),
    )
    flow_colors: BoolProperty(
        name="Flow Colors", description="While a flow is drawn, its direction as a color instead of streaks; the wheel tells which",
        default=False, options=set(),
    )


def draw(self, context):
    """The switches, in the viewport's Overlays popover."""
    if not context.scene.stillwater.pictures:
        return
    overlay = context.scene.stillwater_overlay
    column = self.layout.column()
    column.active = context.space_data.overlay.show_overlays
    column.label(text="Stillwater")
    grid = column.grid_flow(columns=2, even_columns=True, align=True)
    for name in STILLWATER_PG_overlay.__annotations__:
        grid.prop(overlay, name)
    for problem in (drawing.problem, flow.problem):
        if problem:
            column.label(text=problem, icon="ERROR")


CLASSES = [STILLWATER_PG_overlay]
