"""Fillings of the engine beside those of others, to be looked at, and their figures.

    build/venv/bin/python tests/looks/compare_fills.py --output build/looks/fills FOLDER...

Pictures with a mask beside them (imageN and maskN, NAME_raw and NAME_mask) are filled there; into all others a hole is
cut, at most --cut of them, evenly chosen. The straight set of tests/layers/test_inpaint.py comes along. The others:
G'MIC's inpaint and inpaint_matchpatch (Debian's gmic), cv::xphoto's shift map and PyPatchMatch, in an environment
of their own. Who is not there is left out, and said. Sheets lie in the output's folder: picture, then ours, then the others.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
import venv
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy: its threads wait busily where others work

import numpy as np
import stillwater
from fill_figures import Figures, Mask, Picture, figures_of
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "layers"))
from test_inpaint import DISC, STRAIGHT  # noqa: E402

LONGEST_SIDE = 640  # pixels
SHOWN_MARGIN = 50  # around the hole, pixels
ROW_HEIGHT, ROWS, GAP = 260, 4, 4

SHIFT_MAP = """
import cv2, numpy as np, sys
picture, hole = cv2.imread(sys.argv[1]), cv2.imread(sys.argv[2], 0)
lab, out = cv2.cvtColor(picture, cv2.COLOR_BGR2Lab), np.zeros_like(picture)
cv2.xphoto.inpaint(lab, 255 - hole, out, cv2.xphoto.INPAINT_SHIFTMAP)
cv2.imwrite(sys.argv[3], cv2.cvtColor(out, cv2.COLOR_Lab2BGR))
"""
PATCH_MATCH = """
import cv2, sys
from patchmatch import patch_match
cv2.imwrite(sys.argv[3], patch_match.inpaint(cv2.imread(sys.argv[1]), cv2.imread(sys.argv[2], 0), patch_size=9))
"""


@dataclass(frozen=True)
class Case:
    """A picture with a hole; `truth`: was the hole cut, so that the picture tells what was in it?"""

    name: str
    picture: Picture
    hole: Mask
    truth: bool


def read(path: Path, mode: str = "RGB") -> Image.Image:
    image = Image.open(path).convert(mode)
    image.thumbnail((LONGEST_SIDE, LONGEST_SIDE), Image.Resampling.LANCZOS)
    return image


def as_array(image: Image.Image) -> Picture:
    return np.asarray(image, np.float32) / 255


def as_image(picture: Picture) -> Image.Image:
    return Image.fromarray((np.clip(picture, 0, 1) * 255 + 0.5).astype(np.uint8))


def lobed(shape: tuple[int, ...], seed: int) -> Mask:
    """A round hole with lobes, near the middle."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[: shape[0], : shape[1]]
    along, across = (x / shape[1] - rng.uniform(0.4, 0.6)) / 0.11, (y / shape[0] - rng.uniform(0.4, 0.6)) / 0.16
    angle = np.arctan2(across, along)
    return np.hypot(along, across) < 1 + sum(
        rng.normal(0, 0.12) * np.cos(k * angle + rng.uniform(0, 6.28)) for k in range(2, 7)
    )


def cases_in(folders: list[Path], cut: int) -> Iterator[Case]:
    paths = sorted(
        path for folder in folders for path in folder.rglob("*") if path.suffix.lower() in (".jpg", ".jpeg", ".png")
    )
    whole = []
    for path in paths:
        mask = path.with_name(
            re.sub(r"image(?=\d)|_raw\b", lambda m: m[0].replace("image", "mask").replace("raw", "mask"), path.name)
        )
        if mask == path:
            whole.append(path)
        elif mask.exists():
            picture = as_array(read(path))
            hole = np.asarray(read(mask, "L").resize(picture.shape[1::-1], Image.Resampling.NEAREST)) >= 128
            yield Case(path.stem, picture, hole, False)
    whole = [path for path in whole if not re.search(r"mask|input|output|points|filled", path.name)]
    for seed in np.unique(np.linspace(0, len(whole) - 1, min(cut, len(whole))).round().astype(int)):
        picture = as_array(read(whole[seed]))
        yield Case(whole[seed].stem, picture, lobed(picture.shape, int(seed)), True)


def straight_cases() -> Iterator[Case]:
    for name, (shade, _) in STRAIGHT.items():
        yield Case(name, np.repeat(shade[..., None], 3, axis=2).astype(np.float32), DISC, True)


