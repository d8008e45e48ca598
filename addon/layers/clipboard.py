"""Layers are copied to another picture, scene or file: by a file that all Blenders of this user share.

As Blender's own copies of objects are; the text that an artist has in the system's clipboard stays there.
"""

import json
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from .. import preferences, strokes
from ..properties import arrange, curves, plain
from .selection import OfLayers, OfPicture, chosen

VERSION = 1
FILES = ("matte.file", "matte.labels", "matte.trimap", "fill.file")  # the paths that a layer holds
FILES += ("fill.source.file", "fill.source.labels", "fill.source.trimap", "motion.example.clip")


def place() -> Path:
    """The file that holds the copied layers."""
    return preferences.user_folder("clipboard") / "layers.json"


def to_text(picture, indices: list[int]) -> str:
    """The layers as JSON, front first: what was said, keys, drivers, and the names of the layers that they know.

    What was drawn comes along: of its motion as numbers, of its matte and fill as strokes. Throws ValueError where it can't be read.
    """
    names = {layer.id: layer.name for layer in picture.layers}
    layers = []
    for index in indices:
        layer = picture.layers[index]
        values = plain.values_of(layer, but=arrange.OWN)
        _write_strokes(values["motion"], layer.id, strokes.drawn(picture.id_data, picture))
        _each_path(values, lambda path: bpy.path.abspath(path) if path else "")
        drawn = strokes.cut_out(picture.id_data, picture, layer)
        said = {"id": layer.id, "name": layer.name, "values": values, "strokes": drawn}
        layers.append({**said, **curves.to_data(picture, index)})
    return json.dumps({"stillwater_layers": VERSION, "layers": layers, "names": names}, indent=1)


def from_text(picture, text: str, at: int) -> list[str]:
    """Puts such layers before the one at `at`. Returns a sentence for each thing that could not come along.

    Throws ValueError, with a sentence, before or after which nothing is changed.
    """
    layers, names = _read(text)
    before, lost = len(picture.layers), []
    try:
        ids = {said["id"]: arrange.add_layer(picture, said["name"]).id for said in layers}
        for index, said in enumerate(layers, before):
            _each_path(said["values"], _relative)
            plain.set_values(picture.layers[index], said["values"])
            lost += _reconnect(picture, index, ids, names)
            lost += _lay_down(picture, picture.layers[index], said.get("strokes", {}))
            unread = []
            curves.from_data(picture, index, said, ids, lost=unread.append)
            sentence = rpt_("{layer}: a driver reads {what}")
            lost += [sentence.format(layer=picture.layers[index].name, what=what) for what in unread]
    except (KeyError, TypeError, AttributeError, ValueError, RuntimeError) as error:
        arrange.remove_layers(picture, list(range(before, len(picture.layers))))
        raise ValueError(rpt_("The copied layers can't be read: {error}").format(error=error)) from error
    count = len(picture.layers)
    arrange.reorder_layers(picture, [*range(at), *range(before, count), *range(at, before)])
    return lost


def _read(text: str) -> tuple[list, dict]:
    try:
        said = json.loads(text)
        version, layers, names = said["stillwater_layers"], said["layers"], said["names"]
    except (ValueError, KeyError, TypeError) as error:
        raise ValueError(rpt_("There are no copied layers")) from error
    if version != VERSION:
        raise ValueError(rpt_("The layers were copied by another version of Stillwater"))
    return layers, names


def _reconnect(picture, index: int, ids: dict, names: dict) -> list[str]:
    """The layers that a pasted one knows: those pasted with it, else those here, of the same id or name."""
    layer, lost = picture.layers[index], []
    here = {other.id: other.id for other in picture.layers}
    named = {other.name: other.id for other in picture.layers if other.id not in ids.values()}
    for group, field in ((layer.follows, "layer_id"), (layer.motion.bob, "water_id")):
        known = getattr(group, field)
        if known:
            found = ids.get(known) or here.get(known) or named.get(names.get(known), "")
            setattr(group, field, found)
            if not found:
                name = names.get(known) or rpt_("a layer that it knows")
                sentence = rpt_("{layer}: {name} is not in {picture}")
                lost.append(sentence.format(layer=layer.name, name=name, picture=picture.name))
    return lost


def _write_strokes(motion: dict, layer_id: str, drawn) -> None:
    if line := drawn(layer_id, "sway_line"):
        motion["sway"]["armature_root"], motion["sway"]["armature_tip"] = line
    if line := drawn(layer_id, "waterline"):
        motion["bob"]["waterline"] = [{"place": place} for place in line]


def _lay_down(picture, layer, drawn: dict) -> list[str]:
    """Draws what cuts the layer out; a sentence where the picture has nothing to draw on."""
    try:
        strokes.lay_down(picture.id_data, picture, layer.id, drawn)
    except (ValueError, OSError) as error:
        return [rpt_("{layer}: its strokes did not come along: {why}").format(layer=layer.name, why=error)]
    return []


def _each_path(values: dict, change) -> None:
    for path in FILES:
        *groups, name = path.split(".")
        group = values
        for part in groups:
            group = group[part]
        if name in group:
            group[name] = change(group[name])


def _relative(path: str) -> str:
    try:
        return bpy.path.relpath(path) if path and bpy.data.filepath else path
    except ValueError:  # another drive
        return path


class STILLWATER_OT_copy_layers(OfLayers, bpy.types.Operator):
    """Copy the selected layers, to be pasted into any picture of any file"""

    bl_idname = "stillwater.copy_layers"
    bl_label = "Copy Layers"
    bl_options = {"REGISTER"}

    def execute(self, context):
        picture = context.scene.stillwater.active()
        indices = chosen(picture)
        try:
            unfinished = place().with_suffix(".part")
            unfinished.write_text(to_text(picture, indices), encoding="utf-8")
            unfinished.replace(place())
        except (OSError, ValueError) as error:
            self.report({"ERROR"}, rpt_("The layers can't be copied: {error}").format(error=error))
            return {"CANCELLED"}
        sentence = rpt_("Copied 1 layer") if len(indices) == 1 else rpt_("Copied {count} layers")
        self.report({"INFO"}, sentence.format(count=len(indices)))
        return {"FINISHED"}


class STILLWATER_OT_paste_layers(OfPicture, bpy.types.Operator):
    """Paste the copied layers in front of the active one, with their keys and drivers"""

    bl_idname = "stillwater.paste_layers"
    bl_label = "Paste Layers"

    def execute(self, context):
        picture = context.scene.stillwater.active()
        at, before = min(picture.active_layer, len(picture.layers)), len(picture.layers)
        try:
            text = place().read_text(encoding="utf-8") if place().exists() else ""
            lost = from_text(picture, text, at)
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        count = len(picture.layers) - before
        for i, layer in enumerate(picture.layers):
            layer.selected = at <= i < at + count
        picture.active_layer = at
        for sentence in lost:
            self.report({"WARNING"}, sentence)
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_copy_layers, STILLWATER_OT_paste_layers]
