"""The numbers of fluids, named, limited and measured as in the recipe: refine.width there is refine_width here.

What strokes say of themselves (stroke_...) is what the next one drawn gets; each keeps its own (strokes/brush.py).
"""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty

PROPOSALS = [
    ("water", "Water", "Along its streaks, to the right"),
    ("falls", "Falls", "Down along its streaks"),
    ("fire", "Fire", "Up along its flames"),
    ("smoke", "Smoke", "Up, slowly"),
    ("sky", "Sky", "Clouds that pass to the right"),
]


class STILLWATER_PG_flow(bpy.types.PropertyGroup):
    """A fluid that moves for ever along painted strokes: rivers, waterfalls, smoke, fire, clouds."""

    speed: FloatProperty(
        name="Speed", description="Factor of the speed that its strokes say; below 0 it flows backwards",
        default=1, min=-1000, soft_min=-4, max=1000, soft_max=4,
    )
    period: FloatProperty(
        name="Period", description="After which the flow begins anew: a long one follows it farther, a short one is sharper [frames]",
        default=60, min=0.001, soft_min=8, max=1e6, soft_max=240, options=set(),
    )
    refine_width: FloatProperty(
        name="Refine Width", description="How widely streaks of the picture are looked at: wide is calm, narrow follows each [px]",
        subtype="PIXEL", default=12, min=0, max=1000, soft_max=60, options=set(),
    )
    refine_amount: FloatProperty(
        name="Refine", description="How much the picture's own streaks turn the flow (0..1)", subtype="FACTOR",
        default=1, min=0, max=1, options=set(),
    )
    outline_moving: BoolProperty(
        name="Moving Outline", description="The layer's outline moves with the flow", default=False, options=set()
    )
    outline_persistence: FloatProperty(
        name="Persistence", description="Share of the outline that lasts from frame to frame (0..1)", subtype="FACTOR",
        default=0.9, min=0, max=1, options=set(),
    )
    stroke_speed: FloatProperty(
        name="Stroke Speed", description="Speed that the next strokes say [px/frame]",
        default=2, min=0, max=1000, soft_max=20, options=set(),
    )
    stroke_local: BoolProperty(
        name="Local", description="The next strokes change only what is near them", default=False, options=set()
    )
    stroke_alpha: FloatProperty(
        name="Weight", description="How strongly the next strokes count against the others (0..1)", subtype="FACTOR",
        default=1, min=0, max=1, options=set(),
    )
    proposal: EnumProperty(
        name="Proposal", description="What flows, where no stroke says how: the picture proposes it", items=PROPOSALS,
        default="water", options=set(),
    )


CLASSES = [STILLWATER_PG_flow]
