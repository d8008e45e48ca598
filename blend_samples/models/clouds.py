"""Clouds: cumulus, heaps of balls on a flat base, and the long banks of an evening, a sheet of soft cover."""

import bpy
import numpy as np

from .materials import veil
from .meshes import mesh


def _ball(rings: int = 14, sectors: int = 22) -> tuple[np.ndarray, np.ndarray]:
    tilt = np.linspace(0, np.pi, rings + 1)
    turn = np.arange(sectors) * 2 * np.pi / sectors
    points = np.stack([np.sin(tilt)[:, None] * np.cos(turn), np.sin(tilt)[:, None] * np.sin(turn),
                       np.cos(tilt)[:, None] * np.ones(sectors)], axis=-1).reshape(-1, 3)
    r, s = np.meshgrid(np.arange(rings), np.arange(sectors), indexing="ij")
    low, high = r * sectors, (r + 1) * sectors
    faces = np.stack([low + s, high + s, high + (s + 1) % sectors, low + (s + 1) % sectors], axis=-1).reshape(-1, 4)
    return points, faces


def cumulus(name: str, at: tuple, width: float, height: float, material: bpy.types.Material,
            rng: np.random.Generator, heaps: int = 7) -> bpy.types.Object:
    """A cloud whose base's middle stands at `at`; all lengths in metres."""
    balls = []
    for k in range(heaps):
        side = (k + 0.5) / heaps * 2 - 1 + rng.uniform(-0.12, 0.12)
        tall = height * (0.35 + 0.65 * rng.uniform(0.4, 1)) * (1 - 0.75 * side * side)
        radius = max(tall * 0.5, height * 0.16)
        centre = np.array([side * width / 2, rng.uniform(-0.2, 0.2) * width / 3, radius * 0.55])
        balls.append((centre, radius))
        top = centre + [0, 0, max(tall - radius * 1.4, 0)]
        balls.append((top, radius * 0.72))
    for centre, radius in list(balls):
        for _ in range(13):
            away = rng.standard_normal(3)
            away[2] = abs(away[2]) * 0.9 - 0.15
            away /= np.linalg.norm(away)
            small = radius * rng.uniform(0.2, 0.46)
            spot = centre + away * radius * 0.9
            balls.append((spot, small))
            for _ in range(3):
                bit = away + 0.7 * rng.standard_normal(3)
                balls.append((spot + bit / np.linalg.norm(bit) * small * 0.9, small * rng.uniform(0.25, 0.5)))
    shape, faces = _ball()
    points, quads = [], []
    for k, (centre, radius) in enumerate(balls):
        ball = centre + radius * shape * [1.12, 1.0, 0.9]
        ball[:, 2] = np.where(ball[:, 2] < 0, ball[:, 2] * 0.12, ball[:, 2])
        points.append(ball + np.asarray(at))
        quads.append(faces + k * len(shape))
    return mesh(name, np.concatenate(points), np.concatenate(quads), material)


