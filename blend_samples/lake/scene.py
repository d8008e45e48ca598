"""`lake`: a gaff-rigged boat on a mountain lake, a summer's morning.

    build/blender-venv/bin/python blend_samples/lake/scene.py [--width 1280]
"""

import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

import models.stage as stage  # noqa: E402
from models.boats import Boat  # noqa: E402
from models.clouds import cumulus  # noqa: E402
from models.land import bushes, hills  # noqa: E402
from models.materials import cloud, leaf, pigment, toned, water  # noqa: E402
from models.meshes import cards, grid, ripple_noise  # noqa: E402
from models.tree import Crown, bark, grow, leaves, thickness  # noqa: E402
from paint.easel import Easel  # noqa: E402
from paint.layers import spread_under, write_sample  # noqa: E402

EYE = 3.0
BIRCH = np.array([-5.2, 15.0, 0.75])
POPLARS = [(24.0, 88.0, 17.0), (28.5, 90.0, 20.5), (32.5, 87.0, 15.5), (40.0, 92.0, 19.0)]


def bank(x, y):
    """Height of the near bank at the left, of the headland at the right and of the lake's bed, metres."""
    rng = np.random.default_rng(3)
    rough = 0.12 * ripple_noise(x, y, 5, rng)
    near = 0.95 - 0.20 * (x + 6.2) - 0.017 * np.clip(y - 9, 0, None) ** 2 * 0.6 - 0.03 * np.clip(12 - y, 0, None)
    near = np.where(x < 4, near, -1)
    head = 1.5 - 0.05 * np.abs(y - 92) ** 1.15 - 0.11 * np.clip(24 - x, 0, None)
    return np.maximum(np.maximum(np.clip(near, -1, 1.2), np.clip(head, -1, 1.6)), -1) + rough


def shore(rng):
    earth = pigment("bank", (0.10, 0.11, 0.03), (0.26, 0.23, 0.07), 0.6)
    near = grid("near bank", np.linspace(-26, 6, 130), np.linspace(2, 24, 90), bank, earth)
    head = grid("headland", np.linspace(2, 90, 160), np.linspace(74, 112, 60), bank, earth)
    count = 42000
    y = rng.uniform(4, 22, count)
    x = rng.uniform(-1, 0.25, count) * (4 + 0.62 * y)
    z = bank(x, y)
    kept = z > 0.03
    x, y, z = x[kept], y[kept], z[kept]
    greens = np.array([[0.10, 0.15, 0.03], [0.19, 0.22, 0.045], [0.36, 0.32, 0.09]])
    tone = greens[rng.integers(0, 3, len(x))] * rng.uniform(0.7, 1.3, (len(x), 1))
    petals = rng.uniform(0, 1, len(x)) < 0.02
    tone[petals] = np.array([[0.85, 0.8, 0.7], [0.75, 0.55, 0.1], [0.55, 0.35, 0.6]])[rng.integers(0, 3, petals.sum())]
    normal = np.stack([0.6 * rng.standard_normal(len(x)), -np.ones(len(x)), np.full(len(x), 0.9)], axis=1)
    up = np.stack([0.4 * rng.standard_normal(len(x)) + 0.2, 0.3 * rng.standard_normal(len(x)), np.ones(len(x))], axis=1)
    grass = cards("grass", np.stack([x, y, z], axis=1), normal, up, rng.uniform(0.12, 0.42, len(x)),
                  np.where(petals, 0.09, 0.045), leaf("grass", through=0.3), tone)
    count = 5000
    hx, hy = rng.uniform(4, 75, count), rng.uniform(78, 108, count)
    hz = bank(hx, hy)
    dry = hz > 0.1
    clump = np.array([[0.06, 0.10, 0.03], [0.13, 0.17, 0.04], [0.25, 0.25, 0.07]])
    at = np.stack([hx, hy, hz + np.abs(rng.standard_normal(count)) * 0.8], axis=1)[dry]
    size = rng.uniform(0.4, 1.1, dry.sum())
    tone = clump[rng.integers(0, 3, dry.sum())] * rng.uniform(0.7, 1.3, (dry.sum(), 1))
    growth = bushes("growth", at, size, tone, rng)
    count = 15000
    fx = rng.uniform(-330, 330, count)
    fy = 300 + rng.uniform(0, 60, count) + 30 * np.sin(fx / 70)
    tall = 3 + 9 * np.clip(ripple_noise(fx, fx * 0, 90, np.random.default_rng(12)) + 0.5, 0, 1.4)
    fz = rng.uniform(0, 1, count) ** 1.4 * tall
    wood = np.array([[0.13, 0.19, 0.12], [0.18, 0.235, 0.12], [0.30, 0.30, 0.15]])
    trees = bushes("far trees", np.stack([fx, fy, fz], axis=1), rng.uniform(2, 4.5, count),
                   wood[rng.integers(0, 3, count)] * rng.uniform(0.75, 1.25, (count, 1)), rng)
    ranges = [hills("far shore", 300, 9, 9, (0.17, 0.23, 0.10), (0.33, 0.34, 0.15), 4, -3, 0.5),
              hills("foothills", 560, 42, 40, (0.16, 0.24, 0.22), (0.24, 0.31, 0.24), 21, -3, 0.8, -120),
              hills("mountains", 1500, 210, 190, (0.21, 0.28, 0.42), (0.30, 0.37, 0.48), 33, -5, 0.62, 150),
              hills("far mountains", 3400, 560, 380, (0.36, 0.44, 0.58), (0.50, 0.55, 0.64), 8, -5, 0.5, -300)]
    return [near, head, grass, growth, trees, *ranges]


