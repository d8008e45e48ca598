"""Cumulus clouds: heaps of balls on a flat base, with smaller balls on their upper sides."""

import bpy
import numpy as np

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
