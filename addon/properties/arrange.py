"""Adding, moving and removing pictures and layers. Keys and drivers go with them: their paths hold the index."""

from . import curves, migrate, names, plain

OWN = ("id", "name", "selected", "solo")  # what no other layer gets from a layer


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


def duplicate_layers(picture, indices: list[int]) -> dict[str, str]:
    """Copies of layers, each in front of its own, with ids, names, keys and drivers of their own.

    Where layers that are copied together know each other (a boat and its water), so do the copies. Returns the copies'
    ids by their originals'.
    """
    count = len(picture.layers)
    said = {i: (picture.layers[i].name, plain.values_of(picture.layers[i], but=OWN)) for i in indices}
    ids = {}
    for i, (name, _) in said.items():
        ids[picture.layers[i].id] = add_layer(picture, name).id
    for place, (i, (_, values)) in enumerate(said.items(), count):
        plain.set_values(picture.layers[place], values)
        refer(picture.layers[place], ids)
        curves.copy(picture, i, place, ids=ids)
    copies = dict(zip(indices, range(count, len(picture.layers)), strict=True))
    reorder_layers(picture, [i for old in range(count) for i in (copies.get(old), old) if i is not None])
    return ids


def refer(layer, ids: dict[str, str]) -> None:
    """Makes a layer that was copied know the copies of others, where `ids` has them."""
    for group, field in ((layer.follows, "layer_id"), (layer.motion.bob, "water_id")):
        known = getattr(group, field)
        setattr(group, field, ids.get(known, known))


def reorder_layers(picture, order: list[int]) -> None:
    """Puts the layer that was at order[i] in place i, with its keys and drivers."""
    now = list(range(len(order)))
    for to, old in enumerate(order):
        picture.layers.move(now.index(old), to)
        now.insert(to, now.pop(now.index(old)))
    _renumber_layers(picture, {old: new for new, old in enumerate(order)})


def move_layer(picture, index: int, to: int) -> None:
    """Moves a layer, its keys and its drivers."""
    order = list(range(len(picture.layers)))
    order.insert(to, order.pop(index))
    reorder_layers(picture, order)


def remove_layers(picture, indices: list[int]) -> None:
    """Removes layers, their keys and their drivers."""
    kept = [i for i in range(len(picture.layers)) if i not in indices]
    for index in sorted(indices, reverse=True):
        picture.layers.remove(index)
    _renumber_layers(picture, {old: new for new, old in enumerate(kept)})


def _renumber_layers(picture, places: dict[int, int]) -> None:
    curves.renumber(picture.id_data, f"{picture.path_from_id()}.layers", places)


def remove_picture(scene, index: int) -> None:
    """Removes a picture, its keys and its drivers. All that was made for it stays (pictures/remove.py)."""
    count = len(scene.stillwater.pictures)
    scene.stillwater.pictures.remove(index)
    curves.renumber(scene, "stillwater.pictures", {i: i - (i > index) for i in range(count) if i != index})
    scene.stillwater.active_picture = max(0, min(scene.stillwater.active_picture, count - 2))
