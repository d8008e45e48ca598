"""`waterfall`'s clip: water of Mantaflow that falls over a ledge, seen from the front by a camera that stands still.

    blender --background --factory-startup --python-exit-code 1 --python blend_samples/waterfall/clip.py -- [--output FILE]

A real Blender (3.4 or later) with numpy in its Python, and ffmpeg.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from models.fluid import ball, baked, box, domain, drops, obstacle, source, write_clip  # noqa: E402

LOW, HIGH = (-2.0, -0.7, 0.0), (2.0, 0.7, 6.0)  # metres
FIRST, FRAMES = 56, 84  # the fall is whole from FIRST on

LEFT, RIGHT, TOP = -1.6, 1.6, 4.4  # what is in the picture, metres
WIDTH, HEIGHT = 240, 312
STREAK = 0.40  # metres a unit of Mantaflow's speed while the shutter is open
PARTS = 12  # dots that draw a drop out
CELL = 0.05  # metres, of the grid in which drops shade and hide each other
SHADE, HIDE, DENSITY = 0.02, 0.035, 0.95
ROCK, DIM, WHITE = np.array([[0.055, 0.065, 0.075], [0.40, 0.48, 0.55], [0.97, 0.98, 1.0]])  # display values


def spring(cells: int):
    """The domain: jets above the picture, each stronger and weaker in its own time, and humps that part and tear them."""
    rng = np.random.default_rng(1840)
    last = FIRST + FRAMES - 1
    room, settings = domain("LIQUID", LOW, HIGH, cells, (1, last))
    settings.use_mesh = False
    settings.particle_number, settings.particle_min, settings.particle_max = 3, 4, 30
    settings.particle_randomness = 0.8
    settings.flip_ratio = 0.99
    settings.time_scale = 0.5  # a fall twice as high in the same picture
    for x in np.linspace(-1.9, 1.9, 15):
        at = (x + rng.normal(0, 0.08), rng.uniform(-0.15, 0.1), rng.uniform(5.15, 5.35))
        obstacle(ball("hump", at, (rng.uniform(0.05, 0.12), 0.16, rng.uniform(0.05, 0.12))))
    for x in np.linspace(-1.8, 1.8, 13):
        jet = source(box("jet", (x - 0.11, -0.15, 5.55), (x + 0.11, 0.15, 5.85)), "LIQUID")
        jet.use_initial_velocity = True
        for frame in range(1, last + 8, 4):
            jet.velocity_coord = (rng.normal(0, 0.5), rng.normal(0.0, 0.5), rng.uniform(-4.2, -1.2))
            jet.keyframe_insert("velocity_coord", frame=frame)
    return room


def seen(at: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """Display values of drops at places (N, 3), drawn out along the way they go while the shutter is open.

    A drop is lit from the upper left in front, as far as the drops in between let the light through, and hides those behind.
    """
    x, y, z = (at - LOW).T / CELL
    size = np.ceil((np.array(HIGH) - LOW) / CELL).astype(int)
    crowd = np.zeros(size)
    np.add.at(crowd, tuple(np.clip(axis.astype(int), 0, n - 1) for axis, n in zip((x, y, z), size)), 1.0)
    crowd = softened(softened(crowd, 1.0, 0), 1.0, 2)
    lit, open_ = np.ones_like(crowd), np.ones_like(crowd)
    for k in range(1, size[1]):  # from the front to the back
        lit[:, k] = np.roll(lit[:, k - 1] * np.exp(-SHADE * crowd[:, k - 1]), (1, -1), (0, 1))
        open_[:, k] = open_[:, k - 1] * np.exp(-HIDE * crowd[:, k - 1])
    place = tuple(np.clip(axis.astype(int), 0, n - 1) for axis, n in zip((x, y, z), size))
    weight, shine = open_[place], lit[place] * open_[place]

    cover, light = np.zeros((2, HEIGHT * WIDTH))
    scale = WIDTH / (RIGHT - LEFT)
    for share in np.linspace(-0.5, 0.5, PARTS):
        px = ((at[:, 0] + share * STREAK * speed[:, 0] - LEFT) * scale).astype(int)
        py = ((TOP - at[:, 2] - share * STREAK * speed[:, 2]) * scale).astype(int)
        inside = np.flatnonzero((px >= 0) & (px < WIDTH) & (py >= 0) & (py < HEIGHT))
        pixel = py[inside] * WIDTH + px[inside]
        cover += np.bincount(pixel, weight[inside] / PARTS, WIDTH * HEIGHT)
        light += np.bincount(pixel, shine[inside] / PARTS, WIDTH * HEIGHT)
    cover, light = (softened(softened(plane.reshape(HEIGHT, WIDTH), 1.0, 0), 0.8, 1) for plane in (cover, light))
    tone = (light / np.maximum(cover, 1e-6))[..., None] ** 0.7
    veil = 1 - np.exp(-DENSITY * cover)[..., None]
    return ROCK + veil * (DIM + (WHITE - DIM) * tone - ROCK)


def softened(values: np.ndarray, sigma: float, axis: int) -> np.ndarray:
    """Gaussian blur along one axis, the border held."""
    reach = int(np.ceil(3 * sigma))
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    beyond = [(reach, reach) if k == axis else (0, 0) for k in range(values.ndim)]
    return np.apply_along_axis(np.convolve, axis, np.pad(values, beyond, mode="edge"), kernel / kernel.sum(), mode="valid")


def main() -> None:
    arguments = argparse.ArgumentParser(description="Makes the waterfall's clip.")
    arguments.add_argument("--output", type=Path, default=HERE / "clip.mp4")
    arguments.add_argument("--cells", type=int, default=104, help="along the domain's height")
    given = arguments.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    write_clip([seen(*drops(water)) for _, water in baked(spring(given.cells), FIRST)], given.output)


if __name__ == "__main__":
    main()
