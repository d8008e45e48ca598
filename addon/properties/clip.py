"""Where a clip's pixels lie in the scene: on a plane of its own, an image Empty that hangs on the picture's plane.

Which layer's it is, and how many pixels the clip has, the Empty knows itself: so it is found after undo, in a copy, in
another file.
"""

from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Matrix

from . import names, plane

GAP = 0.04  # between planes, of the longer side of the picture's
LAYER, SIZE = "stillwater_clip", "stillwater_clip_size"


def planes_of(picture) -> list:
    """The planes of all clips that are shown with a picture."""
    return [item for item in picture.plane.children if LAYER in item] if picture.plane is not None else []


def plane_of(picture, layer_id: str):
    """The plane of a layer's clip; None where it is not shown."""
    return next((item for item in planes_of(picture) if item[LAYER] == layer_id), None)


def size_of(shown) -> tuple[int, int]:
    """px, of the clip on a plane."""
    width, height = shown[SIZE]
    return int(width), int(height)


def pixels_to_world(picture, layer_id: str) -> Matrix:
    """As plane.pixels_to_world(), of a layer's clip. Throws ValueError where it is not shown."""
    shown = plane_of(picture, layer_id)
    if shown is None:
        layer = names.layer_by_id(picture, layer_id)
        sentence = rpt_("{name}: its clip is not in the scene; press Show Clip")
        raise ValueError(sentence.format(name=layer.name if layer else picture.name))
    return plane.of_pixels(shown, size_of(shown))
