"""The image datablock in which plane and node show a picture's file: it follows the picture's path and colour space.

Blender's own tools (relative paths, Find Missing Files) know only the datablock; `take_path` learns from it.
"""

import contextlib
import os

import bpy

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
    name = os.path.basename(path)
    try:
        image = bpy.data.images.load(path)
    except RuntimeError:
        raise ValueError(f"{path}: there is no such picture") from None
    size = tuple(image.size)
    if 0 in size or image.source != "FILE":
        problem = "Blender can't read it as a picture"
    elif max(size) > LARGEST_SIDE:
        problem = f"{size[0]} x {size[1]} is more than {LARGEST_SIDE:,} pixels a side"
    else:
        return image, size
    bpy.data.images.remove(image)
    raise ValueError(f"{name}: {problem}")


def check_size(picture) -> None:
    """Throws ValueError where the picture's file is missing, or came to be of another size than the picture has."""
    if picture.image is None:
        return
    fresh, size = load(bpy.path.abspath(picture.picture))
    bpy.data.images.remove(fresh)
    if size != tuple(picture.picture_size):
        old = picture.picture_size
        raise ValueError(
            f"{picture.name}: its file has {size[0]} x {size[1]} pixels now, not {old[0]} x {old[1]}: use Reload Picture"
        )


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
