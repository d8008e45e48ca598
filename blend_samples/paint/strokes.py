"""Painting a layer: rounds of brush marks from coarse to fine, each laid over the ones before."""

from dataclasses import dataclass

import numpy as np

from .brush import ANGLES, brush
from .fields import blur, direction


@dataclass
class Round:
    """One round over the layer with one brush. Lengths in pixels; `error` in display values."""

    length: float
    width: float
    density: float = 1.0  # marks a width x width cell
    opacity: float = 0.9
    error: float = 0.0  # marks only where what is painted differs by more than this
    spread: float = 0.25  # radians by which marks stray from the form
    variety: float = 0.035  # how far a mark's colour strays
    lights_last: float = 0.5  # 0 random order .. 1 dark before light
    smooth: float = 0.35  # blur of what the painter looks at, in widths


def brushwork(scale: float, *given: tuple) -> list[Round]:
    """Rounds from (length, width, {the other fields}), lengths for a picture 1280 px wide brought to `scale`."""
    return [Round(length * scale, width * scale, **more) for length, width, more in given]


@dataclass
class Painted:
    """Premultiplied display colour (H, W, 4) and the paint's thickness (H, W)."""

    colour: np.ndarray
    height: np.ndarray


def stray(colour: np.ndarray, amount: float, rng: np.random.Generator) -> np.ndarray:
    """Colours (N, 3) each mixed a little lighter or darker, warmer or cooler, purer or greyer."""
    n = len(colour)
    value = 1 + amount * rng.standard_normal((n, 1))
    warm = amount * 0.7 * rng.standard_normal((n, 1)) * np.array([[1.0, 0.15, -1.0]])
    green = amount * 0.35 * rng.standard_normal((n, 1)) * np.array([[-0.5, 1.0, -0.5]])
    grey = colour.mean(axis=1, keepdims=True)
    pure = 1 + 2.5 * amount * rng.standard_normal((n, 1))
    lit = np.clip(grey * 1.6, 0.15, 1.0)
    return np.clip((grey + (colour - grey) * pure) * value + (warm + green) * lit, 0, 1).astype(np.float32)


def paint(guide: np.ndarray, rounds: list[Round], rng: np.random.Generator, fallback: np.ndarray | float = 0.0,
          follow: float = 6.0) -> Painted:
    """Paint `guide` (premultiplied display RGBA, H x W x 4).

    fallback: angle where the guide shows none; follow: how far, in px, the direction is smoothed (0: fallback
    everywhere).
    """
    h, w = guide.shape[:2]
    canvas = blur(guide, 1.0).astype(np.float32)  # the underpainting: no mark's gap shows a hole
    thick = np.zeros((h, w), np.float32)
    fallback = np.broadcast_to(np.asarray(fallback, np.float32), (h, w))
    lightness = guide[..., :3].mean(axis=2)
    angle = direction(lightness, follow, fallback) if follow > 0 else fallback
    for r in rounds:
        seen = blur(guide, r.smooth * r.width)
        marks = brush(r.length, r.width, rng)
        reach = marks[0][0][0].shape[0] // 2
        step = r.width / np.sqrt(r.density)
        gy, gx = np.mgrid[-reach // 2 : h + reach // 2 : step, -reach // 2 : w + reach // 2 : step]
        y = (gy + rng.uniform(-step, step, gy.shape)).ravel()
        x = (gx + rng.uniform(-step, step, gx.shape)).ravel()
        iy = np.clip(y.astype(int), 0, h - 1)
        ix = np.clip(x.astype(int), 0, w - 1)
        covered = guide[iy, ix, 3]
        wanted = covered > rng.uniform(0.3, 0.8, len(y))
        if r.error > 0:
            off = blur(np.abs(canvas - guide).max(axis=2), r.width * 0.3)
            wanted &= off[iy, ix] > r.error * rng.uniform(0.6, 1.4, len(y))
        y, x, iy, ix = y[wanted], x[wanted], iy[wanted], ix[wanted]
        cover = np.maximum(seen[iy, ix, 3:], 0.05)
        colour = stray(np.clip(seen[iy, ix, :3] / cover, 0, 1), r.variety, rng)
        order = np.argsort(rng.uniform(0, 1, len(y)) * (1 - r.lights_last) + r.lights_last * colour.mean(axis=1),
                           kind="stable")
        turn = angle[iy, ix] + r.spread * rng.standard_normal(len(y))
        turn = np.round(turn / np.pi * ANGLES).astype(int) % ANGLES
        variant = rng.integers(0, len(marks[0]), len(y))
        opacity = r.opacity * rng.uniform(0.75, 1.0, len(y))
        for i in order:
            alpha, ridge = marks[turn[i]][variant[i]]
            top, left = int(round(y[i])) - reach, int(round(x[i])) - reach
            y0, x0, y1, x1 = max(top, 0), max(left, 0), min(top + 2 * reach + 1, h), min(left + 2 * reach + 1, w)
            if y0 >= y1 or x0 >= x1:
                continue
            cut = (slice(y0 - top, y1 - top), slice(x0 - left, x1 - left))
            a = alpha[cut] * opacity[i]
            rest = 1 - a
            under = canvas[y0:y1, x0:x1]
            under *= rest[..., None]
            under[..., :3] += a[..., None] * colour[i]
            under[..., 3] += a
            bed = thick[y0:y1, x0:x1]
            bed *= rest
            bed += ridge[cut] * opacity[i]
    return Painted(canvas, thick)


def light_relief(painted: Painted, amount: float) -> np.ndarray:
    """The painted colour with its ridges lit from the upper left, premultiplied (H, W, 4)."""
    gy, gx = np.gradient(blur(painted.height, 0.6))
    shade = 1 + amount * np.clip(gx + gy, -0.5, 0.5)
    lit = painted.colour.copy()
    lit[..., :3] = np.clip(lit[..., :3] * shade[..., None], 0, None)
    lit[..., :3] = np.minimum(lit[..., :3], lit[..., 3:])
    return lit
