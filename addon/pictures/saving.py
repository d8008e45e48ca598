"""A .blend that is saved elsewhere, opened or appended: its pictures' paths go on, properties are brought up to date.

Blender rewrites the paths of its own datablocks when a file moves, never those in properties. Frames of a file that was
not saved yet lie in the user's folder: with the first save they go beside it.
"""

import os
from pathlib import Path

import bpy
from bpy.app.handlers import persistent
from bpy.app.translations import pgettext_rpt as rpt_

from ..bake import job, places
from ..compositor.tree import show
from ..properties import image, migrate, names, paths

_moved = ("", "")  # the folders from and to which paths were rewritten for the save that is going on
_homes: set[str] = set()  # the folders in which the open file has lain since it was opened


def own_scenes() -> list:
    """The file's scenes that are not linked from another."""
    return [scene for scene in bpy.data.scenes if scene.library is None]


def own_pictures() -> list:
    return [picture for scene in own_scenes() for picture in scene.stillwater.pictures]


def own_trees() -> list:
    return [tree for tree in bpy.data.node_groups if tree.library is None and _is_ours(tree)]


def _is_ours(tree) -> bool:
    return tree.bl_idname == "CompositorNodeTree" and bool(tree.stillwater.picture)


@persistent
def before_save(filepath, *_):
    """Paths as the file needs them where it will lie. Blender's startup file has no path, and leaves all as it is."""
    global _moved
    _moved = ("", "")
    if not filepath:
        return
    _moved = os.path.dirname(bpy.data.filepath), os.path.dirname(os.path.abspath(filepath))
    for picture in own_pictures():
        image.take_over(picture)
    if not _moved[0]:
        _settle(filepath)
    _rebase(*_moved)


@persistent
def after_save(filepath, *_):
    """A copy was saved elsewhere: the file that stays open keeps its own."""
    if filepath and os.path.abspath(filepath) != os.path.abspath(bpy.data.filepath):
        _rebase(*reversed(_moved))


@persistent
def after_failure(*_):
    _rebase(*reversed(_moved))


def _settle(filepath: str) -> None:
    """Frames of a file that is saved for the first time. Where they can't be moved they stay, and are shown there."""
    for picture in own_pictures():
        tree = picture.tree
        if tree is None or job.running(tree):
            continue
        try:
            moved = places.settle(picture, filepath)
        except OSError as error:
            sentence = rpt_("The frames stay in {folder}: {why}")
            tree.stillwater.message = sentence.format(folder=tree.stillwater.folder, why=error)
            continue
        if moved is not None:
            frames = tree.nodes["Frames"].image
            tree.stillwater.folder = _after(tree.stillwater.folder, *moved)
            if frames is not None:
                frames.filepath_raw = _after(frames.filepath_raw, *moved)


def _after(path: str, before: Path, after: Path) -> str:
    """Where a path is after a folder moved."""
    return str(after / Path(path).relative_to(before)) if Path(path).is_relative_to(before) else path


def _rebase(old: str, new: str) -> None:
    _call_home(new)
    if old == new:
        return
    with image.held():
        for picture in own_pictures():
            paths.rebase(picture, old, new)
        for tree in own_trees():
            paths.rebase(tree.stillwater, old, new)
    if not old or not new:  # else Blender does it
        for shown in _images():
            shown.filepath_raw = paths.rebased(shown.filepath_raw, old, new)


def _call_home(folder: str) -> None:
    """Notes that all relative paths start at this folder."""
    _homes.add(folder)
    for scene in own_scenes():
        scene.stillwater.home = folder
    for tree in own_trees():
        tree.stillwater.home = folder


@persistent
def after_undo(*_):
    """A step from before the file was saved in another folder: its paths start there, and go on from here."""
    here = os.path.dirname(bpy.data.filepath)
    for scene in own_scenes():
        settings = scene.stillwater
        if here and settings.home != here and settings.home in _homes:
            with image.held():
                for picture in settings.pictures:
                    paths.rebase(picture, settings.home, here)
            settings.home = here
        for picture in settings.pictures:
            image.follow(picture)
    for tree in own_trees():
        state = tree.stillwater
        if here and state.home != here and state.home in _homes:
            paths.rebase(state, state.home, here)
            state.home = here
            show(tree)


def _images() -> set:
    """The images that were made for pictures, packed ones left aside."""
    shown = {picture.image for picture in own_pictures()} | {tree.nodes["Frames"].image for tree in own_trees()}
    return {item for item in shown if item is not None and item.library is None and item.packed_file is None}


@persistent
def after_load(*_):
    for scene in own_scenes():
        migrate.upgrade(scene)
    for picture in own_pictures():
        image.take_over(picture)
    _homes.clear()
    _call_home(os.path.dirname(bpy.data.filepath))


@persistent
def after_import(context, *_):
    """Scenes and node trees that were appended: their paths start at this file now, and no two pictures share an id."""
    here = os.path.dirname(bpy.data.filepath)
    came = [item.id for item in context.import_items]
    for item in context.import_items:
        thing = item.id
        if thing is None or thing.library is not None or item.source_library is None:
            continue
        there = os.path.dirname(os.path.abspath(bpy.path.abspath(item.source_library.filepath)))
        if item.id_type == "NODETREE" and _is_ours(thing):
            paths.rebase(thing.stillwater, there, here)
            thing.stillwater.home = here
        if item.id_type == "SCENE":
            _take_in(thing, there, here, [scene for scene in bpy.data.scenes if scene not in came])


def _take_in(scene, there: str, here: str, others: list) -> None:
    with image.held():
        for picture in scene.stillwater.pictures:
            paths.rebase(picture, there, here)
    scene.stillwater.home = here
    migrate.upgrade(scene)
    for picture in scene.stillwater.pictures:
        image.take_over(picture)
        if any(other.id == picture.id for scene in others for other in scene.stillwater.pictures):
            picture.id = names.new_id()
            if picture.tree is not None:
                picture.tree.stillwater.picture, picture.tree.stillwater.scene = picture.id, scene.name
        names.rename_picture(picture)


HANDLERS = [
    ("save_pre", before_save),
    ("save_post", after_save),
    ("save_post_fail", after_failure),
    ("load_post", after_load),
    ("undo_post", after_undo),
    ("redo_post", after_undo),
    ("blend_import_post", after_import),
]
