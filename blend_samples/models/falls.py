"""A waterfall: the cliff it falls over, its strands, the foam at its feet."""

from dataclasses import dataclass

import bpy
import numpy as np

from .fire import sheet
from .materials import pigment, veil
from .meshes import grid, mesh, ripple_noise


@dataclass
class Cliff:
    """A wall of layered rock across the view, hollow in the middle; all lengths in metres."""

    far: float = 20.0  # the hollow's distance
    lip: float = 10.6  # height of the water's edge
    seed: int = 5

    def _noise(self, x, y, size, salt, octaves=4):
        return ripple_noise(x, y, size, np.random.default_rng(self.seed + salt), octaves)

    def top(self, x: np.ndarray) -> np.ndarray:
        """Height of the wall: it is lowest where the water comes."""
        aside = np.clip(np.abs(x - 0.4) - 2.6, 0, None)
        return self.lip + 1.5 * (1 - np.exp(-aside / 0.8)) + 0.22 * aside + 0.45 * self._noise(x, 0 * x, 3.0, 1)

    def depth(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """How far away the wall is at (x, z): strata that stand out like steps, blocks, cracks."""
        aside = np.clip(np.abs(x) - 3.0, 0, None)
        layer = z * 0.40 + 0.55 * self._noise(x, 0.5 * z, 5.0, 2) + 0.09 * x
        step = np.floor(layer) + np.clip((layer - np.floor(layer)) / 0.30, 0, 1)
        block = np.tanh(4 * self._noise(x + 0.7 * np.floor(layer), z * 0.5 + np.floor(layer) * 3.1, 3.2, 3, 4))
        rough = 0.30 * self._noise(x, z * 1.2, 2.6, 4, 5) - 0.34 * np.abs(self._noise(x, z * 0.5, 3.1, 6, 4))
        return self.far - 0.55 * aside**1.15 + 0.52 * step + 0.26 * block + rough - 0.25

    def model(self) -> bpy.types.Object:
        x, v = np.meshgrid(np.linspace(-13, 13, 470), np.linspace(0, 1, 330))
        z = -0.6 + v * (self.top(x) + 0.6)
        y = self.depth(x, z)
        back = np.linspace(0, 1, 50)[1:, None]
        over_y = y[-1:] + 14 * back
        over_z = z[-1:] + 0.35 * np.sqrt(back) + 0.25 * self._noise(np.repeat(x[:1], 49, 0), over_y, 2.2, 7) * np.sqrt(back)
        points = np.stack([np.concatenate([x, np.repeat(x[:1], 49, 0)]), np.concatenate([y, over_y]),
                           np.concatenate([z, over_z])], axis=-1)
        faces = sheet(points.shape[:2])
        flat = points.reshape(-1, 3)
        middle = flat[faces].mean(axis=1)
        normal = np.cross(flat[faces[:, 1]] - flat[faces[:, 0]], flat[faces[:, 3]] - flat[faces[:, 0]])
        up = np.abs(normal[:, 2]) / (np.linalg.norm(normal, axis=1) + 1e-9)
        grown = self._noise(middle[:, 0], middle[:, 2], 1.7, 8)
        wet = np.exp(-((middle[:, 0] - 0.3) / 2.7) ** 4)
        moss = np.clip(2.6 * (up - 0.35) + 0.75 * grown, 0, 1) * (1 - 0.35 * wet)
        strata = 0.85 + 0.25 * self._noise(0.1 * middle[:, 0], middle[:, 2] * 2.0, 1.2, 9)
        rock = np.array([0.86, 0.78, 0.68]) * (strata * (1 - 0.52 * wet))[:, None]
        green = np.array([0.42, 0.56, 0.12]) * (0.75 + 0.3 * grown)[:, None]
        tones = np.clip(rock + (green - rock) * moss[:, None], 0.02, 2)
        stone = pigment("cliff", (0.13, 0.115, 0.10), (0.46, 0.41, 0.34), 2.2, 0.75, attribute="tone")
        return mesh("cliff", flat, faces, stone, tones)


def boulder(name: str, at: tuple, size: tuple, material: bpy.types.Material, tone: tuple,
            rng: np.random.Generator) -> bpy.types.Object:
    """A block of rock with worn edges, of radii `size` (metres) round `at`: what random planes cut out of a ball."""
    tilt, turn = np.meshgrid(np.linspace(0, np.pi, 40), np.linspace(0, 2 * np.pi, 61))
    towards = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], axis=-1)
    planes = rng.standard_normal((13, 3))
    planes /= np.linalg.norm(planes, axis=1, keepdims=True)
    reach = np.maximum(towards @ planes.T, 1e-3) / rng.uniform(0.66, 0.98, 13)
    radius = ((reach**14).sum(axis=-1) + 1.0) ** (-1 / 14)
    dents = 1 + 0.05 * ripple_noise(towards[..., 0] * 2 + towards[..., 2], towards[..., 1] * 2 - towards[..., 2], 1.1, rng, 4)
    points = np.asarray(at) + towards * (radius * dents)[..., None] * np.asarray(size) * 1.15
    faces = sheet(tilt.shape)
    middle = points.reshape(-1, 3)[faces].mean(axis=1)
    high = (middle[:, 2] - at[2]) / size[2]
    moss = np.clip(1.5 * high - 0.75 + 0.7 * ripple_noise(middle[:, 0], middle[:, 1], 0.5 + size[0], rng), 0, 0.85)[:, None]
    damp = np.where(middle[:, 2:] < 0.14, 0.45, 1.0)
    return mesh(name, points.reshape(-1, 3), faces, material,
                (np.asarray(tone) * (1 - moss) + np.array([0.44, 0.58, 0.13]) * moss) * damp)


