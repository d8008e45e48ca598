"""The pictures of a folder, each with the label map that lies beside it."""

from __future__ import annotations

import re
from pathlib import Path

ENDINGS = {".png", ".jpg", ".jpeg", ".tif", ".tiff"}
MAP = re.compile(r"(^|_)(labels?|mask)(_|$)")


def is_map(path: Path) -> bool:
    """True of `labels`, `NAME_mask`, `mask_how`."""
    return bool(MAP.search(path.stem))


def own_maps(picture: Path, maps: list[Path]) -> list[Path]:
    """Maps named after this picture."""
    return [path for path in maps if path.stem in (f"{picture.stem}_mask", f"{picture.stem}_labels")]


def pictures_with_maps(folder: Path) -> list[tuple[Path, Path]]:
    """In every folder below: NAME with NAME_mask; one picture of the rest with the first map that is nobody's."""
    found = []
    for place in sorted({path.parent for path in folder.rglob("*") if path.suffix.lower() in ENDINGS}):
        files = sorted(path for path in place.iterdir() if path.suffix.lower() in ENDINGS)
        maps, pictures = [p for p in files if is_map(p)], [p for p in files if not is_map(p)]
        paired = [(picture, own_maps(picture, maps)[0]) for picture in pictures if own_maps(picture, maps)]
        if not paired and maps and pictures:
            paired = [(pictures[0], maps[0])]
        found += paired
    return found


def name_of(picture: Path, folder: Path) -> str:
    """The picture's own name, with its folder's before it where that is below the given one."""
    place = picture.parent.relative_to(folder)
    return "_".join([*place.parts, picture.stem])
