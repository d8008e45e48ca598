"""Pines, close enough to be lit and far enough to be shapes."""

import bpy
import numpy as np

from .harbour import tower
from .materials import leaf
from .meshes import cards


def pine(at: tuple, height: float, spread: float, wood: bpy.types.Material, tone: tuple, rng: np.random.Generator,
         bare: float = 0.25, needles: int = 20) -> list[bpy.types.Object]:
    """A trunk of linear colour (0.10, 0.065, 0.045) and tiers of drooping boughs, `spread` metres to their ends.

    bare: the share of the height below the lowest bough; tone: linear colour of the needles; needles: tufts of them a bough.
    """
    trunk = tower("pine trunk", at, height * 0.97, 0.022 * height, 0.012, wood, [(0, (0.10, 0.065, 0.045))], 12)
    tiers = int(height * 3.2)
    level = np.repeat(np.linspace(bare, 0.99, tiers), 9)
    level += rng.normal(0, 0.006, len(level))
    turn = rng.uniform(0, 2 * np.pi, len(level))
    out = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    reach = spread * (1 - level) / (1 - bare) * rng.uniform(0.65, 1.1, len(level)) + 0.12
    root = np.asarray(at) + np.stack([0 * level, 0 * level, level * height], axis=1)
    share = rng.uniform(0.12, 1, (len(level), needles)) ** 0.8
    droop = np.stack([0 * level, 0 * level, -0.34 * reach], axis=1)
    place = root[:, None] + share[..., None] * (out * reach[:, None])[:, None] + (share**1.6)[..., None] * droop[:, None]
    place += rng.normal(0, 0.05, place.shape) * reach[:, None, None]
    along = out[:, None] + rng.normal(0, 0.5, place.shape) + [0, 0, -0.5]
    normal = rng.normal(0, 0.6, place.shape) + [0, 0, 0.8]
    count = place.shape[0] * needles
    size = 0.06 * spread * rng.uniform(0.6, 1.4, count) + 0.05
    tones = np.array(tone) * rng.uniform(0.55, 1.4, (count, 1))
    tufts = cards("pine needles", place.reshape(-1, 3), normal.reshape(-1, 3), along.reshape(-1, 3), size * 1.6,
                    size * 0.5, leaf("needles", through=0.25), tones)
    return [trunk, tufts]
