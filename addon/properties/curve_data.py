"""A layer's curve as plain data: its path inside the layer, its keys, its modifiers, its driver.

What a driver reads in the picture's scene is kept by the layer's id, what it reads elsewhere by where the datablock is.
"""

import re
from collections.abc import Callable

from bpy.app.translations import pgettext_rpt as rpt_

from . import plain

LAYER = re.compile(r"(?P<picture>stillwater\.pictures\[\d+\])\.layers\[(?P<layer>\d+)\]\.(?P<inside>.+)")
CURVE = ("extrapolation", "mute", "lock", "hide", "auto_smoothing", "color_mode", "color")
# In the order in which they are set: a handle's place counts where its type is free.
KEY = ("interpolation", "easing", "type", "back", "amplitude", "period", "handle_left_type", "handle_right_type")
KEY += ("co", "handle_left", "handle_right")
TARGET = ("bone_target", "transform_type", "rotation_mode", "transform_space", "context_property")
TARGET += ("use_fallback_value", "fallback_value")
NOT_OF_MODIFIERS = {"rna_type", "type", "active", "is_valid"}

Lost = Callable[[str], None]  # is told what a driver reads and can't be found


def to_data(curve, picture) -> dict:
    """One curve of a layer of `picture`."""
    modifiers = [{"type": one.type, **_writable(one), **_points(one)} for one in curve.modifiers]
    keys = [_fields(key, KEY) for key in curve.keyframe_points]
    baked = [{"co": list(sample.co), "interpolation": "LINEAR"} for sample in curve.sampled_points]
    return {
        "path": LAYER.fullmatch(curve.data_path)["inside"],
        "index": curve.array_index,
        **_fields(curve, CURVE),
        "points": keys or baked,
        "modifiers": modifiers,
        **({"driver": _driver(curve.driver, picture)} if curve.driver else {}),
    }


def _fields(struct, fields) -> dict:
    values = {name: getattr(struct, name) for name in fields}
    return {name: value if isinstance(value, str | int | float) else list(value) for name, value in values.items()}


def _writable(modifier) -> dict:
    kinds = [kind for kind in modifier.bl_rna.properties if not kind.is_readonly and kind.type != "COLLECTION"]
    return _fields(modifier, [kind.identifier for kind in kinds if kind.identifier not in NOT_OF_MODIFIERS])


def _points(modifier) -> dict:
    points = getattr(modifier, "control_points", ())
    return {"control_points": [_fields(point, ("frame", "min", "max")) for point in points]} if points else {}


def _driver(driver, picture) -> dict:
    return {
        **_fields(driver, ("type", "expression", "use_self")),
        "variables": [
            {"name": variable.name, "type": variable.type,
             "targets": [_target(variable, target, picture) for target in variable.targets]}
            for variable in driver.variables
        ],
    }


def _target(variable, target, picture) -> dict:
    """What a driver's variable reads, in words that hold in another picture and file."""
    read = {**_fields(target, TARGET), "id_type": target.id_type, "data_path": target.data_path}
    if target.id == picture.id_data:
        found, whole = LAYER.fullmatch(target.data_path), f"{picture.path_from_id()}."
        if found and found["picture"] == picture.path_from_id() and int(found["layer"]) < len(picture.layers):
            known = picture.layers[int(found["layer"])].id
            return {**read, "of": "layer", "layer": known, "data_path": found["inside"]}
        if target.data_path.startswith(whole) and not found:
            return {**read, "of": "picture", "data_path": target.data_path.removeprefix(whole)}
        return {**read, "of": "scene"}
    if variable.type == "CONTEXT_PROP" or target.id is None:
        return {**read, "of": "context"}
    return {**read, "of": "datablock", "datablock": plain.address(target.id)}


def fill(curve, data: dict, picture, ids: dict[str, str], lost: Lost) -> None:
    """Makes a curve of a layer of `picture` what the data says. `ids`: of copied layers, to those of their copies."""
    curve.keyframe_points.clear()
    while curve.modifiers:
        curve.modifiers.remove(curve.modifiers[0])
    for name in CURVE:
        setattr(curve, name, data[name])
    curve.keyframe_points.add(len(data["points"]))
    for key, said in zip(curve.keyframe_points, data["points"], strict=True):
        for name, value in said.items():
            setattr(key, name, value)
    for said in data["modifiers"]:
        _fill_modifier(curve.modifiers.new(said["type"]), said)
    if "driver" in data:
        _fill_driver(curve.driver, data["driver"], picture, ids, lost)
    curve.update()


def _fill_modifier(modifier, said: dict) -> None:
    for name, value in said.items():
        if name == "control_points":
            _fill_envelope(modifier.control_points, value)
        elif name != "type":
            setattr(modifier, name, value)


def _fill_envelope(points, said: list[dict]) -> None:
    """All at once: after a number of a single point is set Blender reads behind it, as if it were the modifier, and may crash."""
    for point in said:
        points.add(point["frame"])
    for name in ("min", "max"):
        points.foreach_set(name, [point[name] for point in said])


def _fill_driver(driver, said: dict, picture, ids: dict[str, str], lost: Lost) -> None:
    driver.type, driver.use_self = said["type"], said["use_self"]
    for part in said["variables"]:
        variable = driver.variables.new()
        variable.name, variable.type = part["name"], part["type"]
        for target, read in zip(variable.targets, part["targets"], strict=True):
            _fill_target(variable, target, read, picture, ids, lost)
    driver.expression = said["expression"]


def _fill_target(variable, target, read: dict, picture, ids: dict[str, str], lost: Lost) -> None:
    if variable.type == "SINGLE_PROP":
        target.id_type = read["id_type"]
    for name in TARGET:
        setattr(target, name, read[name])
    scene, path, here = picture.id_data, read["data_path"], picture.path_from_id()
    match read["of"]:
        case "layer":
            wanted = ids.get(read["layer"], read["layer"])
            index = next((i for i, layer in enumerate(picture.layers) if layer.id == wanted), None)
            if index is None:
                lost(rpt_("{path} of a layer that is not in {picture}").format(path=path, picture=picture.name))
            target.id, target.data_path = scene, "" if index is None else f"{here}.layers[{index}].{path}"
        case "picture":
            target.id, target.data_path = scene, f"{here}.{path}"
        case "scene":
            target.id, target.data_path = scene, path
        case "context":
            target.data_path = path
        case "datablock":
            block = plain.datablock(read["datablock"])
            if block is None:
                name = read["datablock"][1] if read["datablock"] else rpt_("something")
                lost(rpt_("{name}, which is not in this file").format(name=name))
            target.id, target.data_path = block, path
