"""Ours beside PyMatting's closed form, on pictures whose true mattes are known. Called by tests/mattes.sh.

The folder holds input, gt, trimap1, trimap2 (as alphamatting.com's training set), or has such a folder somewhere below.
For each picture and trimap: SAD, MSE, gradient and connectivity error of both, then sums and ratios. With --output,
a sheet of each: picture, trimap, truth, ours over a checker, the true matte's and ours' difference, and theirs.
"""

from __future__ import annotations

import argparse
import sys
import warnings
from pathlib import Path

import numpy as np
import pymatting
import stillwater
from matte_errors import Errors, errors
from PIL import Image

FIGURES = ("sad", "mse", "gradient", "connectivity")
WORSE, BETTER = 1.01, 0.95  # on no picture, in sum


def grey(path: Path) -> np.ndarray:
    return np.asarray(Image.open(path).convert("L"), np.float32) / 255


def pictures(folder: Path):
    """Name, picture, true matte and trimap of each."""
    for truth in sorted(folder.rglob("gt/*.png")):
        place = truth.parent.parent
        picture = np.asarray(Image.open(place / "input" / truth.name).convert("RGB"), np.float32) / 255
        for kind in ("trimap1", "trimap2"):
            if (place / kind / truth.name).exists():
                yield f"{truth.stem} {kind}", picture, grey(truth), grey(place / kind / truth.name)


def their_matte(picture: np.ndarray, trimap: np.ndarray) -> np.ndarray:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that its incomplete Cholesky is tried again
        return pymatting.estimate_alpha_cf(picture.astype(float), trimap.astype(float)).astype(np.float32)


def sheet(picture, trimap, truth, ours, theirs) -> Image.Image:
    y, x = np.mgrid[: truth.shape[0], : truth.shape[1]]
    checker = np.where((x // 16 + y // 16) % 2, 0.75, 0.45)[..., None]
    front, _ = stillwater.foreground(picture, ours)
    over = ours[..., None] * front + (1 - ours[..., None]) * checker
    three = [np.repeat(plane[..., None], 3, axis=2) for plane in (trimap, ours)]
    off = [np.repeat(np.abs(matte - truth)[..., None] * 2, 3, axis=2) for matte in (ours, theirs)]
    rows = [np.concatenate(row, axis=1) for row in ([picture, three[0], over], [three[1], *off])]
    return Image.fromarray((np.concatenate(rows).clip(0, 1) * 255).astype(np.uint8))


def line(name: str, ours: Errors, theirs: Errors) -> str:
    pairs = ((getattr(ours, figure), getattr(theirs, figure)) for figure in FIGURES)
    return f"{name:<24}" + "".join(f"{a:>10.4f}{b:>10.4f}{a / b if b else 1:>7.3f}" for a, b in pairs)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, metavar="DIR", help="folder of the sheets")
    parser.add_argument("--method", choices=("closed-form", "bayesian"), default="closed-form")
    parser.add_argument("folder", type=Path)
    given = parser.parse_args()
    print(f"{'ours, theirs, ratio':<24}" + "".join(f"{figure:>27}" for figure in FIGURES))
    whole, their_whole, worst = Errors(0, 0, 0, 0), Errors(0, 0, 0, 0), 0.0
    for name, picture, truth, trimap in pictures(given.folder):
        ours, theirs = stillwater.matte(picture, trimap, given.method), their_matte(picture, trimap)
        unknown = (trimap > 0.1) & (trimap < 0.9)
        found, their_errors = errors(ours, truth, unknown), errors(theirs, truth, unknown)
        whole, their_whole = whole + found, their_whole + their_errors
        worst = max(worst, found.sad / their_errors.sad)
        print(line(name, found, their_errors), flush=True)
        if given.output:
            given.output.mkdir(parents=True, exist_ok=True)
            sheet(picture, trimap, truth, ours, theirs).save(given.output / f"{name.replace(' ', '_')}.png")
    if not worst:
        print(f"{given.folder}: no pictures with true mattes (input, gt, trimap1, trimap2)", file=sys.stderr)
        return 2
    print(line("sum", whole, their_whole))
    share = whole.sad / their_whole.sad
    reached = worst <= WORSE and share <= BETTER
    print(f"SAD in sum {share:.3f} of theirs ({BETTER} must be reached), at worst {worst:.3f} ({WORSE} may be): "
          f"{'reached' if reached else 'not reached'}")  # fmt: skip
    return 0 if reached else 1


if __name__ == "__main__":
    sys.exit(main())