def birch(rng):
    stems = []
    for shift, lean, tall in [((0, 0), 0.20, 8.4), ((-0.9, 0.5), -0.10, 7.2)]:
        foot = BIRCH + [shift[0], shift[1], bank(np.array(BIRCH[0] + shift[0]),
                                                 np.array(BIRCH[1] + shift[1])) - BIRCH[2] - 0.1]
        rise = np.linspace(0, 1, 7)
        trunk = foot + np.stack([lean * tall * rise**1.6 + 0.12 * np.sin(5 * rise), 0.1 * np.sin(4 * rise),
                                 tall * 0.82 * rise], axis=1)
        turns = rng.uniform(0, 2 * np.pi, 15)
        heights = np.linspace(0.34, 1.0, 15)
        reach = 1.9 * np.sin(np.pi * (0.18 + 0.80 * heights)) + 0.25
        middle = np.stack([np.interp(heights, rise, trunk[:, 0]), np.interp(heights, rise, trunk[:, 1]),
                           foot[2] + tall * heights], axis=1)
        centres = middle + np.stack([np.cos(turns) * reach, np.sin(turns) * reach, -0.3 * reach], axis=1)
        radii = np.stack([0.75 + 0.1 * reach, 0.7 + 0.1 * reach, 1.05 + 0 * reach], axis=1)
        crown = Crown(centres, radii)
        nodes, parents = grow(trunk, crown, rng, step=0.22, lights=800)
        radius = thickness(parents, 0.009, 2.15)
        white = pigment("birch bark", (0.14, 0.11, 0.10), (0.72, 0.66, 0.58), 3.2)
        stems.append(bark("birch", nodes, parents, radius, white, 0.6))
        palette = np.array([[0.13, 0.21, 0.035], [0.22, 0.30, 0.05], [0.36, 0.38, 0.07], [0.50, 0.44, 0.09]])
        stems.append(leaves("birch leaves", nodes, radius, crown.broken(5, rng, 0.45),
                            leaf("birch leaves", through=0.45),
                            rng, palette, 17000, 0.14, 0.32, 0.9))
    return stems


def poplars(rng):
    things = []
    for k, (x, y, tall) in enumerate(POPLARS):
        foot = np.array([x, y, float(bank(np.array(x), np.array(y))) - 0.2])
        trunk = foot + np.stack([np.zeros(6), np.zeros(6), np.linspace(0, tall * 0.8, 6)], axis=1)
        levels = np.linspace(0.14, 0.97, 26)
        wide = 2.0 * np.sin(np.pi * levels**0.75) ** 0.7 + 0.25
        centres = foot + np.stack([rng.uniform(-0.35, 0.35, 26) * wide, rng.uniform(-0.35, 0.35, 26) * wide,
                                   tall * levels], axis=1)
        crown = Crown(centres, np.stack([0.75 * wide, 0.75 * wide, np.full(26, tall * 0.07)], axis=1))
        nodes, parents = grow(trunk, crown, rng, step=0.5, lights=500, reach=4)
        radius = thickness(parents, 0.025, 2.2)
        things.append(bark(f"poplar {k}", nodes, parents, radius,
                           pigment("poplar bark", (0.05, 0.04, 0.03), (0.2, 0.16, 0.11), 2)))
        palette = np.array([[0.07, 0.14, 0.04], [0.13, 0.21, 0.05], [0.26, 0.30, 0.06]])
        things.append(leaves(f"poplar leaves {k}", nodes, radius, crown.broken(5, rng, 0.5), leaf("poplar leaves"), rng,
                             palette, 9000, 0.42, 0.4, -0.8))
    return things


