"""Paths in our properties, which Blender leaves as they are when a file is saved or appended elsewhere."""

import os
from collections.abc import Iterator

from .walk import every


def each(group) -> Iterator[tuple]:
    """Every path below a property group, as (its group, its name)."""
    for owner, kind in every(group):
        if kind.type == "STRING" and kind.subtype in {"FILE_PATH", "DIR_PATH"}:
            yield owner, kind.identifier


def rebase(group, old: str, new: str) -> None:
    """Rewrites every path below `group` for a .blend that moves from folder `old` to folder `new`."""
    for owner, name in each(group):
        path = getattr(owner, name)
        moved = rebased(path, old, new)
        if moved != path:
            setattr(owner, name, moved)


def rebased(path: str, old: str, new: str) -> str:
    """The same place, seen from folder `new`; "" stands for a .blend that is not saved.

    Relative paths stay relative where they can. Absolute ones become so when the .blend is saved first.
    """
    if not path or (path.startswith("//") and not old):
        return path
    absolute = os.path.normpath(os.path.join(old, path[2:])) if path.startswith("//") else path
    if not new or (old and absolute is path):
        return absolute
    try:
        return "//" + os.path.relpath(absolute, new).replace(os.sep, "/")
    except ValueError:  # another drive
        return absolute
