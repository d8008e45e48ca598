"""The image datablock in which plane and node show a picture's file: it follows the picture's path and colour space.

Blender's own tools (relative paths, Find Missing Files) know only the datablock; `take_path` learns from it.
"""

import contextlib
import os

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

LARGEST_SIDE = 16384  # px: the engine's
SPACES = {"srgb": "sRGB", "linear": "Linear Rec.709"}
LINEAR_FILES = {"OPEN_EXR", "OPEN_EXR_MULTILAYER", "HDR"}  # what the engine takes for linear by itself

_held = False


@contextlib.contextmanager
def held():
    """Within, paths may be rewritten for a file that lies elsewhere: images do not follow."""
    global _held
    _held = True
    try:
        yield
    finally:
        _held = False


def load(path: str):
    """A new image of the file and its size, px. Throws ValueError with a sentence; then no image is left."""
    if not path:
        raise ValueError(rpt_("No picture was chosen"))
    try:
        image = bpy.data.images.load(path)
    except RuntimeError:
        raise ValueError(rpt_("{path}: there is no such picture").format(path=path)) from None
    size = tuple(image.size)
    if image.source == "MOVIE":
        problem = rpt_("{name}: is a movie, not a still picture")
    elif 0 in size or image.source != "FILE":
        problem = rpt_("{name}: Blender can't read it as a picture")
    elif max(size) > LARGEST_SIDE:
        problem = rpt_("{name}: {size[0]} x {size[1]} pixels; at most {largest:,} a side can be animated")
    else:
        return image, size
    bpy.data.images.remove(image)
    raise ValueError(problem.format(name=os.path.basename(path), size=size, largest=LARGEST_SIDE))


def check_size(picture) -> None:
    """Throws ValueError where the picture's file is missing, or came to be of another size than the picture has."""
    if picture.image is None:
        return
    path = bpy.path.abspath(picture.picture)
    if picture.image.packed_file is not None and not os.path.isfile(path):
        sentence = rpt_("{name}: its picture is packed into the .blend; unpack it (File > External Data) to bake")
        raise ValueError(sentence.format(name=picture.name))
    fresh, size = load(path)
    bpy.data.images.remove(fresh)
    if size != tuple(picture.picture_size):
        sentence = rpt_(
            "{name}: its file has {size[0]} x {size[1]} pixels now, not {old[0]} x {old[1]}: use Reload Picture"
        )
        raise ValueError(sentence.format(name=picture.name, size=size, old=picture.picture_size))


def stored(path: str) -> str:
    """A path as the .blend keeps it: relative where the .blend is saved, on the same drive."""
    absolute = os.path.abspath(bpy.path.abspath(path))
    try:
        return bpy.path.relpath(absolute) if bpy.data.filepath else absolute
    except ValueError:  # another drive
        return absolute


def follow(picture, context=None) -> None:
    """Points the picture's image, where it has one, at its file and its colour space."""
    image = picture.image
    if image is None or _held:
        return
    if image.filepath != picture.picture:
        image.filepath = picture.picture
    space = picture.colour_space
    if space == "auto":
        space = "linear" if image.file_format in LINEAR_FILES else "srgb"
    known = image.colorspace_settings.bl_rna.properties["name"].enum_items
    if image.colorspace_settings.name != SPACES[space] and SPACES[space] in known:  # a studio's OCIO may lack it
        image.colorspace_settings.name = SPACES[space]


def take_path(picture) -> None:
    """Takes over the image's path where Blender's own tools gave it another that is there; notes a missing file."""
    if picture.image is not None and picture.image.source == "FILE":
        theirs = picture.image.filepath
        if theirs != picture.picture and os.path.isfile(bpy.path.abspath(theirs)):
            picture.picture = theirs
    picture.missing = bool(picture.picture) and not os.path.isfile(bpy.path.abspath(picture.picture))
