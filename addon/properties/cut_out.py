"""How a layer is cut out of the picture, and what fills the hole behind it."""

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from . import names

METHODS = [
    ("closed-form", "Closed Form", "Smooth edges, hair and leaves: right for almost all"),
    ("bayesian", "Bayesian", "By the colors nearby: for a layer whose colors are all unlike those around it"),
]


def _make_odd(fill, context) -> None:
    """A patch has a pixel in its middle."""
    if fill.patch % 2 == 0:
        fill.patch += 1


class STILLWATER_PG_matte(bpy.types.PropertyGroup):
    """A part of the picture: how much of each pixel belongs to it. What is drawn of it are strokes (strokes/roles.py)."""

    form: EnumProperty(
        name="Matte", description="What says which part of the picture it is", default="none", options=set(),
        items=[
            ("none", "None", "The whole picture: for the last layer, the background"),
            ("file", "File", "An image: one channel, or gray"),
            ("labels", "Labels", "All pixels of a label map that have one value"),
            ("scribbles", "Scribbles", "Strokes on it and strokes beside it; the rest is found from the picture"),
            ("lasso", "Outline", "A line drawn around it; its edge is found from the picture"),
            ("trimap", "Trimap", "An image: white is part of it, black is not, what is gray is found from the picture"),
        ],
    )
    file: StringProperty(name="File", description="Image with the matte", subtype="FILE_PATH", options=names.PATH)
    channel: StringProperty(
        name="Channel", description="Channel of the image; its gray where it has no such channel",
        default="A", maxlen=255, options=set(),
    )
    labels: StringProperty(name="Labels", description="Label map", subtype="FILE_PATH", options=names.PATH)
    value: IntProperty(name="Value", description="Label of this layer", default=1, min=0, soft_max=255, options=set())
    trimap: StringProperty(
        name="Trimap", description="Image in white, gray and black", subtype="FILE_PATH", options=names.PATH
    )
    feather: FloatProperty(
        name="Edge", description="How far on both sides of the outline its edge is looked for [px]", subtype="PIXEL",
        default=8, min=0, max=1000, soft_max=50, options=set(),
    )
    snap: FloatProperty(
        name="Snap", description="How far the outline is pulled to edges of the picture; 0 = it stays as drawn [px]",
        subtype="PIXEL", default=0, min=0, max=1000, soft_max=30, options=set(),
    )
    method: EnumProperty(
        name="Method", description="How the edge is found", default="closed-form", options=set(), items=METHODS
    )


class STILLWATER_PG_fill(bpy.types.PropertyGroup):
    """What fills the hole behind the layer."""

    method: EnumProperty(
        name="Fill", description="What fills the hole behind the layer", default="exemplar", options=set(),
        items=[
            ("exemplar", "Exemplar", "Pieces of the picture itself"),
            ("file", "File", "A painted background"),
            ("none", "None", "Nothing: transparent behind"),
        ],
    )
    file: StringProperty(name="File", description="Painted background", subtype="FILE_PATH", options=names.PATH)
    patch: IntProperty(
        name="Patch", description="Side of the pieces that are taken: larger ones keep larger patterns whole [px]",
        subtype="PIXEL", default=9, min=3, soft_min=5, max=63, soft_max=31, options=set(), update=_make_odd,
    )
    radius: FloatProperty(
        name="Radius", description="How far away pieces may come from; 0 = anywhere [px]", subtype="PIXEL",
        default=0, min=0, max=16384, soft_max=500, options=set(),
    )
    grow: FloatProperty(
        name="Grow", description="Pieces keep this far from the hole, where colors of the layer are mixed in [px]",
        subtype="PIXEL", default=2, min=0, max=1000, soft_max=20, options=set(),
    )
    source: PointerProperty(type=STILLWATER_PG_matte)
    touch_up_radius: FloatProperty(
        name="Touch-Up Radius", subtype="PIXEL", default=60, min=0, max=16384, soft_max=500, options=set(),
        description="How far away pieces for what is touched up may come from; 0 = anywhere [px]",
    )
    touch_up_seed: IntProperty(
        name="Touch-Up Seed", description="Another number fills what is touched up in another way",
        default=1, min=0, soft_max=100, options=set(),
    )


CLASSES = [STILLWATER_PG_matte, STILLWATER_PG_fill]