def by_program(command: Callable[[str, str, str], list[str]]) -> Callable[[Picture, Mask], Picture]:
    """A filling by a program that reads a picture and a mask, and writes a picture."""

    def fill(picture: Picture, hole: Mask) -> Picture:
        with tempfile.TemporaryDirectory() as folder:
            files = [f"{folder}/{name}.png" for name in ("picture", "hole", "out")]
            as_image(np.where(hole[..., None], 0, picture)).save(files[0])
            as_image(hole.astype(np.float32)).save(files[1])
            subprocess.run(command(*files), capture_output=True, check=True, timeout=600)
            return np.where(hole[..., None], as_array(Image.open(files[2]).convert("RGB")), picture)

    return fill


def others(environment: Path) -> dict[str, Callable[[Picture, Mask], Picture]]:
    """Those that are here, by name."""
    python = environment / "bin" / "python"
    if not python.exists():
        venv.create(environment, with_pip=True)
        for package in ("opencv-contrib-python-headless", "PyPatchMatch"):
            subprocess.run([python, "-m", "pip", "install", "--quiet", package], check=False)

    def gmic(method: str):
        return by_program(lambda picture, hole, out: ["gmic", picture, hole, method, "[1]", "keep[0]", "output", out])

    def patches(picture: str, hole: str, out: str) -> list[str]:
        return ["gmic", picture, hole, "inpaint[0]", "[1],11,22,0.5,1,9,0,0.05,10,1", "keep[0]", "output", out]

    found = {
        "matchpatch": gmic("inpaint_matchpatch[0]"),
        "G'MIC inpaint": by_program(patches),
        "shift map": by_program(lambda *files: [str(python), "-c", SHIFT_MAP, *files]),
        "PyPatchMatch": by_program(lambda *files: [str(python), "-c", PATCH_MATCH, *files]),
    }
    picture, hole = np.random.default_rng(1).random((64, 64, 3), np.float32), np.zeros((64, 64), bool)
    hole[28:36, 28:36] = True
    for name in list(found):
        try:
            found[name](picture, hole)
        except (OSError, subprocess.SubprocessError) as error:
            print(f"without {name}: {type(error).__name__}", file=sys.stderr)
            del found[name]
    return found


def shown(case: Case, pictures: list[Picture]) -> Image.Image:
    """The hole and what surrounds it, of each picture side by side."""
    rows, columns = np.flatnonzero(case.hole.any(axis=1)), np.flatnonzero(case.hole.any(axis=0))
    part = tuple(slice(max(0, a[0] - SHOWN_MARGIN), a[-1] + SHOWN_MARGIN) for a in (rows, columns))
    cells = [as_image(picture[part]) for picture in pictures]
    cells = [cell.resize((round(cell.width * ROW_HEIGHT / cell.height), ROW_HEIGHT)) for cell in cells]
    strip = Image.new("RGB", (sum(cell.width + GAP for cell in cells), ROW_HEIGHT + GAP))
    for i, cell in enumerate(cells):
        strip.paste(cell, (sum(c.width + GAP for c in cells[:i]), 0))
    return strip


def write_sheets(strips: list[Image.Image], folder: Path) -> None:
    for number, start in enumerate(range(0, len(strips), ROWS)):
        some = strips[start : start + ROWS]
        sheet = Image.new("RGB", (max(strip.width for strip in some), sum(strip.height for strip in some)))
        for i, strip in enumerate(some):
            sheet.paste(strip, (0, sum(s.height for s in some[:i])))
        sheet.save(folder / f"fills_{number}.png")


def report(title: str, results: dict[str, list[Figures]], seconds: dict[str, float]) -> None:
    print(f"{title:<28}{'coherence':>10}{'repetition':>12}{'error':>9}{'seconds':>9}")
    for name, figures in results.items():
        error = [f.error for f in figures if not np.isnan(f.error)]
        means = np.mean([f.coherence for f in figures]), np.mean([f.repetition for f in figures])
        mean = np.mean(error) if error else np.nan
        print(f"  {name:<26}{means[0]:>10.2f}{means[1]:>12.3f}{mean:>9.4f}{seconds[name]:>9.1f}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--cut", type=int, default=20, help="how many holes are cut (20)")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    fills = {
        "stillwater": lambda picture, hole: stillwater.inpaint(picture, hole)[..., :3],
        **others(given.output / "venv"),
    }
    strips = []
    for title, cases in (("pictures", cases_in(given.folders, given.cut)), ("straight", straight_cases())):
        results, seconds = defaultdict(list), defaultdict(float)
        for case in cases:
            pictures = [np.where(case.hole[..., None], np.float32([1, 0, 1]), case.picture)]
            for name, fill in fills.items():
                start = time.perf_counter()
                pictures.append(fill(case.picture, case.hole))
                seconds[name] += time.perf_counter() - start
                results[name].append(figures_of(pictures[-1], case.hole, case.picture if case.truth else None))
            strips.append(shown(case, pictures))
        report(title, results, seconds)
    write_sheets(strips, given.output)


if __name__ == "__main__":
    main()