def strand(cliff: Cliff, path: list, rng: np.random.Generator, parted: list = (), name: str = "strand") -> bpy.types.Object:
    """Water that falls along the cliff; path: (x, z, width), metres, from its lip down, lit as seen from the front.
    parted: rocks (x, z, radius) below which it closes again only after a while.

    It clears every ledge that stands out above; its streaks run down it and are torn more the deeper it has fallen.
    """
    path = np.array(path, float)
    t, u = np.linspace(0, 1, 220), np.linspace(-1, 1, 61)
    along = np.concatenate([[0], np.cumsum(np.hypot(np.diff(path[:, 0]), np.diff(path[:, 1])))])
    x, z, width = (np.interp(t * along[-1], along, path[:, c]) for c in range(3))
    x, width = (_smooth(values, 9) for values in (x, width))
    across = x[:, None] + u * width[:, None] / 2
    depth = cliff.depth(across, np.repeat(z[:, None], len(u), 1))
    clear = np.minimum.accumulate(depth, axis=0)
    for axis in (0, 1):
        clear = np.apply_along_axis(_smooth, axis, clear, 9)
    clear = np.minimum(clear, depth + 0.02) - 0.10 - 0.10 * (1 - u**2)
    fallen = (t * along[-1])[:, None]
    wide = u[None] * width[:, None]
    streaks = (0.55 * ripple_noise(wide * 1.0 + 0 * fallen, 0.10 * fallen, 0.34, rng, 3)
               + 0.55 * ripple_noise(wide, 0.22 * fallen, 0.9, rng, 3))
    points = np.stack([across, clear, np.repeat(z[:, None], len(u), 1)], axis=-1)
    faces = sheet(points.shape[:2])
    middle = lambda values: (values[:-1, :-1] + values[1:, 1:]).ravel() / 2  # noqa: E731
    streak = middle(streaks)
    edge = 1 - np.abs(middle(np.repeat(u[None], len(t), 0)))
    torn = middle(np.repeat(np.clip(t / 0.9, 0, 1)[:, None], len(u), 1))
    white = np.clip(0.62 + 0.62 * streak, 0, 1)[:, None]
    side = 0.90 + 0.10 * np.clip(-middle(np.repeat(u[None], len(t), 0)), -1, 1)[:, None]
    colour = (np.array([0.30, 0.42, 0.50]) * (1 - white) + np.array([1.45, 1.36, 1.18]) * white) * side
    cover = np.clip(1.05 + 0.9 * streak - 0.35 * torn, 0, 1) * np.clip(edge / 0.28 + 0.9 * streak * (edge < 0.5), 0, 1)
    px, pz = middle(points[..., 0]), middle(points[..., 2])
    for rx, rz, radius in parted:
        below = (rz - pz) / (3.6 * radius * (1 + 0.5 * streak))
        gap = 0.95 * radius * np.sqrt(np.clip(1 - below, 0, 1)) * (1 + 0.4 * streak)
        cover = np.where((below > 0) & (below < 1), cover * np.clip((np.abs(px - rx) - gap) / (0.8 * radius) + 0.6, 0.15, 1), cover)
    start = middle(np.repeat(np.clip(t / 0.015, 0, 1)[:, None], len(u), 1))
    tones = np.concatenate([colour, (cover * start)[:, None]], axis=1)
    water = mesh(name, points.reshape(-1, 3), faces, veil(name), tones)
    water.visible_shadow = False
    return water


def foam(feet: list, rng: np.random.Generator) -> bpy.types.Object:
    """Foam on a pool at z = 0; feet: (x, y, strength), where strands fall in. It is whole there and drifts apart."""
    def tones(x, y):
        near = sum(strength * np.exp(-np.hypot((x - fx) / 1.35, np.where(y > fy, (y - fy) * 2, (fy - y) / 2.6)) / 1.2)
                   for fx, fy, strength in feet)
        lace = np.abs(ripple_noise(x * 1.5, y * 0.55, 1.25, rng, 4))
        cover = np.clip(1.5 * near - 0.45 * lace - 0.02, 0, 1) + 0.55 * np.clip(0.16 - lace, 0, 1) / 0.16 * np.clip(2.6 * near, 0, 1)
        white = np.clip(0.55 + 0.55 * near, 0, 1)[:, None]
        colour = np.array([0.52, 0.62, 0.64]) * (1 - white) + np.array([1.25, 1.20, 1.10]) * white
        return np.concatenate([colour, np.clip(cover, 0, 1)[:, None]], axis=1)

    spread = grid("foam", np.linspace(-7, 7, 420), np.linspace(5, 21, 420), lambda x, y: 0 * x + 0.03, veil("foam"), tones)
    spread.visible_shadow = False
    return spread


def _smooth(values: np.ndarray, reach: int) -> np.ndarray:
    """A row of values averaged over `reach` neighbours to both sides, its ends held."""
    padded = np.concatenate([np.repeat(values[:1], reach), values, np.repeat(values[-1:], reach)])
    return np.convolve(padded, np.ones(2 * reach + 1) / (2 * reach + 1), mode="valid")
