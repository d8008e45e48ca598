"""A recipe and every file that it names in one folder or zip: a farm, or another person, renders it there.

    FOLDER/recipe.json      all its paths relative
    FOLDER/files/...        picture, mattes, fills
    FOLDER/frames/...       what is baked already

Knows nothing of Blender.
"""

import copy
import json
import os
import shutil
import tempfile
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

FILES = ("picture", "file", "labels", "trimap", "clip", "footage", "flow")  # fields of a recipe that name a file


def collect(
    recipe: dict, folder: Path, target: Path, frames: list[Path], said: Callable[[str], str] = str
) -> list[Path]:
    """Writes a recipe whose paths start at `folder`, its files and `frames` into `target`; returns what was written.

    `target` becomes a zip where it ends so, else it is a folder; neither is seen before it is whole. `said` puts
    sentences into the person's language. Throws ValueError where a file is missing or the folder is not empty, OSError.
    """
    missing = [str(place[name]) for place, name in files_of(recipe) if not (folder / place[name]).is_file()]
    if missing:
        raise ValueError(said("{path}: there is no such file").format(path=missing[0]))
    if target.is_dir() and any(target.iterdir()):
        raise ValueError(said("{path}: the folder is not empty; name a new one").format(path=target))
    target.parent.mkdir(parents=True, exist_ok=True)
    aside = Path(tempfile.mkdtemp(prefix=f".{target.name}-", dir=target.parent))
    aside.chmod(0o755)
    try:
        whole = aside / target.stem
        whole.mkdir()
        _fill(whole, recipe, folder, frames)
        written = [path.relative_to(whole) for path in sorted(whole.rglob("*")) if path.is_file()]
        if target.suffix.lower() == ".zip":
            _pack(aside / "whole.zip", whole)
            os.replace(aside / "whole.zip", target)
        else:
            if target.is_dir():
                target.rmdir()
            os.replace(whole, target)
    finally:
        shutil.rmtree(aside, ignore_errors=True)
    return written


def files_of(part) -> Iterator[tuple[dict, str]]:
    """Every place of a recipe that names a file: the part, and its field."""
    if isinstance(part, list):
        for item in part:
            yield from files_of(item)
    elif isinstance(part, dict):
        for name, value in part.items():
            if name in FILES and isinstance(value, str):
                yield part, name
            else:
                yield from files_of(value)


def _fill(whole: Path, recipe: dict, folder: Path, frames: list[Path]) -> None:
    recipe = copy.deepcopy(recipe)
    recipe["output"]["folder"] = "frames"
    names: dict[Path, str] = {}
    (whole / "files").mkdir()
    for part, field in files_of(recipe):
        source = (folder / part[field]).resolve()
        if source not in names:
            names[source] = _new_name(source.name, names.values())
            shutil.copy2(source, whole / names[source])
        part[field] = names[source]
    (whole / "frames").mkdir()
    for frame in frames:
        shutil.copy2(frame, whole / "frames" / frame.name)
    text = json.dumps(recipe, indent=1, ensure_ascii=False) + "\n"
    (whole / "recipe.json").write_text(text, encoding="utf-8")


def _new_name(name: str, taken) -> str:
    base, count = Path(name), 1
    candidate = f"files/{name}"
    while candidate.lower() in {other.lower() for other in taken}:
        count += 1
        candidate = f"files/{base.stem}-{count}{base.suffix}"
    return candidate


def _pack(path: Path, whole: Path) -> None:
    """Stored, not compressed: pictures are already."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_STORED) as archive:
        for file in sorted(whole.rglob("*")):
            archive.write(file, Path(whole.name, file.relative_to(whole)))