def evening_banks(name: str, far: float, sun: tuple, banks: list, rng: np.random.Generator) -> bpy.types.Object:
    """Long clouds on an upright sheet `far` metres away, warm where the low sun reaches them, cool above.

    sun: (x, z) at which it stands behind the sheet; banks: (x and height of the middle of the base, width, height,
    how closed it is, 0..1), farthest first; all lengths in distances.
    """
    x, z = np.meshgrid(np.linspace(-0.95, 0.95, 900), np.linspace(0.02, 0.66, 304))
    step = x[0, 1] - x[0, 0]
    body, up = np.zeros_like(x), np.zeros_like(x)
    for middle, base, width, tall, closed in banks:
        along = (x - middle) / (width / 2)
        high = (z - base - 0.25 * tall * _fractal(x / width * 3, x * 0, rng, 2)) / tall
        heap = _fractal(x / (1.5 * tall), z / (0.62 * tall), rng, 6)
        wisp = _fractal(x / (4 * tall), z / (0.35 * tall), rng, 5)
        reach = np.clip(1 - along**2, -1, 1) * (0.62 + 0.45 * _fractal(x / width * 4, x * 0, rng, 3))
        swell = np.where(high > 0, reach - high, reach * 0.8 + 3.2 * high) + 0.40 * heap + 0.30 * wisp + closed - 0.55
        here = np.clip(1.2 * swell, 0, 1)
        here *= here * (3 - 2 * here)
        up = np.where(here > body, np.clip(high, 0, 1), up)
        body = np.maximum(body, here)
    toward = np.stack([sun[0] - x, sun[1] - z])
    toward /= np.hypot(*toward) + 1e-6
    beam = _shade(body, toward[0], toward[1], step)
    below = _shade(body, 0 * x, -np.ones_like(x), step)
    close = np.exp(-np.hypot(sun[0] - x, 1.4 * (sun[1] - z)) / 0.42)[..., None]
    warm = close * np.array([1.25, 0.70, 0.30]) + (1 - close) * np.array([1.0, 0.45, 0.28])
    cool = up[..., None] * np.array([0.20, 0.21, 0.36]) + (1 - up[..., None]) * np.array([0.30, 0.21, 0.31])
    rim = close[..., 0] * np.exp(-5 * body)
    lit = np.clip(0.5 * beam + 0.6 * below + 0.8 * rim, 0, 1)[..., None]
    colour = cool + lit * (warm - 0.6 * cool) * (0.35 + 0.65 * np.maximum(close, 0.55))
    cover = (1 - np.exp(-2.6 * body)) / (1 - np.exp(-2.6)) * np.clip((z - 0.02) / 0.05, 0, 1)
    tone = np.concatenate([colour, cover[..., None]], axis=-1)
    middles = (tone[:-1, :-1] + tone[:-1, 1:] + tone[1:, 1:] + tone[1:, :-1]) / 4
    points = np.stack([x * far, np.full_like(x, far), z * far], axis=-1).reshape(-1, 3)
    index = np.arange(x.size).reshape(x.shape)
    faces = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    sheet = mesh(name, points, faces, veil(name), middles.reshape(-1, 4))
    sheet.visible_shadow = sheet.visible_diffuse = False
    return sheet


def _shade(body: np.ndarray, right: np.ndarray, rise: np.ndarray, step: float, reach: float = 0.11) -> np.ndarray:
    """Share of the light that gets through a sheet of cloud to each of its places from a direction (right, rise)."""
    rows, columns = np.mgrid[0 : body.shape[0], 0 : body.shape[1]]
    depth, legs = np.zeros_like(body), 14
    for k in range(1, legs + 1):
        way = reach / step * (k / legs) ** 1.5
        row = np.clip(np.round(rows + rise * way).astype(int), 0, body.shape[0] - 1)
        column = np.clip(np.round(columns + right * way).astype(int), 0, body.shape[1] - 1)
        depth += body[row, column] / legs
    return np.exp(-3.0 * depth)


def _fractal(x: np.ndarray, y: np.ndarray, rng: np.random.Generator, octaves: int) -> np.ndarray:
    """Noise of about -1..1 with features of 1 and finer ones: values of a random lattice, smoothly joined."""
    total = np.zeros_like(x)
    for k in range(octaves):
        lattice = rng.uniform(-1, 1, (256, 256))
        u, v = x * 2**k + 100.5, y * 2**k + 100.5
        i, j = np.floor(u).astype(int), np.floor(v).astype(int)
        s, t = (w * w * w * (w * (6 * w - 15) + 10) for w in (u - i, v - j))
        low = lattice[j % 256, i % 256] * (1 - s) + lattice[j % 256, (i + 1) % 256] * s
        high = lattice[(j + 1) % 256, i % 256] * (1 - s) + lattice[(j + 1) % 256, (i + 1) % 256] * s
        total += 0.55**k * (low * (1 - t) + high * t)
    return total