def reeds(rng):
    count = 420
    y = rng.uniform(5.6, 8.0, count)
    x = 1.1 + 0.42 * y - np.abs(rng.standard_normal(count)) * 0.75 + 0.25
    x = np.where(rng.uniform(0, 1, count) < 0.25, x - rng.uniform(0, 1.1, count), x)
    at = np.stack([x, y, np.full(count, -0.05)], axis=1)
    lean = np.stack([0.16 + 0.16 * rng.standard_normal(count), 0.1 * rng.standard_normal(count), np.ones(count)],
                    axis=1)
    length = rng.uniform(0.8, 1.95, count)
    normal = np.stack([0.5 * rng.standard_normal(count), -np.ones(count), 0.3 * np.ones(count)], axis=1)
    greens = np.array([[0.07, 0.11, 0.03], [0.15, 0.19, 0.045], [0.30, 0.28, 0.08], [0.42, 0.33, 0.13]])
    tone = greens[rng.integers(0, 4, count)] * rng.uniform(0.8, 1.2, (count, 1))
    stalks = cards("reeds", at, normal, lean, length, np.full(count, 0.035), leaf("reeds", through=0.35), tone)
    heads = rng.uniform(0, 1, count) < 0.09
    tip = at + lean / np.linalg.norm(lean, axis=1, keepdims=True) * length[:, None] * 0.97
    plumes = cards("cattails", tip[heads], normal[heads], lean[heads], np.full(heads.sum(), 0.24),
                   np.full(heads.sum(), 0.06),
                   leaf("cattails", through=0.1), np.tile([[0.13, 0.065, 0.03]], (heads.sum(), 1)))
    return [stalks, plumes]


def sailing_boat():
    boat = Boat((4.6, 30.0), 197, -5)
    wood, cloth = toned("paintwork", 0.5), toned("canvas", through=0.25)
    oak = pigment("spars", (0.28, 0.16, 0.07), (0.42, 0.26, 0.12), 3)
    boat.hull(6.6, 1.9, 0.62, wood, [(-2, (0.17, 0.045, 0.03)), (0.14, (0.62, 0.60, 0.53)), (0.78, (0.07, 0.16, 0.19)),
                                     (0.93, (0.45, 0.28, 0.12))])
    boat.spar((0.9, 0, 0.2), (0.75, 0, 6.3), 0.075, oak)
    boat.spar((0.8, 0, 1.15), (-3.2, -0.55, 1.35), 0.05, oak)
    boat.spar((0.78, 0, 4.5), (-1.7, -0.5, 6.9), 0.045, oak)
    boat.spar((2.9, 0, 0.85), (4.5, 0, 1.15), 0.05, oak)
    canvas = (1.0, 0.70, 0.38)
    boat.sail([(0.72, -0.05, 1.25), (-3.1, -0.55, 1.45), (-1.65, -0.5, 6.75), (0.72, -0.05, 4.5)], 0.35, cloth, canvas)
    boat.sail([(4.4, 0, 1.2), (0.95, -0.45, 1.3), (0.80, -0.02, 5.5), (0.82, 0, 5.5)], 0.3, cloth, (1.0, 0.86, 0.62), 5)
    boat.person((-1.9, -0.1, 0.42), (0.10, 0.14, 0.25), (0.75, 0.62, 0.36), wood)
    boat.person((-0.6, 0.25, 0.4), (0.72, 0.68, 0.62), (0.5, 0.12, 0.07), wood, 0.92)
    return boat


def clouds(rng):
    white = cloud("cloud", (0.95, 0.85, 0.74), (0.42, 0.45, 0.62), 0.4)
    return [cumulus("great cloud", (-250, 4600, 1180), 1900, 780, white, rng, 9),
            cumulus("left cloud", (-1750, 5200, 1500), 1900, 620, white, rng, 7),
            cumulus("middle cloud", (700, 5600, 900), 1500, 330, white, rng, 8),
            cumulus("right cloud", (2500, 5200, 1050), 1300, 420, white, rng, 7),
            cumulus("high cloud", (1500, 4200, 2080), 900, 150, white, rng, 7)]


SKY = [(64, 22, {"density": 1.7, "variety": 0.028}), (36, 12, {"density": 0.8, "variety": 0.03})]
CLOUDS = [(44, 18, {"density": 1.5, "variety": 0.025}), (26, 10, {"density": 1.2, "error": 0.02, "variety": 0.022}),
          (15, 6, {"error": 0.05, "variety": 0.02})]
LAND = [(24, 9, {"density": 1.8}), (14, 5, {"density": 1.2, "error": 0.035}), (9, 2.6, {"error": 0.06})]
WATER = [(46, 9, {"density": 1.8, "spread": 0.06}), (30, 5, {"density": 1.0, "error": 0.03, "spread": 0.05}),
         (17, 2.6, {"error": 0.06, "spread": 0.04})]
POPLAR = [(9, 4.5, {"density": 1.6, "spread": 0.4}), (6, 2.4, {"density": 1.3, "error": 0.04, "spread": 0.3})]
BOAT = [(15, 5, {"density": 1.6, "variety": 0.03, "spread": 0.12}),
        (9, 2.6, {"density": 1.3, "error": 0.03, "spread": 0.1}), (5, 1.7, {"error": 0.05, "spread": 0.1})]
