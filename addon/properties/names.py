"""Layers know each other by permanent ids; the artist sees names. Renaming a layer breaks nothing."""

import re
import uuid

import bpy

LONGEST_PICTURE, LONGEST_LAYER = 60, 200  # bytes of a name

renamed = []  # called with a picture when a layer of it was renamed; rooms that keep names add themselves
PATH = {"PATH_SUPPORTS_BLEND_RELATIVE"}  # options of a property that holds one: not to be keyed


def new_id() -> str:
    return uuid.uuid4().hex[:12]


def picture_of(part):
    """The picture that a layer, or a part of one, belongs to."""
    path = part.path_from_id()
    return part.id_data.path_resolve(path[: path.index(".layers[")])


def all_pictures() -> list:
    """Every picture of the file: their names, as their folders', are unique in it."""
    return [picture for scene in bpy.data.scenes for picture in scene.stillwater.pictures]


def layer_by_id(picture, identifier: str):
    """The layer with this id, or None."""
    return next((layer for layer in picture.layers if identifier and layer.id == identifier), None)


def other_layers(part) -> list:
    """The layers of its picture but for the one that `part` is of."""
    own = part.path_from_id()
    return [layer for layer in picture_of(part).layers if not own.startswith(f"{layer.path_from_id()}.")]


def get_layer(field: str):
    """Reads a property that shows the name of the layer whose id stands in `field`."""

    def get(self):
        layer = layer_by_id(picture_of(self), getattr(self, field))
        return layer.name if layer else ""

    return get


def set_layer(field: str):
    """Writes such a property: a name that no other layer has leaves it empty."""

    def set(self, name):
        setattr(self, field, next((layer.id for layer in other_layers(self) if layer.name == name), ""))

    return set


def search_layers(self, context, text):
    """The names offered for such a property: all but the layer's own."""
    return [layer.name for layer in other_layers(self) if text.lower() in layer.name.lower()]


def search_water(self, context, text):
    """The names offered where a layer of water is asked for."""
    water = {layer.name for layer in picture_of(self).layers if layer.motion.type == "ripple"}
    return [name for name in search_layers(self, context, text) if name in water]


def make_unique(item, siblings, most: int) -> None:
    """Gives `item` a name that none of its siblings has, as Blender does: Boat, Boat.001, Boat.002, ...

    `most`: bytes that its name may take.
    """
    taken = {other.name for other in siblings if other.as_pointer() != item.as_pointer()}
    name, count = item.name or "Unnamed", 0
    base = re.sub(r"\.\d{3,}$", "", name)
    while name in taken:
        count += 1
        name = _within(base, f".{count:03d}", most)
    if name != item.name:
        item.name = name


def _within(base: str, end: str, most: int) -> str:
    """Both, the first cut so that they take at most so many bytes: more than that Blender would cut off the end."""
    return base.encode()[: most - len(end)].decode(errors="ignore") + end


def rename_picture(picture) -> None:
    """After a picture got a name: makes it unique in the file."""
    make_unique(picture, all_pictures(), LONGEST_PICTURE)


def rename_layer(layer) -> None:
    """After a layer got a name: makes it unique, and tells who keeps it."""
    picture = picture_of(layer)
    make_unique(layer, picture.layers, LONGEST_LAYER)
    for follow in renamed:
        follow(picture)
