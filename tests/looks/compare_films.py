"""Films by one clip beside how the clip itself goes on, in figures and on sheets.

The picture is a frame of the clip; the example is what comes before it. Flow strokes are drawn along the clip's own mean
flow, where it moves. Three films are measured against what comes after the frame: ours,
the live loop, and a plain cross-faded advection.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from pathlib import Path

import film_figures as figures
import numpy as np
import stillwater
from PIL import Image
from scipy.ndimage import binary_dilation, binary_opening, gaussian_filter
from stillwater import _stillwater as engine
from stillwater.recipe import load
from stillwater.render.loop import Order, render

ROWS = 5  # of a sheet: what comes after, and the films
SHOWN = 6
LONGEST = 480  # px
LEAST_SPEED = 0.05  # px/frame
PERIOD = 48.0
MEASURES = {
    "rhythm (dB)": figures.spectrum_off,
    "speed (px/frame)": figures.speeds_off,
    "texture (deviations)": figures.bands_off,
}
LUMA = np.array([0.2126, 0.7152, 0.0722], np.float32)


def moving_part(frames: np.ndarray) -> np.ndarray:
    """Where a clip moves, and a little around it."""
    change = gaussian_filter(np.abs(np.diff(frames @ LUMA, axis=0)).mean(axis=0), 2)
    moves = binary_opening(change > 0.15 * np.quantile(change, 0.98), iterations=2)
    return binary_dilation(moves, iterations=6)


def strokes_along(velocity: np.ndarray, mask: np.ndarray, most: int = 30) -> list[dict]:
    """Strokes as an artist would draw them along a flow: spread over the mask, each as long as some 15 frames' way."""
    speed = np.hypot(velocity[..., 0], velocity[..., 1])
    places = np.argwhere(mask & (speed > LEAST_SPEED))
    if not len(places):
        return []
    rng, chosen = np.random.default_rng(0), []
    for y, x in rng.permutation(places):
        if all(np.hypot(x - a, y - b) > np.sqrt(mask.sum() / most) for a, b in chosen):
            chosen.append((x, y))
    strokes = []
    for x, y in chosen[:most]:
        line, place = [[float(x), float(y)]], np.array([x, y], float)
        for _ in range(12):
            at = tuple(np.clip(np.round(place[::-1]).astype(int), 0, np.array(mask.shape) - 1))
            step = velocity[at] / max(speed[at], 1e-6)
            place = place + 3 * step
            line.append(place.tolist())
        strokes.append({"points": line, "width": 12, "speed": float(min(speed[y, x], 1000))})
    return strokes


def recipe_film(folder: Path, picture, mask, motion: dict, frames: int, fps: float) -> np.ndarray:
    """The film of a recipe, frames x height x width x 3."""
    folder.mkdir()
    Image.fromarray((255 * picture).round().astype(np.uint8)).save(folder / "picture.png")
    Image.fromarray((255 * mask).astype(np.uint8)).save(folder / "matte.png")
    layers = [{"name": "fluid", "matte": {"file": "matte.png"}, "fill": {"method": "none"}, "motion": motion}, {"name": "rest"}]
    recipe = {"stillwater": 1, "picture": "picture.png", "frames": [1, frames], "fps": fps, "layers": layers}
    (folder / "recipe.json").write_text(json.dumps(recipe))
    film = []
    for event in render(load(folder / "recipe.json"), Order()):
        if hasattr(event, "path") and hasattr(event, "frame"):
            film.append(engine.read_frame(event.path)[..., :3])
    return np.array(film)


def plain_advection(picture, flow, frames: int) -> np.ndarray:
    """Two copies, carried along the flow and cross-faded by turns."""
    film = []
    for t in range(frames):
        sum_, weights = 0, 0
        for phase in (0, 0.5):
            share = (t / PERIOD + phase) % 1
            weight = 1 - abs(2 * share - 1)
            sum_ = sum_ + weight * stillwater.advect(picture, flow, (share - 0.5) * PERIOD)[..., :3]
            weights += weight
        film.append(sum_ / weights)
    return np.array(film)


def films_of(path: Path, folder: Path, frames: int):
    """What comes after, and the films by name; and the mask."""
    clip = engine.Clip(str(path))
    scale = min(1, LONGEST / max(clip.width, clip.height))
    size = (round(clip.width * scale), round(clip.height * scale))
    half = clip.frames // 2
    real = stillwater.read_clip(path, (half + 1, min(clip.frames, half + frames)), size)
    before = stillwater.read_clip(path, (1, half), size)
    frames, picture = len(real), before[-1]
    mask = moving_part(before)
    found = stillwater.analyse(path, (1, half))
    flow = np.stack([_resized(found.velocity[..., k], size) * size[0] / found.velocity.shape[1] for k in (0, 1)], axis=-1)
    fps = found.fps or clip.fps
    strokes = strokes_along(flow, mask)
    common = {"strokes": strokes, "refine": {"amount": 0}}
    example = {"type": "example", "clip": str(path.resolve()), "clip_frames": [1, half],
               "life": max(1, min(16, half - 2)), "clip_scale": size[0] / clip.width, **common}  # fmt: skip
    films = {
        "ours": recipe_film(folder / "ours", picture, mask, example, frames, fps),
        "live loop": recipe_film(folder / "loop", picture, mask, {"type": "flow", "period": PERIOD, **common}, frames, fps),
        "plain advection": plain_advection(picture, flow, frames),
    }
    return real, films, mask


def _resized(plane, size):
    return np.asarray(Image.fromarray(plane).resize(size, Image.BILINEAR))


def sheet(path: Path, real, films) -> None:
    rows = [real, *films.values()]
    columns = np.linspace(0, min(map(len, rows)) - 1, SHOWN).astype(int)
    page = np.concatenate([np.concatenate([row[i] for i in columns], axis=1) for row in rows], axis=0)
    Image.fromarray((255 * np.clip(page, 0, 1)).round().astype(np.uint8)).save(path)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("clips", nargs="+", type=Path)
    parser.add_argument("--output", type=Path, default=Path("build/looks/films"))
    parser.add_argument("--frames", type=int, default=64)
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    header = "".join(f"{name:>22}" for name in [*MEASURES, "stuck (of the clip's)", "grid (of the pic.'s)", "flicker (of the c.'s)"])
    print(f"{'clip':32}{'film':18}{header}")
    nearer = True
    for path in given.clips:
        with tempfile.TemporaryDirectory() as folder:
            real, films, mask = films_of(path, Path(folder), given.frames)
        sheet(given.output / f"{path.stem}.png", real, films)
        grey = real @ LUMA
        stuck, off = figures.stuck(grey, mask), {}
        for name, film in films.items():
            film = film @ LUMA
            off[name] = [measure(film, grey, mask) for measure in MEASURES.values()]
            besides = figures.stuck(film, mask) / stuck, figures.grid(film, real[0] @ LUMA, mask), figures.flicker(film, grey, mask)
            numbers = "".join(f"{value:22.3f}" for value in [*off[name], *besides])
            print(f"{path.stem[:30]:32}{name:18}{numbers}", flush=True)
        nearer = nearer and all(a < b for a, b in zip(off["ours"], off["plain advection"], strict=True))
    print("ours is nearer than plain advection", "in each" if nearer else "but not in each")
    return 0


if __name__ == "__main__":
    sys.exit(main())
