"""A fire in the open: its hearth of stones and logs, its tongues of flame, and the smoke above."""

import bpy
import numpy as np

from .materials import veil
from .meshes import mesh, ripple_noise


def stone(name: str, at: tuple, size: tuple, material: bpy.types.Material, tone: tuple,
          rng: np.random.Generator) -> bpy.types.Object:
    """A boulder: a ball of radii `size` (metres) with dents, round `at`."""
    tilt, turn = np.meshgrid(np.linspace(0, np.pi, 22), np.linspace(0, 2 * np.pi, 33))
    ball = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], axis=-1)
    dents = 1 + 0.16 * ripple_noise(ball[..., 0] * 2 + ball[..., 2], ball[..., 1] * 2 - ball[..., 2], 2.2, rng, 3)
    points = np.asarray(at) + ball * dents[..., None] * np.asarray(size)
    faces = sheet(tilt.shape)
    return mesh(name, points.reshape(-1, 3), faces, material, np.tile(tone, (len(faces), 1)))


def log(name: str, start: tuple, end: tuple, radius: float, material: bpy.types.Material, tone: tuple,
        rng: np.random.Generator, cut: tuple = (0.34, 0.22, 0.12)) -> bpy.types.Object:
    """A piece of a trunk from `start` to `end` with rough bark of linear colour `tone` and ends of colour `cut`."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    axis = (end - start) / np.linalg.norm(end - start)
    side = np.cross(axis, [0.3, 0.2, 1.0])
    side /= np.linalg.norm(side)
    rise = np.cross(side, axis)
    along, turn = np.meshgrid(np.linspace(0, 1, 16), np.linspace(0, 2 * np.pi, 25), indexing="ij")
    rough = radius * (1 + 0.10 * ripple_noise(along * 1.2, np.cos(turn) + np.sin(turn) * 0.7, 0.9, rng, 3))
    rough[[0, -1]] = 0
    along = np.concatenate([along[:1], along[:1], along[1:-1], along[-1:], along[-1:]])
    rough = np.concatenate([rough[:1], rough[1:2], rough[1:-1], rough[-2:-1], rough[-1:]])
    turn = np.concatenate([turn[:1], turn[:1], turn[1:-1], turn[-1:], turn[-1:]])
    points = (start + along[..., None] * (end - start)
              + rough[..., None] * (np.cos(turn)[..., None] * side + np.sin(turn)[..., None] * rise))
    faces = sheet(along.shape)
    tones = np.array(tone) * rng.uniform(0.6, 1.3, (len(faces), 1))
    rings = np.arange(len(faces)) // (along.shape[1] - 1)
    tones[(rings == 0) | (rings == along.shape[0] - 2)] = cut
    return mesh(name, points.reshape(-1, 3), faces, material, tones)


def sheet(shape: tuple[int, int]) -> np.ndarray:
    """The faces of points that stand in rows and columns."""
    index = np.arange(shape[0] * shape[1]).reshape(shape)
    return np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)


def ribbon(name: str, spine: np.ndarray, width: np.ndarray, colours: np.ndarray, cover: np.ndarray,
           soft: float) -> bpy.types.Object:
    """A band of light that faces the viewer (along -Y) and fades towards its edges.

    spine (K, 3): its middle, from the foot up; width (K,): metres; colours (K, 3): linear, in the middle; the edge
    is redder; cover (K,): 0..1, in the middle; soft: share of the half width over which it fades.
    """
    across = np.linspace(-1, 1, 19)
    ahead = np.gradient(spine, axis=0)
    normal = np.stack([ahead[:, 2], 0 * ahead[:, 0], -ahead[:, 0]], axis=1)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True) + 1e-9
    points = spine[:, None] + across[None, :, None] * (normal * width[:, None] / 2)[:, None]
    mid_across = np.abs(across[:-1] + across[1:]) / 2
    fade = np.clip((1 - mid_across) / soft, 0, 1)
    fade = fade * fade * (3 - 2 * fade)
    along = lambda values: (values[:-1] + values[1:]) / 2  # noqa: E731
    edge = np.stack([1 - 0.25 * mid_across**2, 1 - 0.55 * mid_across**2, 1 - 0.8 * mid_across**2], axis=-1)
    tones = np.concatenate([along(colours)[:, None] * edge[None],
                            (along(cover)[:, None] * fade[None])[..., None]], axis=2)
    band = mesh(name, points.reshape(-1, 3), sheet(points.shape[:2]), veil(name), tones.reshape(-1, 4))
    band.visible_shadow = band.visible_diffuse = band.visible_glossy = False
    return band


def tongue(at: tuple, height: float, width: float, lean: float, heat: float,
           rng: np.random.Generator) -> bpy.types.Object:
    """A tongue of flame, metres: it swells above its foot, narrows, and curls to its tip, which stands `lean` to the
    right of the foot. heat: 0 (red) .. 1 (nearly white at the foot)."""
    t = np.linspace(0, 1, 34)
    curl = rng.uniform(0.06, 0.13) * height * t**1.3 * np.sin(2 * np.pi * (rng.uniform(0.7, 1.15) * t + rng.uniform()))
    spine = np.asarray(at) + np.stack([lean * t**1.2 + curl, 0.0 * t, height * t], axis=1)
    girth = width * (np.sin(np.pi * np.clip(t * 0.80 + 0.16, 0, 1)) ** 0.8) * (1 - t**2.2) ** 1.1
    stops = np.array([[0.75, 0.07, 0.006], [1.15, 0.20, 0.012], [1.35, 0.46, 0.035], [1.5, 0.85, 0.16],
                      [1.7, 1.30, 0.52]])
    warm = np.clip(heat * (1 - 0.75 * t) * 4.0, 0, 4)
    colours = np.stack([np.interp(warm, range(5), stops[:, c]) for c in range(3)], axis=1)
    cover = (0.62 + 0.32 * heat) * np.clip(t / 0.06, 0, 1) * (1 - 0.55 * t**2)
    return ribbon("flame", spine, girth + 0.004, colours, cover, 0.62)


def wisp(at: tuple, height: float, width: float, lean: float, tone: tuple, cover: float,
         rng: np.random.Generator) -> bpy.types.Object:
    """Smoke that widens and winds as it climbs; `tone`: linear colour aloft, warmer at its foot."""
    t = np.linspace(0, 1, 60)
    phase, turns = rng.uniform(0, 1), rng.uniform(1.1, 1.9)
    swing = 0.13 * height * t**0.8 * np.sin(2 * np.pi * (turns * t + phase)) * np.clip(t / 0.2, 0, 1)
    spine = np.asarray(at) + np.stack([lean * t**1.4 + swing, 0 * t, height * t], axis=1)
    girth = width * (0.30 + 0.9 * t) * (1 + 0.25 * np.sin(2 * np.pi * (2.3 * t + phase * 3)))
    warm = np.exp(-t / 0.22)[:, None]
    colours = np.array(tone) * (1 - warm) + np.array([0.36, 0.15, 0.06]) * warm
    veiled = cover * np.clip(t / 0.12, 0, 1) * (1 - 0.5 * t)
    return ribbon("smoke", spine, girth, colours, veiled, 0.9)
