"""`campfire`'s clip: a fire of Mantaflow on black, seen from the front by a camera that stands still.

    blender --background --factory-startup --python-exit-code 1 --python blend_samples/campfire/clip.py -- [--output FILE]

A real Blender (3.4 or later) with numpy in its Python, and ffmpeg.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

from models.fluid import baked, ball, domain, source, volume, write_clip  # noqa: E402

LOW, HIGH = (-1.0, -0.5, 0.0), (1.0, 0.5, 2.6)
LEFT, RIGHT, FOOT, TOP = -0.86, 0.86, 0.06, 2.296  # what is in the picture, metres
WIDTH, HEIGHT = 200, 260
FIRST, FRAMES = 50, 96  # the fire burns evenly from FIRST on
# Emission by how much of the fuel is still to burn, 0..1: black body colours, linear.
HEAT = (0.0, 0.12, 0.35, 0.6, 0.85, 1.0)
GLOW = np.array([[0, 0, 0], [0.12, 0.008, 0.0004], [1.0, 0.10, 0.003], [2.4, 0.42, 0.014], [3.4, 0.9, 0.05], [3.8, 1.5, 0.2]])


def kindle(cells: int):
    """The domain with six places that burn, each strong and weak in its own time."""
    rng = np.random.default_rng(1903)
    room, settings = domain("GAS", LOW, HIGH, cells, (1, FIRST + FRAMES - 1))
    settings.alpha, settings.beta = 0.4, 1.6
    settings.vorticity = 0.25
    settings.burning_rate = 0.42
    settings.flame_smoke = 0.15
    settings.flame_vorticity = 0.55
    settings.flame_ignition, settings.flame_max_temp = 1.25, 2.6
    settings.use_noise, settings.noise_scale, settings.noise_strength = True, 2, 0.8
    settings.use_dissolve_smoke, settings.dissolve_speed = True, 12
    for k, x in enumerate((-0.40, -0.22, -0.05, 0.12, 0.30, 0.43)):
        fuel = source(ball("fuel", (x, rng.uniform(-0.14, 0.14), 0.06), (0.13, 0.13, 0.06)), "FIRE")
        fuel.use_initial_velocity = True
        for frame in range(1, FIRST + FRAMES + 12, 6):
            fuel.fuel_amount = rng.uniform(0.35, 1.15) * (1 - 1.3 * abs(x))
            fuel.velocity_coord = (rng.normal(0, 0.25), rng.normal(0, 0.2), rng.uniform(0.1, 0.6))
            fuel.keyframe_insert("fuel_amount", frame=frame)
            fuel.keyframe_insert("velocity_coord", frame=frame)
    return room


def resized(size: int, cells: int, first: float, last: float) -> np.ndarray:
    """The matrix (size, cells) that makes `size` pixels of what lies from share `first` to share `last` of a row of
    cells, cubic (Catmull and Rom)."""
    at = ((np.arange(size) + 0.5) / size * (last - first) + first) * cells - 0.5
    low = np.floor(at).astype(int)
    t = at - low
    weights = (-0.5 * t + t**2 - 0.5 * t**3, 1 - 2.5 * t**2 + 1.5 * t**3, 0.5 * t + 2 * t**2 - 1.5 * t**3, -0.5 * t**2 + 0.5 * t**3)
    matrix = np.zeros((size, cells))
    for k, weight in enumerate(weights):
        np.add.at(matrix, (np.arange(size), np.clip(low + k - 1, 0, cells - 1)), weight)
    return matrix


def seen(flame: np.ndarray) -> np.ndarray:
    """Display values of a flame grid (z, y, x): what glows is added up along the line of sight."""
    depth = (HIGH[1] - LOW[1]) / flame.shape[1]
    light = np.stack([np.interp(flame, HEAT, GLOW[:, c]).sum(axis=1) * depth for c in range(3)], axis=-1)
    rows = resized(HEIGHT, light.shape[0], (TOP - LOW[2]) / (HIGH[2] - LOW[2]), (FOOT - LOW[2]) / (HIGH[2] - LOW[2]))
    columns = resized(WIDTH, light.shape[1], (LEFT - LOW[0]) / (HIGH[0] - LOW[0]), (RIGHT - LOW[0]) / (HIGH[0] - LOW[0]))
    light = np.einsum("ij,jkc,lk->ilc", rows, light, columns, optimize=True)
    light = 1 - np.exp(-2.6 * np.clip(light, 0, None))
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-6) ** (1 / 2.4) - 0.055)


def main() -> None:
    arguments = argparse.ArgumentParser(description="Makes the campfire's clip.")
    arguments.add_argument("--output", type=Path, default=HERE / "clip.mp4")
    arguments.add_argument("--cells", type=int, default=64, help="along the domain's height")
    given = arguments.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])
    write_clip([seen(volume(air, "flame")) for _, air in baked(kindle(given.cells), FIRST)], given.output)


if __name__ == "__main__":
    main()