MIRRORED = [(24, 5, {"density": 1.6, "spread": 0.06}), (14, 3, {"density": 1.2, "error": 0.04, "spread": 0.05})]
FOLIAGE = [(10, 5, {"density": 1.5, "spread": 0.7}),
           (8, 3.4, {"density": 1.6, "error": 0.03, "spread": 0.6, "lights_last": 0.8}),
           (5, 2, {"density": 1.3, "error": 0.05, "spread": 0.4, "lights_last": 0.8})]
REEDS = [(16, 3.2, {"density": 1.4, "spread": 0.1}), (10, 2, {"density": 1.2, "error": 0.05, "spread": 0.1})]


def set_stage(given) -> None:
    stage.clear(given.width, given.height, 12)
    stage.camera((0, 0, EYE), (1.2, 30, EYE + 0.55), 55)
    stage.sun(222, 25, (1.0, 0.79, 0.53), 5.8, 1.5)
    stage.sky([(0, (0.98, 0.80, 0.62)), (0.07, (0.86, 0.82, 0.72)), (0.2, (0.46, 0.65, 0.74)),
               (0.5, (0.15, 0.36, 0.60)),
               (1, (0.08, 0.2, 0.45))], 0.85)


def see(rng) -> dict:
    """Models all there is and renders each layer alone: display RGBA by name."""
    land, tree, far_trees, rushes, heaven = shore(rng), birch(rng), poplars(rng), reeds(rng), clouds(rng)
    boat = sailing_boat().parts
    lake = grid("lake", np.linspace(-420, 420, 3), np.linspace(0.5, 420, 3), lambda x, y: 0 * x,
                water("lake", (0.012, 0.045, 0.05), 0.35, 0.22, 1.3, 2.6, 8))
    everything = [*land, *tree, *far_trees, *rushes, *boat, lake]
    linear = {
        "sky": stage.render([], unseen=everything + heaven, transparent=False),
        "clouds": stage.render(heaven, unseen=everything),
        "shore": stage.render(land, hold_out=[lake]),
        "water": stage.render([lake], unmirrored=[*tree, *rushes, *boat]),
        "poplars": stage.render(far_trees, hold_out=land + [lake]),
        "boat": stage.render(boat, hold_out=[lake]),
        "reflection": stage.render_mirrored(boat, unseen=[lake, *rushes, *tree]),
        "birch": stage.render(tree, hold_out=land),
        "reeds": stage.render(rushes, hold_out=[lake]),
    }
    return {name: stage.display(image, 1.0, 1.12) for name, image in linear.items()}


def paint_layers(easel: Easel, seen: dict) -> list:
    """Name and painted layer, front first."""
    reflection = easel.mirror(seen["reflection"], stage.horizon(), 26, 11, 0.78, (0.02, 0.07, 0.075), 0.92)
    air, twigs = easel.wander(-0.15, 0.5, 220), easel.wander(0.9, 0.6, 30)
    sky = easel.paint(seen["sky"], SKY, air, 0, 0.15)
    drifting = easel.paint(seen["clouds"], CLOUDS, air, 9, 0.18)
    still = easel.paint(seen["shore"], LAND, -0.5, 5, 0.25, sharp=True)
    wet = spread_under(easel.paint(seen["water"], WATER, 0.0, 0, 0.2))
    standing = easel.paint(seen["poplars"], POPLAR, 1.3, 3, 0.25, sharp=True)
    afloat = easel.paint(seen["boat"], BOAT, 0.4, 4, 0.2, sharp=True)
    reflection = easel.paint(reflection, MIRRORED, 0.0, 0, 0.2)
    leaning = easel.paint(seen["birch"], FOLIAGE, twigs, 3, 0.28, sharp=True)
    rushing = easel.paint(seen["reeds"], REEDS, -1.4, 3, 0.25, sharp=True)
    return [("reeds", rushing), ("birch", leaning), ("boat", afloat), ("reflection", reflection), ("poplars", standing),
            ("shore", still), ("water", wet), ("clouds", drifting), ("sky", sky)]


def main() -> None:
    given = stage.asked(__doc__, HERE)
    easel = Easel(given.width, given.height, 1874)
    set_stage(given)
    layers = paint_layers(easel, see(easel.rng))
    write_sample(given.output, layers, filled=tuple(name for name, _ in layers[:-1]))
    # What the recipe says in pixels.
    print("horizon", stage.horizon())
    print("birch", stage.place(BIRCH), stage.place(BIRCH + [1.7, 0, 8.2]))
    print("poplars", stage.place((31, 88, 1)), stage.place((31, 88, 20)))
    print("waterline", [stage.place(point) for point in sailing_boat().waterline(1)])


if __name__ == "__main__":
    main()
