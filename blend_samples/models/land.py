"""Distant land: ranges of hills, and bushes that give them their scale."""

import bpy
import numpy as np

from .materials import leaf, pigment
from .meshes import cards, grid, ripple_noise


def hills(name: str, far: float, base: float, swing: float, dark: tuple, light: tuple, seed: int,
          foot: float = -12.0, ridges: float = 0.9, turn: float = 0.0) -> bpy.types.Object:
    """A range `far` metres away along +Y, of height base +- swing, with its foot at `foot`.

    dark, light: linear colours of its slopes; ridges: length of a ridge, in distances; turn: metres it is
    shifted to the right.
    """
    xs, ys = np.linspace(-far, far, 240), np.linspace(far, far * 1.35, 24)

    def form(x, y):
        ridge = ripple_noise(x - turn, x * 0, far * ridges, np.random.default_rng(seed), 5)
        return foot + (base - foot + swing * 0.5 * ridge) * np.sin(np.pi * np.clip((y / far - 1) / 0.35, 0, 1) * 0.75)

    return grid(name, xs, ys, form, pigment(name, dark, light, 14 / far))


def bushes(name: str, at: np.ndarray, size: np.ndarray, tone: np.ndarray, rng: np.random.Generator) -> bpy.types.Object:
    """Foliage seen from afar: one upright card a place, lit mostly from the left and above."""
    count = len(at)
    normal = np.stack([rng.standard_normal(count) * 0.7 - 0.3, -np.ones(count), 0.8 + rng.standard_normal(count) * 0.4],
                      axis=1)
    return cards(name, at, normal, rng.standard_normal((count, 3)), size, size, leaf(name, through=0.1), tone)
