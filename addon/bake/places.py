"""Where recipe and frames of a picture lie: beside the .blend, in the user's folder until it is saved."""

import os
import re
from pathlib import Path

import bpy

PACKAGE = __package__.rpartition(".")[0]


def folder_of(picture) -> Path:
    """The folder of one picture's recipe, frames and cache; made where it is missing."""
    name = re.sub(r"[^\w.-]+", "_", picture.name) or "picture"
    if bpy.data.filepath:
        folder = Path(bpy.data.filepath).parent / "stillwater" / name
    else:
        folder = Path(bpy.utils.extension_path_user(PACKAGE, path="unsaved", create=True)) / picture.id
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def frames_of(picture) -> Path:
    """The folder of its frames."""
    return folder_of(picture) / picture.output.folder


def locate_from(folder: Path):
    """Turns Blender's paths into the recipe's: relative to `folder` where they are on one drive."""

    def locate(path: str) -> str:
        absolute = os.path.abspath(bpy.path.abspath(path))
        try:
            return Path(os.path.relpath(absolute, folder)).as_posix()
        except ValueError:  # another drive
            return absolute

    return locate


def locate_in(folder: Path):
    """Turns the paths of a recipe that lies in `folder` into Blender's: relative to the .blend where it is saved."""

    def locate(path: str) -> str:
        absolute = os.path.abspath(folder / path)
        try:
            return bpy.path.relpath(absolute) if bpy.data.filepath else absolute
        except ValueError:  # another drive
            return absolute

    return locate
