"""`tree`: an old oak on a meadow's rise, late in a summer's afternoon.

    build/blender-venv/bin/python blend_samples/tree/scene.py [--width 1280]
"""

import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

import models.stage as stage  # noqa: E402
from models.clouds import cumulus  # noqa: E402
from models.land import bushes, hills  # noqa: E402
from models.materials import cloud, leaf, pigment  # noqa: E402
from models.meshes import cards, grid, ripple_noise  # noqa: E402
from models.tree import Crown, bark, grow, leaves, thickness  # noqa: E402
from paint.easel import Easel  # noqa: E402
from paint.layers import over, write_sample  # noqa: E402

FOOT = np.array([3.4, 22.5, 0.0])


def hill(x, y):
    """Height of the meadow, metres."""
    rng = np.random.default_rng(5)
    rise = 1.6 * np.exp(-(((x - 4) / 13) ** 2) - ((y - 23) / 9) ** 2)
    fall = -0.00042 * np.clip(y - 26, 0, None) ** 2
    return rise + fall + 0.10 * ripple_noise(x, y, 9, rng) - 0.1


def path(y):
    """Where the trodden path runs at depth y, metres."""
    return -1.3 + 1.5 * np.sin(y / 5.2 + 0.5) + 0.016 * np.clip(y - 4, 0, None) ** 1.7


def shade(y):
    """A cloud's shadow lies over the nearest metres, so that the light begins behind it."""
    return 0.45 + 0.55 / (1 + np.exp(-(y - 12.0) / 0.8))


def meadow(rng):
    xs, ys = np.linspace(-60, 60, 400), np.concatenate([np.linspace(1, 40, 160), np.linspace(41, 95, 30)])
    earth = pigment("meadow", (0.12, 0.12, 0.03), (0.30, 0.24, 0.07), 0.5, attribute="tone")

    def trodden(x, y):
        on = np.clip(1.3 - np.abs(x - path(y)) / 0.5, 0, 1)[:, None]
        return (1 + on * np.array([[1.2, 1.0, 2.2]])) * shade(y)[:, None]

    ground = grid("meadow", xs, ys, hill, earth, trodden)
    count = 90000
    y = 3 + 37 * rng.uniform(0, 1, count) ** 1.7
    x = rng.uniform(-1, 1, count) * (y * 0.62 + 3)
    at = np.stack([x, y, hill(x, y)], axis=1)
    patch = ripple_noise(x, y, 5.0, np.random.default_rng(8))
    greens = np.array([[0.13, 0.16, 0.028], [0.24, 0.235, 0.045], [0.42, 0.34, 0.085], [0.52, 0.42, 0.16]])
    pick = np.clip((patch * 1.1 + 1.3 + 0.6 * rng.standard_normal(count)).astype(int), 0, 3)
    tone = greens[pick] * rng.uniform(0.7, 1.25, (count, 1))
    petals = rng.uniform(0, 1, count) < np.where((patch > 0.1) & (y < 16), 0.028, 0.003)
    colours = np.array([[0.85, 0.78, 0.62], [0.8, 0.55, 0.08], [0.62, 0.10, 0.05], [0.40, 0.3, 0.55]])
    tone[petals] = colours[rng.integers(0, 4, petals.sum())]
    tone *= shade(y)[:, None]
    off = np.abs(x - path(y)) / (0.42 + 0.1 * patch)
    kept = (off > 1) | (rng.uniform(0, 1, count) < 0.25)
    sand = np.array([0.50, 0.38, 0.22]) * rng.uniform(0.7, 1.2, ((off < 1).sum(), 1))
    tone[off < 1] = sand * shade(y[off < 1])[:, None]
    up = np.stack([0.35 + 0.35 * rng.standard_normal(count), 0.3 * rng.standard_normal(count), np.ones(count)], axis=1)
    normal = np.stack([0.6 * rng.standard_normal(count), -np.ones(count), np.full(count, 0.9)], axis=1)
    length = rng.uniform(0.14, 0.42, count)
    length[petals] = 0.12
    length[off < 1] *= 0.35
    width = np.where(petals, 0.11, 0.035 + 0.0016 * y)
    at[petals, 2] += rng.uniform(0.15, 0.4, petals.sum())
    at, normal, up, length, width, tone = (v[kept] for v in (at, normal, up, length, width, tone))
    blades = cards("grass", at, normal, up, length, width, leaf("grass", through=0.3), tone)
    return [ground, blades]


def far_land(rng):
    ranges = [(130, 1.5, 5, (0.14, 0.17, 0.05), (0.34, 0.30, 0.10)),
              (300, 7, 14, (0.14, 0.185, 0.12), (0.27, 0.27, 0.15)),
              (700, 30, 32, (0.23, 0.31, 0.36), (0.29, 0.36, 0.36)), (1500, 85, 70, (0.38, 0.47, 0.56),
                                                                      (0.43, 0.51, 0.58))]
    things = [hills(f"range {far}", far, base, swing, dark, light, int(rng.integers(0, 1000)))
              for far, base, swing, dark, light in ranges]
    # Hedges and copses on the nearer ranges: small round bushes that give the distance its scale.
    count = 9000
    row = rng.integers(0, 16, count)
    rows = np.array([95, 100, 118, 135, 150, 160, 170, 200, 230, 300, 310, 325, 340, 350, 360, 380])
    y = rows[row] + rng.uniform(-2, 2, count)
    along = (np.round(rng.uniform(-1, 1, count) * 7) / 7 + 0.08 * rng.standard_normal(count))
    x = along * y * 0.75
    z = np.where(y < 260, -6.5 + 4.5 * (y - 95) / 100, -3 + 11 * (y - 300) / 80)
    z += np.abs(rng.standard_normal(count)) * 1.3
    haze = np.clip((y - 60) / 420, 0, 1)[:, None]
    tone = np.array([[0.055, 0.075, 0.02]]) * (1 - haze) + np.array([[0.17, 0.24, 0.25]]) * haze
    tone *= rng.uniform(0.7, 1.5, (count, 1))
    size = rng.uniform(0.8, 2.0, count) * (1 + y / 300)
    things.append(bushes("hedges", np.stack([x, y, z], axis=1), size, tone, rng))
    return things


