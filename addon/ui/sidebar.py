"""What the panels share. Each room draws its own, in the 3D viewport's sidebar and in the compositor's.

    class _Layers(sidebar.OfPicture): ...
    CLASSES = sidebar.in_both_editors("layers", _Layers)
"""

import re
import textwrap

import bpy
from bpy.app.translations import pgettext_iface as iface_

EDITORS = ("VIEW_3D", "NODE_EDITOR")
# Of a sidebar at scale 1, pixels: what its tabs and an icon take, a character on average, its width by default.
BESIDE, CHARACTER, WIDTH = 85, 6.3, 280
LABEL = 13  # characters that fit before a number


class Part:
    """A panel of the sidebar's Stillwater tab."""

    bl_category = "Stillwater"
    bl_region_type = "UI"

    @classmethod
    def poll(cls, context):
        """In node editors only where they show a compositor."""
        return getattr(context.space_data, "tree_type", "CompositorNodeTree") == "CompositorNodeTree"


class OfPicture(Part):
    """A panel about the active picture, closed until it is asked for."""

    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.scene.stillwater.active() is not None


def in_both_editors(name: str, part: type) -> list[type]:
    """The panel STILLWATER_PT_EDITOR_NAME of each editor, drawn by `part`; without a name the one that holds the others."""
    return [_panel(editor, name, part) for editor in EDITORS]


def in_viewport(name: str, part: type) -> list[type]:
    """The panel of the 3D viewport alone, about what only it shows."""
    return [_panel("VIEW_3D", name, part)]


def in_image_editor(part: type) -> list[type]:
    """A panel of the Image Editor."""
    return [_panel("IMAGE_EDITOR", "", part)]


def _panel(editor: str, name: str, part: type) -> type:
    parent = f"STILLWATER_PT_{editor.lower()}"
    place = {"bl_space_type": editor, **({"bl_parent_id": parent} if name else {})}
    return type(f"{parent}_{name}" if name else parent, (part, bpy.types.Panel), place)


def say(context, layout, sentence: str, icon: str) -> None:
    """A sentence over as many lines as the sidebar's width asks for; Blender would cut it off."""
    width = context.region.width / context.preferences.system.ui_scale if context.region else WIDTH
    column = layout.column(align=True)
    for line in textwrap.wrap(sentence, max(12, int((width - BESIDE) / CHARACTER))):
        column.label(text=line, icon=icon)
        icon = "BLANK1"


def draw_all(layout, group) -> None:
    """All properties of a group, in the order in which they are declared."""
    layout.use_property_split = True
    draw(layout, group, *type(group).__annotations__)


def draw(layout, group, *names: str) -> None:
    """Properties that belong together, closely below each other, with the units that Blender would not show.

    Below a path stands its file's name: Blender cuts off the end of what is longer than the field.
    """
    column = layout.column(align=True)
    for name in names:
        kind = group.bl_rna.properties[name]
        column.prop(group, name, text=label(kind))
        if kind.type == "STRING" and kind.subtype == "FILE_PATH" and (file := file_of(getattr(group, name))):
            row = column.row()
            row.alignment = "RIGHT"
            row.label(text=file, icon="FILE_IMAGE")


def file_of(path: str) -> str:
    """The name of a file whose path is longer than that."""
    name = path.replace("\\", "/").rpartition("/")[2]
    return name if name != path else ""


def label(kind) -> str:
    """A property's name, with the unit that stands at the end of its description: Speed (m/s).

    Without it where Blender shows it beside the number, or where the sidebar would cut it off.
    """
    found = re.search(r" \[([\w/]+)\]$", kind.description)
    shown = getattr(kind, "subtype", "NONE") in ("PIXEL", "ANGLE")
    name = iface_(kind.name)
    whole = f"{name} ({found[1]})" if found else name
    return name if shown or len(whole) > LABEL else whole


def fold(layout, identifier: str, text: str, closed: bool = True):
    """A part that can be folded away, closed until it is asked for; None while it is folded."""
    header, body = layout.panel(identifier, default_closed=closed)
    header.label(text=text)
    return body
