"""Properties carry a version; those of an older file are upgraded when it is opened or appended.

A step takes a scene from one version to the next. A property that only was added needs none: it has its default.
tests/blender/files holds a file of each version.
"""

import bpy

from . import image

VERSION = 1


def _an_image(scene) -> None:
    """Before 1 a picture was a path: now an image shows it. One that is not found keeps its size unknown."""
    for picture in scene.stillwater.pictures:
        if not picture.picture:
            continue
        try:
            picture.image, picture.picture_size = image.load(bpy.path.abspath(picture.picture))
        except ValueError:
            picture.missing = True
        else:
            image.follow(picture)


STEPS = {0: _an_image}


def upgrade(scene) -> None:
    """Brings the scene's properties to the present version, one step after the other."""
    settings = scene.stillwater
    if scene.library is not None or not settings.pictures:
        return
    for version in range(settings.version, VERSION):
        STEPS[version](scene)
        settings.version = version + 1


def newer(scene) -> bool:
    """Whether a newer Stillwater than this one wrote the scene's properties: it may hold what is not known here."""
    return scene.stillwater.version > VERSION