def oak(rng):
    foot = FOOT + [0, 0, hill(FOOT[0], FOOT[1]) - 0.15]
    trunk = foot + np.array([[0, 0, 0], [-0.1, 0, 1.0], [0.12, 0.1, 2.1], [-0.05, 0.1, 3.1], [-0.35, 0, 4.2]])
    lobes = np.array([[-4.3, -0.5, 4.9], [-2.9, -1.6, 6.4], [-3.6, 0.8, 7.6], [-0.9, -1.8, 5.5], [-1.2, 0, 8.9],
                      [0.9, -1.2, 7.3], [2.8, -0.3, 8.2], [3.2, -1.6, 5.9], [4.9, 0.4, 6.4], [0.8, 1.5, 9.9],
                      [-2.0, 2.0, 9.4], [5.2, -0.6, 4.5], [1.9, 1.6, 5.0], [-5.3, 0.9, 6.2]])
    radii = np.array([[1.9, 1.7, 1.1], [1.9, 1.7, 1.25], [1.7, 1.7, 1.2], [1.5, 1.5, 1.0], [1.9, 1.7, 1.35],
                      [1.8, 1.6, 1.2], [1.9, 1.7, 1.25], [1.8, 1.7, 1.1], [1.5, 1.5, 1.1], [1.6, 1.6, 1.1],
                      [1.3, 1.4, 1.0], [1.3, 1.3, 0.8], [1.8, 1.6, 1.0], [1.2, 1.2, 0.8]])
    crown = Crown(foot + lobes, 0.9 * radii)
    nodes, parents = grow(trunk, crown, rng, step=0.28, lights=1900)
    radius = thickness(parents, 0.02, 2.3)
    crown = crown.broken(6, rng, 0.5)
    wood = bark("oak", nodes, parents, radius, pigment("bark", (0.035, 0.025, 0.02), (0.19, 0.13, 0.085), 5), 0.9)
    palette = np.array([[0.10, 0.155, 0.04], [0.17, 0.235, 0.05], [0.28, 0.31, 0.065], [0.43, 0.38, 0.09]])
    crownwork = leaves("oak leaves", nodes, radius, crown, leaf("oak leaves"), rng, palette, 70000, 0.2, 0.3)
    return [wood, crownwork]


def clouds(rng):
    white = cloud("cloud", (0.9, 0.86, 0.8), (0.42, 0.48, 0.62), 0.5)
    return [cumulus("great cloud", (-430, 1500, 235), 700, 330, white, rng, 8),
            cumulus("second cloud", (560, 1900, 330), 800, 300, white, rng, 7),
            cumulus("low cloud", (60, 2600, 270), 900, 150, white, rng, 9),
            cumulus("far cloud", (-1150, 2700, 300), 800, 150, white, rng, 8)]


SKY = [(64, 22, {"density": 1.6, "variety": 0.025}), (34, 12, {"density": 1.2, "error": 0.02, "variety": 0.022}),
       (18, 7, {"error": 0.05, "variety": 0.02})]
EARTH = [(30, 11, {"density": 1.8, "variety": 0.04}), (17, 5, {"density": 1.2, "error": 0.04, "variety": 0.04}),
         (10, 2.6, {"error": 0.07, "variety": 0.04})]
FOLIAGE = [(13, 6, {"density": 1.6, "spread": 0.7}),
           (9, 4, {"density": 1.6, "error": 0.03, "spread": 0.6, "lights_last": 0.8}),
           (6, 2.2, {"density": 1.3, "error": 0.05, "spread": 0.4, "lights_last": 0.8})]


def main() -> None:
    given = stage.asked(__doc__, HERE)
    easel = Easel(given.width, given.height, 1889)
    stage.clear(given.width, given.height, 16)
    stage.camera((0, 0, 2.1), (0.25, 20, 4.85), 56)
    stage.sun(205, 27, (1.0, 0.77, 0.48), 6.5, 1.5)
    stage.sky([(0, (0.90, 0.80, 0.62)), (0.06, (0.74, 0.76, 0.72)), (0.2, (0.36, 0.54, 0.72)),
               (0.6, (0.12, 0.27, 0.55))], 0.8)
    ground, land, heaven = meadow(easel.rng), far_land(easel.rng), clouds(easel.rng)
    tree = oak(easel.rng)

    sky = stage.display(stage.render(heaven, unseen=tree, transparent=False))
    earth = stage.display(stage.render(ground + land))
    standing = stage.display(stage.render(tree, hold_out=ground))

    sky = easel.paint(sky, SKY, easel.wander(-0.2, 0.6, 220), 9, 0.15)
    upright = np.full((given.height, given.width), -1.2, np.float32)
    upright[: int(given.height * 0.66)] = 0.05
    earth = easel.paint(earth, EARTH, upright, 4, 0.3)
    standing = easel.paint(standing, FOLIAGE, easel.wander(0.8, 0.6, 30), 3, 0.3, sharp=True)

    write_sample(given.output, [("tree", standing), ("background", over(earth, sky))], filled=("tree",))
    print("foot", stage.place(FOOT + [0, 0, hill(FOOT[0], FOOT[1])]), "top", stage.place(FOOT + [0.2, 0, 11.5]))


if __name__ == "__main__":
    main()
