"""Layers come, go and change places. All selected ones at once; keys and drivers go with them."""

import bpy
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import EnumProperty, StringProperty

from .. import strokes
from ..properties import arrange
from . import preset_files
from .selection import MOTIONS, OfLayers, OfPicture, chosen


class OfMotion(OfPicture):
    """An operator that adds a layer with a motion."""

    motion: EnumProperty(name="Motion", description="What it does", items=MOTIONS)
    preset: StringProperty(
        name="Preset", description="File of a preset of this motion; empty: the motion as it is", options={"SKIP_SAVE"}
    )

    @classmethod
    def description(cls, context, properties):
        return preset_files.description_of(properties.preset) or tip_(cls.__doc__)


class STILLWATER_OT_add_layer(OfMotion, bpy.types.Operator):
    """Add a layer in front of the active one"""

    bl_idname = "stillwater.add_layer"
    bl_label = "Add Layer"

    def execute(self, context):
        try:
            new_layer(context.scene.stillwater.active(), self.motion, self.preset)
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


NAMES = {"sway": "Tree", "ripple": "Water", "bob": "Boat", "drift": "Clouds", "flow": "River", "example": "River"}


def new_layer(picture, motion: str, preset_file: str = ""):
    """A layer in front of the active one, which it becomes. Throws ValueError, OSError for a preset that can't be read."""
    count = len(picture.layers)
    preset = preset_files.read(preset_file) if preset_file else None
    place = min(picture.active_layer, count)
    usual = NAMES.get(motion) or ("Layer" if count else "Background")
    layer = arrange.add_layer(picture, preset.name if preset else usual)
    layer.motion.type = preset.kind if preset else motion
    if preset:
        preset_files.apply(layer.motion.numbers(), preset)
    water = [other.name for other in picture.layers if other.motion.type == "ripple"]
    if layer.motion.type == "bob" and len(water) == 1:
        layer.motion.bob.water = water[0]
    arrange.move_layer(picture, count, place)
    picture.active_layer = place
    return picture.layers[place]


class STILLWATER_OT_remove_layer(OfLayers, bpy.types.Operator):
    """Remove the selected layers, their strokes, keys and drivers"""

    bl_idname = "stillwater.remove_layer"
    bl_label = "Remove Layer"

    def execute(self, context):
        picture = context.scene.stillwater.active()
        gone = chosen(picture)
        after = picture.active_layer - sum(index < picture.active_layer for index in gone)
        for index in gone:
            strokes.remove_roles(picture, picture.layers[index].id)
        arrange.remove_layers(picture, gone)
        picture.active_layer = max(0, min(after, len(picture.layers) - 1))
        return {"FINISHED"}


class STILLWATER_OT_duplicate_layer(OfLayers, bpy.types.Operator):
    """Duplicate the selected layers, with their strokes, keys and drivers; each copy stands in front of its own"""

    bl_idname = "stillwater.duplicate_layer"
    bl_label = "Duplicate Layer"

    def execute(self, context):
        picture = context.scene.stillwater.active()
        originals = chosen(picture)
        known = {layer.id for layer in picture.layers}
        active = picture.active_layer + originals.index(picture.active_layer)
        for original, copy in arrange.duplicate_layers(picture, originals).items():
            strokes.copy_roles(picture, original, copy)
        for layer in picture.layers:
            layer.selected = layer.id not in known
        picture.active_layer = active
        return {"FINISHED"}


class STILLWATER_OT_move_layer(OfLayers, bpy.types.Operator):
    """Move the selected layers towards the viewer or away"""

    bl_idname = "stillwater.move_layer"
    bl_label = "Move Layer"

    direction: EnumProperty(
        name="Direction", description="Where the layers go",
        items=[
            ("UP", "Forward", "Before the next layer"),
            ("DOWN", "Back", "Behind the next layer"),
            ("TOP", "To the Front", "Before all other layers"),
            ("BOTTOM", "To the Back", "Behind all other layers"),
        ],
    )

    @classmethod
    def description(cls, context, properties):
        return {
            "UP": tip_("Move the selected layers forward; the list's top is the front"),
            "DOWN": tip_("Move the selected layers back; the list's top is the front"),
            "TOP": tip_("Move the selected layers before all others; the list's top is the front"),
            "BOTTOM": tip_("Move the selected layers behind all others; the list's top is the front"),
        }[properties.direction]

    def execute(self, context):
        picture = context.scene.stillwater.active()
        order = reordered(len(picture.layers), chosen(picture), self.direction)
        if order == list(range(len(order))):
            return {"CANCELLED"}
        active = picture.active_layer
        arrange.reorder_layers(picture, order)
        picture.active_layer = order.index(active)
        return {"FINISHED"}


def reordered(count: int, moved: list[int], direction: str) -> list[int]:
    """Where `moved` of `count` layers go: the old index of the layer in each new place."""
    order, rest = list(range(count)), [i for i in range(count) if i not in moved]
    match direction:
        case "TOP":
            return [*moved, *rest]
        case "BOTTOM":
            return [*rest, *moved]
        case "UP":
            for place in range(1, count):
                if order[place] in moved and order[place - 1] not in moved:
                    order[place - 1 : place + 1] = order[place], order[place - 1]
        case "DOWN":
            for place in range(count - 2, -1, -1):
                if order[place] in moved and order[place + 1] not in moved:
                    order[place : place + 2] = order[place + 1], order[place]
    return order


CLASSES = [
    STILLWATER_OT_add_layer,
    STILLWATER_OT_remove_layer,
    STILLWATER_OT_duplicate_layer,
    STILLWATER_OT_move_layer,
]
