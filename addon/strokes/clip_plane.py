"""The plane of a layer's clip, below the picture: what is drawn on it says where in the clip something is taken from.

It hangs on the picture's plane, lies in its collection, and plays with the scene. Annotations of an Image Editor would
not do: they belong to an editor and not to the clip, and no script can make one again from a recipe.
"""

import os

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from .. import engine
from ..properties import clip, image, names


def ensure(picture, layer):
    """The plane that shows the layer's clip as it is chosen now. Throws ValueError, OSError with a sentence."""
    if picture.plane is None:
        sentence = rpt_("{name}: has no plane in the scene to draw on; make it anew with Set Up in Scene")
        raise ValueError(sentence.format(name=picture.name))
    chosen = layer.motion.example.clip
    if not chosen:
        raise ValueError(rpt_("{layer}: has no clip yet; press Choose Clip").format(layer=layer.name))
    shown = clip.plane_of(picture, layer.id)
    if shown is not None and _is_of(shown.data, chosen):
        return shown
    movie = load(chosen)
    if shown is None:
        shown = _made(picture, layer)
    before, shown.data = shown.data, movie
    shown[clip.SIZE] = tuple(movie.size)
    seen = shown.image_user
    seen.frame_start, seen.frame_duration, seen.use_cyclic = 1, max(1, movie.frame_duration), True
    _place(picture, shown)
    _drop(before)
    bpy.context.view_layer.update()
    return shown


def load(path: str):
    """The clip as an image that Blender plays. Throws ValueError, OSError with a sentence."""
    absolute = bpy.path.abspath(path)
    facts = engine.clip_facts(absolute)
    known = next((each for each in bpy.data.images if _is_of(each, path)), None)
    try:
        movie = known or bpy.data.images.load(absolute)
    except RuntimeError:
        raise OSError(rpt_("{path}: there is no such clip").format(path=absolute)) from None
    if movie.source != "MOVIE" or tuple(movie.size) != (facts.width, facts.height):
        if known is None:
            bpy.data.images.remove(movie)
        sentence = rpt_("{path}: Blender does not show this clip as it is ({width} x {height} px); convert it to MP4")
        raise ValueError(sentence.format(path=absolute, width=facts.width, height=facts.height))
    movie.filepath = image.stored(absolute)
    return movie


def copy(picture, from_id: str, to_id: str):
    """A plane like it for another layer, in its place; None where the clip is not shown."""
    shown = clip.plane_of(picture, from_id)
    if shown is None:
        return None
    made = shown.copy()
    made[clip.LAYER] = to_id
    for collection in shown.users_collection:
        collection.objects.link(made)
    bpy.context.view_layer.update()
    return made


def remove(picture, layer_id: str) -> None:
    """Takes it away with the layer."""
    shown = clip.plane_of(picture, layer_id)
    if shown is not None:
        movie = shown.data
        bpy.data.objects.remove(shown)
        _drop(movie)


def follow(example) -> None:
    """After another clip was chosen: where one is shown it is this one now, if that can be."""
    if image.is_held():
        return
    picture = names.picture_of(example)
    layer = next(layer for layer in picture.layers if layer.motion.example == example)
    if layer.motion.example.clip and clip.plane_of(picture, layer.id) is not None:
        try:
            ensure(picture, layer)
        except (ValueError, OSError):  # told by whoever asks for it: the panel, Live, the bake
            return


def _is_of(movie, path: str) -> bool:
    """Whether an image is the clip at a path of ours."""
    there, here = (os.path.abspath(bpy.path.abspath(each)) for each in (movie.filepath if movie else "", path))
    return movie is not None and movie.source == "MOVIE" and there == here


def _drop(movie) -> None:
    if movie is not None and movie.users == 0:
        bpy.data.images.remove(movie)


def _made(picture, layer):
    shown = bpy.data.objects.new(f"{layer.name} {rpt_('Clip')}", None)
    shown[clip.LAYER], shown.parent = layer.id, picture.plane
    shown.empty_display_type, shown.empty_display_size = "IMAGE", picture.plane.empty_display_size
    shown.empty_image_offset, shown.empty_image_depth, shown.empty_image_side = (-0.5, -0.5), "BACK", "DOUBLE_SIDED"
    shown.hide_select = shown.hide_render = True  # a click means a stroke
    (picture.collection or picture.id_data.collection).objects.link(shown)
    return shown


def _place(picture, shown) -> None:
    """Below the picture and what is shown below it already, their middles above each other."""
    plane, (width, height) = picture.plane, picture.picture_size
    unit, side = plane.empty_display_size / max(width, height), plane.empty_display_size
    lowest = [plane.empty_image_offset[1] * height * unit]
    lowest += [other.location.y - _half_height(other) for other in clip.planes_of(picture) if other != shown and clip.SIZE in other]
    shown.location.x = (plane.empty_image_offset[0] + 0.5) * width * unit
    shown.location.y = min(lowest) - clip.GAP * side - _half_height(shown)


def _half_height(shown) -> float:
    size = clip.size_of(shown)
    return shown.empty_display_size * size[1] / max(size) / 2
