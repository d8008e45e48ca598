"""Adding, moving and removing pictures and layers. Keys and drivers go with them: their paths hold the index."""

import re

from .. import versions
from . import migrate, names


def add_picture(scene, name: str):
    """A new picture of `scene`, with an id of its own, made the active one."""
    picture = scene.stillwater.pictures.add()
    scene.stillwater.version = migrate.VERSION
    picture.id = names.new_id()
    picture.name = name
    scene.stillwater.active_picture = len(scene.stillwater.pictures) - 1
    return picture


def add_layer(picture, name: str):
    """A new layer behind the others, with an id of its own."""
    layer = picture.layers.add()
    layer.id = names.new_id()
    layer.name = name
    return layer


def move_layer(picture, index: int, to: int) -> None:
    """Moves a layer, its keys and its drivers."""
    order = list(range(len(picture.layers)))
    order.insert(to, order.pop(index))
    picture.layers.move(index, to)
    _renumber(picture.id_data, f"{picture.path_from_id()}.layers", {old: new for new, old in enumerate(order)})


def remove_layer(picture, index: int) -> None:
    """Removes a layer, its keys and its drivers."""
    count = len(picture.layers)
    picture.layers.remove(index)
    places = {i: i - (i > index) for i in range(count) if i != index}
    _renumber(picture.id_data, f"{picture.path_from_id()}.layers", places)


def remove_picture(scene, index: int) -> None:
    """Removes a picture, its keys and its drivers. All that was made for it stays (pictures/remove.py)."""
    count = len(scene.stillwater.pictures)
    scene.stillwater.pictures.remove(index)
    _renumber(scene, "stillwater.pictures", {i: i - (i > index) for i in range(count) if i != index})
    scene.stillwater.active_picture = max(0, min(scene.stillwater.active_picture, count - 2))


def _renumber(scene, collection: str, places: dict[int, int]) -> None:
    """Rewrites the paths of all curves under `collection`; those of an index without a new place are removed."""
    data = scene.animation_data
    if data is None:
        return
    indexed = re.compile(re.escape(collection) + r"\[(\d+)\](.*)")
    bags = [*versions.channelbags(data), data.drivers]
    for curves in bags:
        for curve in list(curves):
            found = indexed.fullmatch(curve.data_path)
            if found and int(found[1]) in places:
                curve.data_path = f"{collection}[{places[int(found[1])]}]{found[2]}"
            elif found:
                curves.remove(curve)
