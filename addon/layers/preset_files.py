"""Presets as files: what makes a motion, or the wind, look like something at once.

They lie in Blender's own preset folders, under presets/stillwater/KIND, as JSON with the recipe's names and units: ours
in the extension, an artist's own in the user's scripts. A file is a preset of one kind and never says where a layer is:

    {"stillwater_preset": 1, "kind": "sway", "description": "Leaves stir", "numbers": {"frequency": 0.5}}

With "size", [width, height], numbers that go with the picture are those of a picture so large: lengths are scaled by the
side of a square as large, a grid has its cells of the same size.
"""

import json
import math
import os
from dataclasses import dataclass
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_

from ..properties import motions, names
from ..recipe.numbers import kept, plain

SHIPPED = Path(__file__).resolve().parent  # holds presets/stillwater/KIND
KINDS = (*(kind for kind in motions.ICONS if kind != "still"), "wind")
APART = {*motions.PLACES, "direction"}  # belongs to one picture
SCALED, MOST_CELLS = {"refine_width", "average_blur"}, 64
OF_A_SIZE = ("example",)  # kinds whose presets say for which size they are


@dataclass(frozen=True)
class Preset:
    """A preset as its file says it."""

    name: str
    kind: str
    description: str
    numbers: dict
    size: tuple[int, int] | None = None  # px, of the picture that they were made for

    def scaled(self, size: tuple[int, int]) -> dict:
        """The numbers for a picture of another size."""
        if self.size is None or 0 in size:
            return self.numbers
        across, down = (new / old for new, old in zip(size, self.size, strict=True))
        made = dict(self.numbers)
        for name in SCALED & made.keys():
            made[name] *= (across * down) ** 0.5
        if "grid" in made:
            made["grid"] = [min(max(1, round(c * f)), MOST_CELLS) for c, f in zip(made["grid"], (across, down), strict=True)]
        return made


def paths(kind: str) -> list[Path]:
    """The files of all presets of a kind, ours first."""
    folders = [Path(folder) for folder in bpy.utils.preset_paths(f"stillwater/{kind}")]
    files = [file for folder in folders for file in folder.glob("*.json")]
    return sorted(files, key=lambda file: (not is_shipped(file), file.stem.lower()))


def is_shipped(path: Path) -> bool:
    return path.is_relative_to(SHIPPED)


def folder(kind: str) -> Path:
    """Where an artist's own presets of a kind lie. Throws OSError where that can't be made."""
    made = bpy.utils.user_resource("SCRIPTS", path=os.path.join("presets", "stillwater", kind), create=True)
    if not made:
        sentence = "The folder of your presets can't be made; set Script Directories in the preferences' File Paths"
        raise OSError(rpt_(sentence))
    return Path(made)


def name_of(path: Path | str) -> str:
    """A preset's name, as its file has it."""
    return bpy.path.display_name(Path(path).stem, has_ext=False, title_case=False)


def read(path: Path | str) -> Preset:
    """Throws ValueError and OSError with a sentence."""
    try:
        said = json.loads(Path(path).read_text(encoding="utf-8"))
        kind, description = said["kind"], said.get("description", "")
        preset = Preset(name_of(path), kind, description, dict(said["numbers"]), _size(said.get("size")))
    except FileNotFoundError as error:
        raise OSError(rpt_("{path}: there is no such preset").format(path=path)) from error
    except (ValueError, KeyError, TypeError) as error:
        raise ValueError(rpt_("{name}: is not a preset of Stillwater").format(name=Path(path).name)) from error
    if said.get("stillwater_preset") != 1 or preset.kind not in KINDS:
        raise ValueError(rpt_("{name}: is a preset of another version of Stillwater").format(name=Path(path).name))
    return preset


def description_of(path: str) -> str:
    """What a preset says about itself, for its tooltip; empty where it can't be read."""
    try:
        return tip_(read(path).description) if path else ""
    except (ValueError, OSError):
        return ""


def check(group, preset: Preset) -> None:
    """Throws ValueError for the first number that `group` can't have."""
    for name, value in preset.numbers.items():
        kind = group.bl_rna.properties.get(name)
        if name not in type(group).__annotations__ or kind is None or name in APART:
            sentence = rpt_("{preset}: {kind} has no {name} that a preset could set")
            raise ValueError(sentence.format(preset=preset.name, kind=preset.kind, name=name))
        if not _fits(kind, value):
            sentence = rpt_("{preset}: {name} can't be {value!r}")
            raise ValueError(sentence.format(preset=preset.name, name=name, value=value))


def apply(group, preset: Preset) -> None:
    """Sets a group's numbers; those that the preset does not name get their defaults, places and seeds stay.

    Throws ValueError before anything is changed.
    """
    check(group, preset)
    for name in _names(group):
        group.property_unset(name)
    numbers = preset.scaled(tuple(names.picture_of(group).picture_size)) if preset.size else preset.numbers
    for name, value in numbers.items():
        kind = group.bl_rna.properties[name]
        if kind.type == "FLOAT" and not kind.is_array:
            value = kept(value, kind.subtype)
        setattr(group, name, str(value) if kind.type == "ENUM" else value)


def write(kind: str, name: str, group, description: str = "") -> Path:
    """Saves what `group` says as one of the artist's own. Throws ValueError, OSError with a sentence."""
    stem = bpy.path.display_name_to_filepath(name.strip())
    stem = "".join(letter if letter.isalnum() or letter in "_-+" else "_" for letter in stem).strip("_")
    if not stem:
        raise ValueError(rpt_("Give the preset a name first"))
    if stem.lower() in {path.stem.lower() for path in paths(kind)}:
        raise ValueError(rpt_('"{name}" exists already; choose another name, or remove it first').format(name=name))
    numbers = {field: _plain(group, field) for field in _names(group)}
    said = {"stillwater_preset": 1, "kind": kind, "description": description, "numbers": numbers}
    if kind in OF_A_SIZE and all(size := names.picture_of(group).picture_size):
        said["size"] = list(size)
    path = folder(kind) / f"{stem}.json"
    unfinished = path.with_suffix(".part")
    unfinished.write_text(json.dumps(said, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    unfinished.replace(path)
    return path


def _size(said) -> tuple[int, int] | None:
    """Of a picture, as a file says it. Throws TypeError, ValueError where it is none."""
    if said is None:
        return None
    width, height = said
    if min(width, height) < 1:
        raise ValueError(said)
    return width, height


def _names(group) -> list[str]:
    return [name for name in type(group).__annotations__ if name not in APART]


def _plain(group, name: str):
    value, kind = getattr(group, name), group.bl_rna.properties[name]
    if kind.type != "FLOAT":
        return list(value) if getattr(kind, "is_array", False) else value
    return [plain(part) for part in value] if kind.is_array else plain(value, kind.subtype)


def _fits(kind, value) -> bool:
    if kind.type == "ENUM":
        return str(value) in kind.enum_items
    if kind.type == "BOOLEAN":
        return isinstance(value, bool)
    values = value if isinstance(value, list) else [value]
    numbers = all(isinstance(part, int | float) and not isinstance(part, bool) for part in values)
    if not numbers or len(values) != (kind.array_length or 1) or isinstance(value, list) != kind.is_array:
        return False
    degrees = kind.subtype == "ANGLE"
    low, high = (math.degrees(limit) if degrees else limit for limit in (kind.hard_min, kind.hard_max))
    return all(low * (1 - 1e-6 * (low > 0)) <= part <= high for part in values)
