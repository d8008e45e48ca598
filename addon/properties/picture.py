"""One animated picture, and the scene's list of them. Frames and frame rate are the scene's own."""

from math import radians

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    IntVectorProperty,
    PointerProperty,
    StringProperty,
)

from . import image, names
from .drawing import STILLWATER_PG_drawing
from .layer import STILLWATER_PG_layer, select_active
from .motions import place, seed

COMPRESSIONS = ["none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"]


class STILLWATER_PG_wind(bpy.types.PropertyGroup):
    """The one wind of all layers."""

    speed: FloatProperty(name="Speed", description="Mean speed [m/s]", default=5, min=0, max=40, soft_max=20)
    direction: FloatProperty(
        name="Direction", subtype="ANGLE", default=0, min=radians(-36000), max=radians(36000),
        soft_min=radians(-360), soft_max=radians(360),
        description="Where it blows to, over the ground: 0 = the picture's right, 90 = away from the viewer [degrees]",
    )
    gusts: FloatProperty(
        name="Gusts", description="Share of the speed that comes as moving gusts (0..1)",
        default=0, min=0, max=1, subtype="FACTOR",
    )
    gust_size: FloatProperty(
        name="Gust Size", description="Size of a gust, as a share of the picture's width",
        default=0.25, min=0.001, soft_min=0.05, max=100, soft_max=2, options=set(),
    )
    seed: seed()


def start_horizon(view, context) -> None:
    """A horizon that is turned on and was never placed lies level in the middle of the picture."""
    width, height = view.id_data.path_resolve(view.path_from_id().rpartition(".")[0]).picture_size
    if view.use_horizon and tuple(view.horizon_start) == tuple(view.horizon_end):
        view.horizon_start, view.horizon_end = (0, height / 2), (width, height / 2)


class STILLWATER_PG_view(bpy.types.PropertyGroup):
    """How the picture sees the world: needed by ripple and bob."""

    use_horizon: BoolProperty(
        name="Horizon", description="The picture's horizon is known", options=set(), update=start_horizon
    )
    horizon_start: place("Start", "A point of the horizon; may lie outside the picture")
    horizon_end: place("End", "Another point of the horizon; may lie outside the picture")
    fov: FloatProperty(
        name="Field of View", description="How wide the picture's view is, horizontally [degrees]", subtype="ANGLE",
        default=radians(50), min=radians(5), max=radians(150), soft_min=radians(20), soft_max=radians(100),
        options=set(),
    )
    height: FloatProperty(
        name="Eye Height", description="Height of the eye over the water [m]",
        default=1.7, min=0.001, soft_min=0.1, max=1e5, soft_max=100, options=set(),
    )


def frame_size(picture, size=None) -> tuple[int, int]:
    """Width and height of a frame, px, rounded as the engine does; of a picture of another `size` where given."""
    return tuple(max(1, int(side * picture.output.scale + 0.5)) for side in size or picture.picture_size)


def _follow_scale(output, context) -> None:
    """Where the scene renders its camera's picture at the picture's proportions, frames and renders stay as large."""
    scene = output.id_data
    picture = scene.path_resolve(output.path_from_id().rpartition(".")[0])
    render, (width, height) = scene.render, picture.picture_size
    if picture.camera is None or scene.camera != picture.camera or not width:
        return
    if abs(render.resolution_x * height - render.resolution_y * width) <= max(width, height):
        render.resolution_x, render.resolution_y = frame_size(picture)


class STILLWATER_PG_output(bpy.types.PropertyGroup):
    """Where frames go and how they are written."""

    folder: StringProperty(
        name="Folder", description="Folder of the frames, relative to the recipe's folder", default="frames", options=set()
    )
    name: StringProperty(
        name="Name", description="Frames are NAME_0001.exr", default="frame", maxlen=200, options=set()
    )
    depth: EnumProperty(
        name="Depth", description="Precision of the color and matte channels", default="half", options=set(),
        items=[("half", "Half", "16 bit: enough for 8-bit pictures"), ("float", "Float", "32 bit")],
    )
    compression: EnumProperty(
        name="Compression", description="How the OpenEXR files are compressed", default="zip", options=set(),
        items=[(name, name.upper(), f"OpenEXR's {name.upper()}") for name in COMPRESSIONS],
    )
    layers: BoolProperty(name="Layers", description="Each layer as its own EXR layer beside the whole", options=set())
    scale: FloatProperty(
        name="Scale", description="Output pixels for a picture pixel",
        default=1, min=0.001, soft_min=0.1, max=16, soft_max=2, options=set(), update=_follow_scale,
    )


