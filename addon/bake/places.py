"""Where recipe and frames of a picture lie: beside the .blend, in the user's folder until it is saved."""

import os
from pathlib import Path

import bpy

from .. import preferences
from . import folders

NAME = "stillwater"


def root_of(filepath: str) -> Path:
    """The folder that holds the pictures' folders of the .blend at `filepath`; "" for one that is not saved."""
    if filepath:
        return Path(filepath).parent / NAME
    return preferences.user_folder("unsaved")


def folder_of(picture) -> Path:
    """The folder of one picture's recipe, frames and cache; made where it is missing."""
    return _folder(bpy.data.filepath, picture)


def frames_of(picture) -> Path:
    """The folder of its frames."""
    return folder_of(picture) / picture.output.folder


def files_of(picture) -> folders.Files | None:
    """What lies on disk for the picture; None where there is nothing."""
    root = root_of(bpy.data.filepath)
    folder = root / picture.id if not bpy.data.filepath else folders.known_folder(root, picture.id)
    if folder is None or not folder.is_dir():
        return None
    files = folders.Files(folder, folder / picture.output.folder, picture.output.name, picture.id)
    return files if files.found() else None


def settle(picture, filepath: str) -> tuple[Path, Path] | None:
    """Moves what an unsaved picture has on disk beside the .blend that is saved at `filepath`.

    Returns the folder that it had and the one that it has; None where there was nothing to move. Throws OSError.
    """
    before = root_of("") / picture.id
    if not before.is_dir():
        return None
    after = _folder(filepath, picture)
    folders.move(before, after)
    return before, after


def leftovers() -> list[Path]:
    """Folders in the user's folder that belong to no picture of the file that is open: of files never saved."""
    here = {picture.id for scene in bpy.data.scenes for picture in scene.stillwater.pictures}
    return [folder for folder in sorted(root_of("").iterdir()) if folder.is_dir() and folder.name not in here]


def _folder(filepath: str, picture) -> Path:
    root = root_of(filepath)
    if filepath:
        return folders.folder_for(root, picture.id, picture.name)
    folder = root / picture.id
    folder.mkdir(parents=True, exist_ok=True)
    return folder


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
