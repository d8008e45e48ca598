"""From a folder of pictures to a contact sheet of each. Called by tests/looks.sh."""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import stillwater
from contact_sheet import write_sheet
from find_pictures import ENDINGS, name_of, pictures_with_maps
from scene import Scene, scene_of_labels, scene_of_polygons, write_recipe

FRAMES = 24
TIME_LIMIT = 300  # seconds, one picture
POLYGONS = Path(__file__).with_name("polygons.json")


def scenes(folder: Path, names: list[str]) -> list[Scene]:
    """Every picture below that polygons are drawn for, and every other with a label map."""
    drawn = json.loads(POLYGONS.read_text(encoding="utf-8"))
    own = folder / "looks.json"
    if own.exists():
        drawn |= json.loads(own.read_text(encoding="utf-8"))
    maps = {picture: labels for picture, labels in pictures_with_maps(folder)}
    found = []
    for picture in sorted(path for path in folder.rglob("*") if path.suffix.lower() in ENDINGS):
        name = name_of(picture, folder)
        if names and name not in names:
            continue
        if name in drawn:
            found.append(scene_of_polygons(name, picture, drawn[name]))
        elif picture in maps:
            found.append(scene_of_labels(name, picture, maps[picture]))
    return found


def rendered(recipe: Path) -> np.ndarray | None:
    """The recipe's frames, or None where the engine refused or failed (it has said why)."""
    folder = recipe.parent / "frames"
    command = [sys.executable, "-m", "stillwater", "render", str(recipe), "--output", str(folder), "--fresh"]
    command += ["--progress", "none"]
    try:
        code = subprocess.run(command, timeout=TIME_LIMIT, stdin=subprocess.DEVNULL).returncode
    except subprocess.TimeoutExpired:
        print(f"{recipe}: not done after {TIME_LIMIT} s", file=sys.stderr)
        return None
    if code != 0:
        return None
    paths = [folder / f"frame_{number:04d}.exr" for number in range(1, FRAMES + 1)]
    return np.stack([stillwater.read(path)[..., :3] for path in paths])


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="*", help="only these")
    given = parser.parse_args()
    if not given.folder.is_dir():
        parser.error(f"{given.folder}: not a folder")
    found = scenes(given.folder.resolve(), given.names)
    if not found:
        parser.error(f"{given.folder}: no picture with a label map beside it, and none that polygons.json knows")
    failed = []
    for scene in found:
        recipe = write_recipe(scene, given.output / scene.name, FRAMES)
        frames = rendered(recipe)
        if frames is None:
            failed.append(scene.name)
            continue
        sheet = given.output / f"{scene.name}.png"
        write_sheet(scene, frames, sheet)
        print(sheet, flush=True)
    if failed:
        print(f"no sheet of {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
