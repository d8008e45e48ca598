"""What the node's tree knows of itself: whose frames it shows, where they lie, how their bake went."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from ..properties import names


class STILLWATER_PG_frames(bpy.types.PropertyGroup):
    """On the node tree, so that the node shows the same in a scene that was copied or a file that appended it."""

    picture: StringProperty(options={"HIDDEN"})  # the picture's permanent id; empty: not a tree of ours
    scene: StringProperty(options={"HIDDEN"})  # name of the scene whose picture it is, where a copy has the same ids
    folder: StringProperty(name="Frames", description="Folder of the frames", subtype="DIR_PATH", options=names.PATH)
    home: StringProperty(options={"HIDDEN"})  # folder of the .blend from which `folder` was last written
    name: StringProperty(name="Name", description="Frames are NAME_0001.exr", default="frame", options=set())
    first: IntProperty(name="First", description="First frame of the last bake", default=1, options=set())
    last: IntProperty(name="Last", description="Last frame of the last bake", default=1, options=set())
    loop: BoolProperty(name="Loop", description="The last frame runs into the first", options=set())
    layers: StringProperty(options={"HIDDEN"})  # JSON: name and EXR layer of each layer that the frames hold alone
    state: EnumProperty(
        name="Bake", description="How the last bake went", default="none", options=set(),
        items=[
            ("none", "Not Baked", "No frames were made yet"),
            ("running", "Baking", "The worker is making frames"),
            ("done", "Baked", "All frames are there"),
            ("failed", "Failed", "The worker gave up"),
            ("cancelled", "Cancelled", "The frames made so far are kept"),
        ],
    )
    share: FloatProperty(name="Progress", description="How much of the bake is done (0..1)", min=0, max=1, options=set())
    left: StringProperty(name="Time Left", description="How long the bake still takes", options=set())
    holds: BoolProperty(default=True, options={"HIDDEN"})  # missing frames show the nearest; not in a render that bakes
    there: StringProperty(options={"HIDDEN"})  # the frames that the node shows, as ranges: 1-4,7
    message: StringProperty(name="Message", description="What the worker does, or why it gave up", options=set())
    warning: StringProperty(name="Warning", description="What the worker warned of", options=set())


CLASSES = [STILLWATER_PG_frames]
