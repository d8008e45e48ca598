"""Keys and drivers of a scene's pictures and layers. Their paths hold an index, so they are taken along by hand."""

import re
from collections.abc import Iterator

import bpy

from .. import versions
from . import curve_data
from .curve_data import Lost


def renumber(scene, collection: str, places: dict[int, int]) -> None:
    """Rewrites all paths under `collection`, also those that drivers anywhere in the file read.

    Curves of an index without a new place are removed; a driver that reads one is left reading nothing.
    """
    indexed = re.compile(re.escape(collection) + r"\[(\d+)\](.*)")
    for curves in _collections(scene):
        for curve in list(curves):
            found = indexed.fullmatch(curve.data_path)
            if found and int(found[1]) in places:
                curve.data_path = f"{collection}[{places[int(found[1])]}]{found[2]}"
            elif found:
                curves.remove(curve)
    for target in _targets(scene):
        found = indexed.fullmatch(target.data_path)
        if found:
            place = places.get(int(found[1]))
            target.data_path = "" if place is None else f"{collection}[{place}]{found[2]}"


def copy(picture, source: int, target: int, inside: str = "", ids: dict[str, str] | None = None) -> None:
    """Gives one layer the keys and drivers of another, of all its properties or of those at a path inside it.

    A driver of the source that reads a layer of `ids` reads, in the target, the layer that it stands for there; without
    `ids` the source stands for the target. Curves that the target had at the path go.
    """
    scene, layers = picture.id_data, f"{picture.path_from_id()}.layers"
    remove(picture, target, inside)
    ids = ids or {picture.layers[source].id: picture.layers[target].id}
    for curves in _collections(scene):
        for curve in [curve for curve in curves if _lies_in(curve, f"{layers}[{source}]", inside)]:
            data = curve_data.to_data(curve, picture)
            made = curves.new(f"{layers}[{target}].{data['path']}", index=curve.array_index)
            curve_data.fill(made, data, picture, ids, lost=lambda sentence: None)


def remove(picture, index: int, inside: str = "") -> None:
    """Removes a layer's keys and drivers, all or those of a path inside it."""
    layer = f"{picture.path_from_id()}.layers[{index}]"
    for curves in _collections(picture.id_data):
        for curve in [curve for curve in curves if _lies_in(curve, layer, inside)]:
            curves.remove(curve)


def moved(group) -> set[str]:
    """The names of a group's properties that keys or drivers move."""
    place = group.path_from_id()
    every = [curve for curves in _collections(group.id_data) for curve in curves]
    return {curve.data_path.removeprefix(f"{place}.") for curve in every if _lies_in(curve, place)}


def to_data(picture, index: int) -> dict:
    """A layer's keys (of the scene's own action) and drivers as plain data."""
    data, layer = picture.id_data.animation_data, f"{picture.path_from_id()}.layers[{index}]"
    if data is None:
        return {"keys": [], "drivers": []}
    keyed = versions.curves_of(data.action, data.action_slot)
    return {
        "keys": [curve_data.to_data(curve, picture) for curve in keyed if _lies_in(curve, layer)],
        "drivers": [curve_data.to_data(curve, picture) for curve in data.drivers if _lies_in(curve, layer)],
    }


def from_data(picture, index: int, data: dict, ids: dict[str, str], lost: Lost) -> None:
    """Gives a layer without any such keys and drivers. `ids`: of layers that were copied, to those of their copies."""
    scene, layer = picture.id_data, f"{picture.path_from_id()}.layers[{index}]"
    for curve in data["keys"]:
        made = versions.ensure_curve(scene, f"{layer}.{curve['path']}", curve["index"])
        curve_data.fill(made, curve, picture, ids, lost)
    for curve in data["drivers"]:
        drivers = (scene.animation_data or scene.animation_data_create()).drivers
        curve_data.fill(drivers.new(f"{layer}.{curve['path']}", index=curve["index"]), curve, picture, ids, lost)


def _collections(scene) -> list:
    """All collections of curves that move properties of a scene: of its action, of its strips, its drivers."""
    data = scene.animation_data
    return [*versions.channelbags(data), data.drivers] if data else []


def _lies_in(curve, layer: str, inside: str = "") -> bool:
    place = f"{layer}.{inside}" if inside else layer
    return curve.data_path == place or curve.data_path.startswith(f"{place}.")


def _targets(scene) -> Iterator:
    """What drivers anywhere in the file read from `scene`."""
    kinds = [kind.identifier for kind in bpy.data.bl_rna.properties if kind.type == "COLLECTION"]
    blocks = [block for kind in kinds for block in getattr(bpy.data, kind)]
    blocks += [tree for block in blocks if (tree := getattr(block, "node_tree", None)) is not None]
    for block in {block.as_pointer(): block for block in blocks}.values():  # 5.2 has lists of lists
        data = getattr(block, "animation_data", None)
        variables = [variable for curve in data.drivers for variable in curve.driver.variables] if data else []
        yield from (target for variable in variables for target in variable.targets if target.id == scene)
