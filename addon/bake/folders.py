"""Which folder below `stillwater/` is which picture's. Knows nothing of Blender.

`stillwater/pictures.json` says so by the pictures' permanent ids: renaming a picture moves nothing, and two files
beside each other whose pictures have one name do not write over each other's frames.
"""

import json
import os
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

INDEX = "pictures.json"


def folder_for(root: Path, identifier: str, name: str) -> Path:
    """The folder of a picture below `root`, which and whose index are made where they are missing. Throws OSError.

    A folder of its name that is nobody's yet becomes its own.
    """
    known = _read(root)
    if identifier not in known:
        base = re.sub(r"[^\w.-]+", "_", name) or "picture"
        taken, own, count = {place.lower() for place in known.values()}, base, 0
        while own.lower() in taken:
            count += 1
            own = f"{base}.{count:03d}"
        _write(root, {**known, identifier: own})
    else:
        own = known[identifier]
    (root / own).mkdir(parents=True, exist_ok=True)
    return root / own


def known_folder(root: Path, identifier: str) -> Path | None:
    """The folder of a picture that has one already."""
    name = _read(root).get(identifier)
    return root / name if name and (root / name).is_dir() else None


def forget(root: Path, identifier: str) -> None:
    """The picture has no folder any more. Leaves no empty folder behind. Throws OSError."""
    left = {key: name for key, name in _read(root).items() if key != identifier}
    if left:
        _write(root, left)
    else:
        (root / INDEX).unlink(missing_ok=True)
        _remove_empty(root)


def move(source: Path, target: Path) -> None:
    """Moves what lies in one folder into another, over what has the same names there. Throws OSError."""
    target.mkdir(parents=True, exist_ok=True)
    for item in sorted(source.iterdir()):
        there = target / item.name
        if there.is_dir():
            shutil.rmtree(there)
        shutil.move(item, there)
    source.rmdir()


@dataclass(frozen=True)
class Files:
    """What lies on disk for one picture: its folder with recipe and cache, the folder of its frames, their name."""

    folder: Path
    frames: Path
    name: str
    identifier: str  # the picture's

    def found(self) -> list[Path]:
        """Every file and folder of these; nothing that somebody else put there."""
        numbered = re.compile(re.escape(self.name) + r"_\d{4,}\.exr")
        frames = [path for path in _inside(self.frames) if numbered.fullmatch(path.name)]
        ours = [self.folder / name for name in ("recipe.json", ".stillwater-cache")]
        return [path for path in ours if path.exists()] + frames

    def delete(self) -> int:
        """Deletes them, and the folders that are empty then; returns how many there were. Throws OSError."""
        found = self.found()
        for path in found:
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        for folder in (self.frames, self.folder):
            _remove_empty(folder)
        if not self.folder.exists():
            forget(self.folder.parent, self.identifier)
        return len(found)


def _inside(folder: Path) -> list[Path]:
    return sorted(folder.iterdir()) if folder.is_dir() else []


def _remove_empty(folder: Path) -> None:
    if folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()


def _read(root: Path) -> dict[str, str]:
    """Ids and folders. An index that is no index counts as none: folders of the pictures' names are found again."""
    try:
        known = json.loads((root / INDEX).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return known if isinstance(known, dict) and all(isinstance(name, str) for name in known.values()) else {}


def _write(root: Path, known: dict[str, str]) -> None:
    root.mkdir(parents=True, exist_ok=True)
    unfinished = root / f"{INDEX}.part"
    unfinished.write_text(json.dumps(known, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    os.replace(unfinished, root / INDEX)