class STILLWATER_PG_picture(bpy.types.PropertyGroup):
    """One animated picture: what the recipe says at its top level."""

    id: StringProperty(options={"HIDDEN"})
    name: StringProperty(
        name="Name", description="Unique in the file", maxlen=names.LONGEST_PICTURE, options=set(),
        update=lambda self, context: names.rename_picture(self),
    )
    picture: StringProperty(
        name="Picture", description="Image file", subtype="FILE_PATH", options=names.PATH, update=image.follow
    )
    colour_space: EnumProperty(
        name="Color Space", description="Color space of the picture's file", default="auto", options=set(), update=image.follow,
        items=[
            ("auto", "Auto", "Linear for EXR and HDR, sRGB else"),
            ("srgb", "sRGB", "As most pictures are"),
            ("linear", "Linear", "Scene-linear Rec.709"),
        ],
    )
    seed: IntProperty(name="Seed", description="All random numbers follow from it: another seed, another motion of the same kind", default=0, min=0, options=set())
    loop: BoolProperty(name="Loop", description="The last frame runs into the first without a seam", options=set())
    wind: PointerProperty(type=STILLWATER_PG_wind)
    view: PointerProperty(type=STILLWATER_PG_view)
    output: PointerProperty(type=STILLWATER_PG_output)
    layers: CollectionProperty(type=STILLWATER_PG_layer)
    tree: PointerProperty(type=bpy.types.NodeTree, options={"HIDDEN"})  # the node's (compositor/tree.py)
    plane: PointerProperty(type=bpy.types.Object, options={"HIDDEN"})  # the image Empty that shows it (plane.py)
    camera: PointerProperty(type=bpy.types.Object, options={"HIDDEN"})  # sees just the plane
    strokes: PointerProperty(type=bpy.types.Object, options={"HIDDEN"})  # the grease pencil drawn on it
    collection: PointerProperty(type=bpy.types.Collection, options={"HIDDEN"})  # holds these three
    image: PointerProperty(type=bpy.types.Image, options={"HIDDEN"})  # the file as plane and node show it (image.py)
    missing: BoolProperty(options={"HIDDEN"})  # the file was not found when it was last looked for
    picture_size: IntVectorProperty(size=2, min=0, options={"HIDDEN"})  # px, of the file as it was last read; 0 = not yet
    active_layer: IntProperty(min=0, options={"HIDDEN"}, update=select_active)


class STILLWATER_PG_former(bpy.types.PropertyGroup):
    """How the scene was set before its first picture was opened, for going back (pictures/scene.py)."""

    kept: BoolProperty(options={"HIDDEN"})
    camera: PointerProperty(type=bpy.types.Object, options={"HIDDEN"})
    resolution: IntVectorProperty(size=2, options={"HIDDEN"})
    resolution_percentage: IntProperty(options={"HIDDEN"})
    pixel_aspect: FloatVectorProperty(size=2, options={"HIDDEN"})
    fps: IntProperty(options={"HIDDEN"})
    fps_base: FloatProperty(options={"HIDDEN"})
    display_device: StringProperty(options={"HIDDEN"})
    view_transform: StringProperty(options={"HIDDEN"})
    look: StringProperty(options={"HIDDEN"})
    exposure: FloatProperty(options={"HIDDEN"})
    gamma: FloatProperty(options={"HIDDEN"})
    use_curve_mapping: BoolProperty(options={"HIDDEN"})
    use_white_balance: BoolProperty(options={"HIDDEN"})


class STILLWATER_PG_scene(bpy.types.PropertyGroup):
    """The scene's pictures."""

    version: IntProperty(options={"HIDDEN"})  # of these properties (migrate.py); 0: older than versions are
    former: PointerProperty(type=STILLWATER_PG_former)
    pictures: CollectionProperty(type=STILLWATER_PG_picture)
    active_picture: IntProperty(min=0, options={"HIDDEN"})
    drawing: PointerProperty(type=STILLWATER_PG_drawing)
    home: StringProperty(options={"HIDDEN"})  # folder of the .blend from which relative paths were last written

    def active(self):
        """The picture that panels and operators mean; None where there is none."""
        return self.pictures[self.active_picture] if self.active_picture < len(self.pictures) else None


CLASSES = [
    STILLWATER_PG_wind,
    STILLWATER_PG_view,
    STILLWATER_PG_output,
    STILLWATER_PG_picture,
    STILLWATER_PG_former,
    STILLWATER_PG_scene,
]
