"""The image datablock in which plane and node show a picture's file: it follows the picture's path and colour space.

Blender's own tools (relative paths, Find Missing Files) know only the datablock; `take_over` learns from it.
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


def is_held() -> bool:
    """Whether paths are being rewritten just now."""
    return _held


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


def check(picture) -> None:
    """Throws ValueError, with what to do, where the engine would see another picture than the scene shows.

    The file is missing, packed, or came to be of another size; its image is in a colour space that the engine has not.
    """
    if picture.image is None:
        return
    space = picture.image.colorspace_settings.name
    if space != _space(picture) and _space(picture) in _spaces(picture.image):
        sentence = rpt_("{name}: its image is in {space}, which can't be animated; choose a Color Space under Picture")
        raise ValueError(sentence.format(name=picture.name, space=space))
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
    if image.colorspace_settings.name != _space(picture) and _space(picture) in _spaces(image):
        image.colorspace_settings.name = _space(picture)


def take_over(picture) -> None:
    """Takes over what was changed on the image: its path where that leads to a file, its colour space.

    Notes whether the file is missing.
    """
    image = picture.image
    if image is not None and image.source == "FILE":
        if image.filepath != picture.picture and os.path.isfile(bpy.path.abspath(image.filepath)):
            picture.picture = image.filepath
        if image.colorspace_settings.name != _space(picture):
            named = {name: space for space, name in SPACES.items()}
            if image.colorspace_settings.name in named:
                picture.colour_space = named[image.colorspace_settings.name]
    picture.missing = bool(picture.picture) and not os.path.isfile(bpy.path.abspath(picture.picture))


def _space(picture) -> str:
    """Blender's name of the picture's colour space."""
    if picture.colour_space == "auto":
        return SPACES["linear" if picture.image.file_format in LINEAR_FILES else "srgb"]
    return SPACES[picture.colour_space]


def _spaces(image) -> list[str]:
    """Those that Blender knows: a studio's own configuration may lack any."""
    return image.colorspace_settings.bl_rna.properties["name"].enum_items.keys()
