"""The numbers of fluids, named, limited and measured as in the recipe: refine.width there is refine_width here.

What strokes say of themselves (stroke_...) is what the next one drawn gets; each keeps its own (strokes/brush.py).
"""

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    IntVectorProperty,
    StringProperty,
)

from . import names

clip_changed = []  # called with an example whose clip is another; rooms that show it add themselves
PROPOSALS = [
    ("water", "Water", "Along its streaks, to the right"),
    ("falls", "Falls", "Down along its streaks"),
    ("fire", "Fire", "Up along its flames"),
    ("smoke", "Smoke", "Up, slowly"),
    ("sky", "Sky", "Clouds that pass to the right"),
]


# What a flow and an example have both.


def speed():
    """How many times as fast as its strokes say."""
    return FloatProperty(
        name="Speed", description="Factor of the speed that its strokes say; below 0 it flows backwards",
        default=1, min=-1000, soft_min=-4, max=1000, soft_max=4,
    )


def refine_width():
    """How widely the picture's streaks are looked at."""
    return FloatProperty(
        name="Refine Width", description="How widely streaks of the picture are looked at: wide is calm, narrow follows each [px]",
        subtype="PIXEL", default=12, min=0, max=1000, soft_max=60, options=set(),
    )


def refine_amount():
    """How much they turn the flow."""
    return FloatProperty(
        name="Refine", description="How much the picture's own streaks turn the flow (0..1)", subtype="FACTOR",
        default=1, min=0, max=1, options=set(),
    )


def outline_moving():
    """Whether the layer's outline goes along."""
    return BoolProperty(
        name="Moving Outline", description="The layer's outline moves with the flow, as that of fire and smoke; what lies behind should be filled or painted",
        default=False, options=set(),
    )


def outline_persistence():
    """How long it keeps its shape."""
    return FloatProperty(
        name="Persistence", description="Share of the outline that lasts from frame to frame (0..1); where the animation loops, at most 0.98", subtype="FACTOR",
        default=0.9, min=0, max=1, options=set(),
    )


class STILLWATER_PG_flow(bpy.types.PropertyGroup):
    """A fluid that moves for ever along painted strokes: rivers, waterfalls, smoke, fire, clouds."""

    speed: speed()
    period: FloatProperty(
        name="Period", description="After which the flow begins anew: a long one follows it farther, a short one is sharper [frames]",
        default=60, min=0.001, soft_min=8, max=1e6, soft_max=240, options=set(),
    )
    refine_width: refine_width()
    refine_amount: refine_amount()
    outline_moving: outline_moving()
    outline_persistence: outline_persistence()
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


def follow_clip(example, context) -> None:
    """After another clip was chosen."""
    for follow in clip_changed:
        follow(example)


class STILLWATER_PG_example(bpy.types.PropertyGroup):
    """A fluid that looks and moves as the one in a clip. What its next stroke says stands in the layer's flow."""

    clip: StringProperty(
        name="Clip", description="Film of the fluid, taken with a camera that stands still", subtype="FILE_PATH", options=names.PATH,
        update=follow_clip,
    )
    use_clip_frames: BoolProperty(name="Part of the Clip", description="Use only some of its frames", options=set())
    clip_first: IntProperty(
        name="First", description="First frame of the clip that is used, counted from 1", default=1, min=1, options=set()
    )
    clip_last: IntProperty(name="Last", description="Last frame of the clip that is used", default=100, min=1, options=set())
    clip_fps: FloatProperty(
        name="Clip Rate", description="Frames of the clip in a second; 0 = as its file says [1/s]", default=0, min=0,
        max=1000, soft_max=120, options=set(),
    )
    clip_steady: BoolProperty(
        name="Steady", description="The clip's camera shakes: hold it still before its motion is taken", default=False, options=set()
    )
    clip_scale: FloatProperty(
        name="Clip Scale", description="How large the clip's details become: picture pixels for a pixel of it [px]", default=1, min=0.001, soft_min=0.1, max=100,
        soft_max=4, options=set(),
    )
    speed: speed()
    life: IntProperty(
        name="Life Time", description="How many frames of the clip a detail is carried along; fewer than it has [frames]", default=16, min=1, max=1000,
        soft_max=64, options=set(),
    )
    refine_width: refine_width()
    refine_amount: refine_amount()
    shutter: FloatProperty(
        name="Shutter", description="How long details are smeared along the flow, where they stand still [s]", default=0.2,
        min=0, max=10, soft_max=1, options=set(),
    )
    average_blur: FloatProperty(
        name="Average Blur", description="How much of what stands still is blurred [px]", subtype="PIXEL", default=8, min=0,
        max=1000, soft_max=50, options=set(),
    )
    matching: EnumProperty(
        name="Matching", description="How the look of the picture is put back", default="steerable", options=set(),
        items=[
            ("steerable", "Steerable", "By details of each size and direction: the best look"),
            ("laplacian", "Laplacian", "By details of each size: quick"),
            ("none", "None", "Not at all: the look of the clip"),
        ],
    )
    use_grid: BoolProperty(name="Own Grid", description="Match in so many cells; else in cells of about 55 px", options=set())
    grid: IntVectorProperty(
        name="Grid", description="Cells across and down in which the look is matched", size=2, default=(4, 4), min=1, max=64,
        options=set(),
    )
    repetitions: IntProperty(
        name="Repetitions", description="Rounds in which the look is matched", default=3, min=0, max=20, soft_max=6, options=set()
    )
    stylize: FloatProperty(
        name="Stylize", description="How strongly the picture's look is put back (0..1)", subtype="FACTOR", default=1, min=0,
        max=1, options=set(),
    )
    endless: BoolProperty(name="Endless", description="Go on for ever, however short the clip is", default=True, options=set())
    transfer_patch: IntProperty(
        name="Patch", description="Side of the pieces of the clip that are taken [px]", subtype="PIXEL", default=16, min=4,
        max=128, options=set(),
    )
    transfer_order: EnumProperty(
        name="Order", description="Which pieces of the clip lie on top", default="best-last", options=set(),
        items=[
            ("best-last", "Best on Top", "Those whose flow fits best"),
            ("best-first", "Best Below", "Those whose flow fits worst"),
        ],
    )
    outline_moving: outline_moving()
    outline_persistence: outline_persistence()


CLASSES = [STILLWATER_PG_flow, STILLWATER_PG_example]
