"""Brushes: the mark a loaded bristle brush leaves, cut for every angle beforehand."""

import numpy as np

ANGLES = 36


def brush(length: float, width: float, rng: np.random.Generator, variants: int = 6) -> list[list[tuple]]:
    """Marks by angle and variant, each (alpha, height) of the same odd size, values 0..1.

    Every bristle begins and ends somewhere else and carries its own load of paint; length and width in pixels.
    Angle k stands for k * 180 / ANGLES degrees, clockwise from "right" on the screen.
    """
    reach = int(np.ceil(np.hypot(length, width) / 2)) + 1
    y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1].astype(np.float32)
    bristles = max(int(round(width * 1.2)), 3)
    marks = []
    loads = [rng.uniform(0.55, 1.0, bristles) for _ in range(variants)]
    heads = [rng.uniform(0.72, 1.0, bristles) for _ in range(variants)]
    tails = [rng.uniform(0.5, 1.0, bristles) for _ in range(variants)]
    bends = rng.uniform(-0.22, 0.22, variants)
    for k in range(ANGLES):
        angle = np.pi * k / ANGLES
        along = (x * np.cos(angle) + y * np.sin(angle)) / (length / 2)
        across = (-x * np.sin(angle) + y * np.cos(angle)) / (width / 2)
        row = []
        for v in range(variants):
            bent = across + bends[v] * (along * along - 0.4) * min(length / width, 3.0)
            place = np.clip((bent + 1) / 2 * (bristles - 1), 0, bristles - 1)
            low = np.floor(place).astype(int)
            high = np.minimum(low + 1, bristles - 1)
            share = place - low
            load = loads[v][low] * (1 - share) + loads[v][high] * share
            head = heads[v][low] * (1 - share) + heads[v][high] * share
            tail = tails[v][low] * (1 - share) + tails[v][high] * share
            soft = 2.2 / length
            inside = np.clip((head - along) / soft, 0, 1) * np.clip((along + tail) / (soft * 3), 0, 1)
            edge = np.clip((1 - np.abs(bent)) * width / 2 + 0.5, 0, 1)
            alpha = inside * edge
            ridge = np.clip(np.abs(bent) ** 3 * 0.5 + 0.6 * load, 0, 1)
            row.append(((alpha * (0.65 + 0.35 * load)).astype(np.float32), (alpha * ridge).astype(np.float32)))
        marks.append(row)
    return marks
