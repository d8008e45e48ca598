"""Layers from what is cut out already elsewhere: a mask of Blender's, or a pass of a render. Baked to a label map."""

import re
from pathlib import Path

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import BoolProperty, StringProperty

from ..bake import places
from ..properties import arrange
from ..strokes import curves
from . import label_maps, render_passes
from .selection import OfPicture

STEPS = 16  # pieces of a mask's curve between two points
FAILURES = (ValueError, OSError, RuntimeError)


def add_layers(picture, name: str, found: label_maps.LabelMap) -> int:
    """Writes a label map and adds a layer for each of its labels, in front of the active one; how many.

    Throws ValueError, OSError with a sentence; then nothing is changed.
    """
    height, width = found.labels.shape
    wanted = tuple(picture.picture_size)
    if (width, height) != wanted:
        sentence = rpt_("{name}: {width} x {height} px is not the picture's size, {wide} x {high}")
        raise ValueError(sentence.format(name=name, width=width, height=height, wide=wanted[0], high=wanted[1]))
    there = [value for value in found.names if (found.labels == value).any()]
    if not there:
        raise ValueError(rpt_("{name}: nothing is marked in it").format(name=name))
    if max(there) > label_maps.MOST:
        sentence = rpt_("{name}: {count} parts are more than a label map holds ({most})")
        raise ValueError(sentence.format(name=name, count=len(found.names), most=label_maps.MOST))
    path = _write(places.folder_of(picture) / "labels", name, found.labels)
    before, at = len(picture.layers), min(picture.active_layer, len(picture.layers))
    for value in there:
        layer = arrange.add_layer(picture, found.names[value])
        layer.matte.form, layer.matte.labels, layer.matte.value = "labels", path, value
    count = len(picture.layers)
    arrange.reorder_layers(picture, [*range(at), *range(before, count), *range(at, before)])
    for i, layer in enumerate(picture.layers):
        layer.selected = at <= i < at + count - before
    picture.active_layer = at
    return len(there)


def _write(folder: Path, name: str, labels: np.ndarray) -> str:
    """A PNG of 8 bits in `folder`, under a new name; its path as Blender keeps it."""
    folder.mkdir(parents=True, exist_ok=True)
    stem = re.sub(r"[^\w.+-]", "_", name).strip("_.") or "labels"
    path, count = folder / f"{stem}.png", 1
    while path.exists():
        path, count = folder / f"{stem}-{count}.png", count + 1
    height, width = labels.shape
    image = bpy.data.images.new(stem, width, height, is_data=True)
    try:
        pixels = np.ones((height, width, 4), np.float32)
        pixels[..., :3] = (labels[::-1, :, None] / 255).astype(np.float32)
        image.pixels.foreach_set(pixels.ravel())
        image.filepath_raw, image.file_format = str(path), "PNG"
        image.save()
    except RuntimeError as error:
        raise OSError(rpt_("{path}: can't be written").format(path=path)) from error
    finally:
        bpy.data.images.remove(image)
    return places.locate_in(folder)(path.name)


def outlines_of(mask, size: tuple[int, int]) -> dict[str, list[np.ndarray]]:
    """The filled curves of a mask's layers, front first, in picture pixels. The longer side of its space is 1."""
    longest, (width, height) = max(size), size
    found = {}
    for part in reversed(mask.layers):
        if part.hide_render:
            continue
        lines = [_line(spline) for spline in part.splines if spline.use_fill and len(spline.points) > 2]
        pixels = [np.stack([(x - 0.5) * longest + width / 2, height / 2 - (y - 0.5) * longest], 1) for x, y in lines]
        if pixels:
            found[part.name] = pixels
    return found


def _line(spline) -> np.ndarray:
    """(2, n): x and y along a closed Bezier curve."""
    points = spline.points
    three = [np.array([(*getattr(p, name), 0.0) for p in points]) for name in ("co", "handle_left", "handle_right")]
    count, one = len(points), np.ones(1, int)
    curve = curves.Curves(
        offsets=np.array([0, count]), points=three[0], types=one * curves.BEZIER, cyclic=one > 0,
        resolution=one * STEPS, left=three[1], right=three[2], order=one * 4, knots=one * 0, weights=np.ones(count),
    )  # fmt: skip
    return curves.evaluate(curve)[1][:-1, :2].T


class _FromLabels(OfPicture):
    """An operator that reads a label map of some kind and adds its layers."""

    def execute(self, context):
        picture = context.scene.stillwater.active()
        try:
            name, found = self.find(picture)
            count = add_layers(picture, name, found)
        except FAILURES as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        sentence = rpt_("Added 1 layer") if count == 1 else rpt_("Added {count} layers")
        self.report({"INFO"}, sentence.format(count=count))
        return {"FINISHED"}


class STILLWATER_OT_layers_from_mask(_FromLabels, bpy.types.Operator):
    """Add a layer for each layer of a mask, as it is at this frame"""

    bl_idname = "stillwater.layers_from_mask"
    bl_label = "Layers from Mask"
    bl_property = "mask"

    mask: StringProperty(
        name="Mask", description="Its name; empty = the only one there is", options={"SKIP_SAVE"},
        search=lambda self, context, text: [mask.name for mask in bpy.data.masks if text.lower() in mask.name.lower()],
    )

    @classmethod
    def poll(cls, context):
        if not super().poll(context):
            return False
        if not len(bpy.data.masks):
            cls.poll_message_set(tip_("There is no mask in this file: draw one in the Image Editor first"))
            return False
        return True

    def invoke(self, context, event):
        if self.mask or len(bpy.data.masks) == 1:
            return self.execute(context)
        return context.window_manager.invoke_props_dialog(self)

    def find(self, picture):
        name = self.mask or (bpy.data.masks[0].name if len(bpy.data.masks) == 1 else "")
        mask = bpy.data.masks.get(name)
        if mask is None:
            sentence = rpt_("{name}: there is no such mask") if name else rpt_("Say which mask: there are several")
            raise ValueError(sentence.format(name=name))
        outlines = outlines_of(mask, tuple(picture.picture_size))
        return mask.name, label_maps.from_outlines(outlines, tuple(picture.picture_size))


class STILLWATER_OT_layers_from_pass(_FromLabels, bpy.types.Operator):
    """Add a layer for each object of a rendered picture, by its Cryptomatte or its Object Index pass"""

    bl_idname = "stillwater.layers_from_pass"
    bl_label = "Layers from Render Pass"

    filepath: StringProperty(
        name="File", description="OpenEXR file with a Cryptomatte or an Object Index pass", subtype="FILE_PATH",
        options={"SKIP_SAVE"},
    )
    filter_glob: StringProperty(default="*.exr", options={"HIDDEN"})
    filter_folder: BoolProperty(default=True, options={"SKIP_SAVE", "HIDDEN"})

    def invoke(self, context, event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def find(self, picture):
        path = bpy.path.abspath(self.filepath)
        if not Path(path).is_file():
            raise ValueError(rpt_("{path}: there is no such file").format(path=self.filepath))
        return Path(path).stem, render_passes.read(path)


CLASSES = [STILLWATER_OT_layers_from_mask, STILLWATER_OT_layers_from_pass]
