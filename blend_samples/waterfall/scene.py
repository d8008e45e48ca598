"""`waterfall`: water that falls in three strands over mossy rock into a pool, an afternoon late in summer.

    build/blender-venv/bin/python blend_samples/waterfall/scene.py [--width 800]
"""

import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

import models.stage as stage  # noqa: E402
from models.falls import Cliff, boulder, foam, strand  # noqa: E402
from models.harbour import halo  # noqa: E402
from models.land import bushes, hills  # noqa: E402
from models.materials import leaf, pigment, toned, water  # noqa: E402
from models.meshes import cards, grid, ripple_noise  # noqa: E402
from models.pine import pine  # noqa: E402
from models.tree import Crown, bark, grow, leaves, thickness  # noqa: E402
from paint.easel import Easel  # noqa: E402
from paint.fields import twice  # noqa: E402
from paint.layers import airy, outlined, over, room, spread_under, write_sample  # noqa: E402

EYE = (0.0, 0.0, 2.7)
CLIFF = Cliff()
STRANDS = [[(-0.2, 10.9, 1.7), (-0.25, 8.9, 1.8), (-0.6, 7.4, 2.1), (-0.75, 5.6, 2.6), (-0.5, 3.6, 3.0), (-0.35, 0.0, 3.5)],
           [(1.7, 10.8, 0.6), (1.75, 9.0, 0.7), (2.25, 7.2, 0.95), (2.45, 4.6, 1.2), (2.4, 2.4, 1.6), (2.5, 0.0, 1.8)],
           [(-1.75, 10.9, 0.35), (-1.95, 9.0, 0.4), (-2.65, 6.6, 0.5), (-2.8, 3.5, 0.7), (-2.85, 0.0, 0.9)]]
BIRCH = (-2.75, 8.6)
FEET = [(-0.35, 17.6, 1.0), (2.5, 17.5, 0.75), (-2.85, 17.6, 0.5)]
SPLITS = [(-0.50, 5.7, 0.46), (0.42, 2.7, 0.42), (-1.35, 3.4, 0.3)]  # rocks in the falling water: x, z, radius


def bank(x, y):
    """Height of the ground beside the pool and of its bed, metres."""
    rough = 0.22 * ripple_noise(x, y, 2.2, np.random.default_rng(11), 4)
    shore = 2.15 + 0.13 * y + 0.5 * np.sin(0.5 * y + 1)
    left = 0.55 * (-x - shore) + 0.10
    right = 0.50 * (x - shore - 0.4) + 0.05
    return np.clip(np.maximum(left, right), -0.8, 2.3) + rough


def rocks(rng):
    """Boulders in the pool and along its shore."""
    rock = pigment("boulder", (0.13, 0.12, 0.105), (0.44, 0.40, 0.34), 2.5, 0.7, attribute="tone")
    near = [(-1.75, 6.2, 0.75), (-0.85, 5.6, 0.34), (1.75, 6.6, 0.62), (2.5, 7.6, 0.95), (-2.6, 8.2, 0.9), (0.75, 7.4, 0.26),
            (-1.2, 9.6, 0.34), (3.1, 10.6, 0.7), (-3.4, 12.0, 0.8), (1.55, 12.6, 0.42), (3.9, 13.6, 0.9), (-4.2, 14.6, 1.0),
            (0.95, 15.9, 0.85), (-1.95, 16.4, 0.7), (3.7, 16.4, 0.8), (-3.7, 16.8, 0.75), (1.25, 16.9, 1.1), (4.9, 15.4, 1.2)]
    things = []
    for x, y, size in near:
        tone = np.array([1.0, 0.95, 0.86]) * rng.uniform(0.55, 1.0) + np.array([-0.12, 0.02, -0.16]) * rng.uniform(0, 1)
        things.append(boulder("boulder", (x, y, 0.12 * size), size * rng.uniform([0.85, 0.75, 0.55], [1.15, 1.0, 0.8]), rock, tone, rng))
    for x, z, size in SPLITS:
        at = (x, float(CLIFF.depth(np.array(x), np.array(z))) - 0.45, z)
        things.append(boulder("boulder", at, (1.2 * size, 0.9 * size, 0.75 * size), rock, np.array([0.5, 0.48, 0.44]), rng))
    for _ in range(150):
        y = rng.uniform(4.5, 18)
        x = rng.choice([-1, 1]) * (2.2 + 0.13 * y + 0.5 * np.sin(0.5 * y + 1) + np.abs(rng.normal(0, 0.5)))
        size = rng.uniform(0.08, 0.34)
        things.append(boulder("pebble", (x, y, float(bank(np.array(x), np.array(y)))), (size, size, 0.7 * size), rock,
                            np.array([1.0, 0.94, 0.85]) * rng.uniform(0.5, 1.0), rng))
    return things


def shore(rng):
    earth = pigment("bank", (0.07, 0.085, 0.025), (0.20, 0.20, 0.06), 1.2)
    ground = grid("ground", np.linspace(-12, 12, 200), np.linspace(2.5, 20, 160), bank, earth)
    count = 26000
    x, y = rng.uniform(-9, 9, count), rng.uniform(3.5, 18, count)
    z = bank(x, y)
    dry = z > 0.22
    x, y, z = x[dry], y[dry], z[dry]
    greens = np.array([[0.07, 0.12, 0.025], [0.15, 0.20, 0.04], [0.30, 0.30, 0.07]])
    tone = greens[rng.integers(0, 3, len(x))] * rng.uniform(0.7, 1.3, (len(x), 1))
    normal = np.stack([0.6 * rng.standard_normal(len(x)), -np.ones(len(x)), np.full(len(x), 0.9)], axis=1)
    up = np.stack([0.5 * rng.standard_normal(len(x)), 0.4 * rng.standard_normal(len(x)), np.ones(len(x))], axis=1)
    grass = cards("grass", np.stack([x, y, z], axis=1), normal, up, rng.uniform(0.12, 0.4, len(x)),
                  np.full(len(x), 0.05), leaf("grass", through=0.3), tone)
    return [ground, grass, *ferns(rng)]


def ferns(rng):
    """Fronds on the banks, in tufts."""
    at, along, normal, length = [], [], [], []
    for x, y, size in ((-2.75, 5.6, 0.75), (-3.5, 6.9, 0.9), (2.75, 5.5, 0.7), (3.4, 6.6, 0.85), (-4.0, 9.0, 0.9), (4.2, 9.4, 0.9),
                       (-2.35, 4.9, 0.5), (2.35, 4.7, 0.5), (-4.9, 11.5, 1.0), (5.2, 12.0, 1.0)):
        foot = np.array([x, y, float(bank(np.array(x), np.array(y))) - 0.02])
        for _ in range(13):
            turn, reach = rng.uniform(0, 2 * np.pi), size * rng.uniform(0.7, 1.1)
            out = np.array([np.cos(turn), np.sin(turn), 0])
            t = np.linspace(0.08, 1, 26)
            spine = foot + reach * (t[:, None] * 0.8 * out + (0.95 * t - 0.75 * t**2)[:, None] * np.array([0, 0, 1]))
            side = np.array([-np.sin(turn), np.cos(turn), 0])
            for sign in (-1, 1):
                at.append(spine)
                along.append(sign * side + 0.5 * out + np.stack([0 * t, 0 * t, -0.4 * t], axis=1))
                normal.append(np.stack([0 * t, 0 * t, 1 + 0 * t], axis=1) + 0.3 * rng.standard_normal((len(t), 3)) - 0.4 * np.array([0, 1, 0]))
                length.append(0.30 * reach * np.sin(np.pi * (0.1 + 0.88 * t)))
    at, along, normal, length = np.concatenate(at), np.concatenate(along), np.concatenate(normal), np.concatenate(length)
    tone = np.array([0.16, 0.27, 0.05]) * rng.uniform(0.6, 1.35, (len(at), 1))
    return [cards("ferns", at, normal, along, length, 0.32 * length, leaf("fern", through=0.4), tone)]


def wood(rng):
    """Pines and bushes on the cliff, hills in the haze behind."""
    timber = toned("pine bark", 0.9)
    things = []
    for x, away, height, spread in ((-4.4, 2.0, 7.5, 1.6), (-6.3, 3.0, 9.0, 2.0), (-3.0, 7.0, 6.5, 1.5), (3.9, 2.2, 6.5, 1.5), (5.4, 3.5, 9.0, 1.9),
                                    (7.2, 2.5, 8.0, 1.9), (-8.2, 2.4, 8.0, 1.9), (2.6, 10.0, 6.0, 1.4), (4.6, 12.0, 8.0, 1.8),
                                    (-4.9, 11.0, 9.0, 1.9), (9.0, 4.0, 9.5, 2.1)):
        foot = (x, CLIFF.far + away, float(CLIFF.top(np.array([x]))[0]))
        things += pine(foot, height, spread, timber, np.array([0.075, 0.13, 0.06]) * rng.uniform(0.8, 1.3), rng, 0.08, 14)
    count = 5200
    x = np.concatenate([rng.uniform(-11, -2.7, count // 2), rng.uniform(3.0, 11, count // 2)])
    z = CLIFF.top(x) + np.abs(rng.normal(0, 0.45, count)) - 0.25
    y = CLIFF.depth(x, z) + rng.uniform(-0.2, 1.6, count)
    share = rng.uniform(0, 1, count) < 0.36  # on ledges of the wall
    z = np.where(share, rng.uniform(0.12, 0.95, count) * CLIFF.top(x), z)
    ledge = ripple_noise(x, z * 2, 2.4, np.random.default_rng(3), 3) > 0.25
    kept = ~share | ledge
    y = np.where(share, CLIFF.depth(x, z) - rng.uniform(0.05, 0.3, count), y)
    greens = np.array([[0.08, 0.14, 0.03], [0.16, 0.22, 0.04], [0.32, 0.33, 0.07], [0.42, 0.30, 0.06]])
    tone = greens[rng.integers(0, 4, count)] * rng.uniform(0.7, 1.3, (count, 1))
    things.append(bushes("bushes", np.stack([x, y, z], axis=1)[kept], rng.uniform(0.16, 0.42, count)[kept], tone[kept], rng))
    things.append(hills("far wood", 120, 38, 26, (0.30, 0.40, 0.34), (0.44, 0.50, 0.36), 17, 0, 0.7, 20))
    return things


def birch(rng):
    """A birch that leans from the left bank over the pool."""
    foot = np.array([*BIRCH, float(bank(*np.array(BIRCH))) - 0.15])
    rise = np.linspace(0, 1, 8)
    trunk = foot + np.stack([0.75 * rise**1.7 - 0.35 * np.sin(2.6 * rise), -0.3 * rise, 8.0 * rise], axis=1)
    heights = np.linspace(0.44, 1.02, 28)
    turns = rng.uniform(0, 2 * np.pi, 28)
    reach = 1.0 * np.sin(np.pi * (0.16 + 0.78 * np.linspace(0, 1, 28))) + 0.2
    middle = np.stack([np.interp(heights, rise, trunk[:, axis]) for axis in range(2)] + [foot[2] + 8.0 * heights], axis=1)
    centres = middle + np.stack([np.cos(turns) * reach, np.sin(turns) * reach, -0.25 * reach], axis=1)
    crown = Crown(centres, np.stack([0.5 + 0.1 * reach, 0.5 + 0.1 * reach, 0.62 + 0 * reach], axis=1))
    nodes, parents = grow(trunk, crown, rng, step=0.2, lights=700)
    radius = thickness(parents, 0.008, 2.2)
    white = pigment("birch bark", (0.14, 0.11, 0.10), (0.72, 0.66, 0.58), 3.2)
    palette = np.array([[0.17, 0.24, 0.04], [0.30, 0.33, 0.05], [0.48, 0.42, 0.07], [0.62, 0.42, 0.06]])
    return [bark("birch", nodes, parents, radius, white, 0.6),
            leaves("birch leaves", nodes, radius, crown.broken(5, rng, 0.5), leaf("birch leaves", through=0.45), rng, palette,
                   13000, 0.13, 0.26, 0.9)]


AIR = [(60, 24, {"density": 1.7, "variety": 0.025}), (34, 12, {"density": 1.0, "variety": 0.025})]
STANDING = [(30, 11, {"density": 1.8, "spread": 0.3, "variety": 0.04}), (18, 6.5, {"density": 1.4, "error": 0.02, "spread": 0.3}),
            (11, 4, {"density": 1.3, "error": 0.035, "spread": 0.25}), (7, 2.4, {"error": 0.06, "spread": 0.2})]
GREEN = [(14, 7, {"density": 1.6, "spread": 0.6}), (10, 4.5, {"density": 1.5, "error": 0.03, "spread": 0.5, "lights_last": 0.8}),
         (7, 2.6, {"density": 1.2, "error": 0.05, "spread": 0.4, "lights_last": 0.8})]
POOL = [(46, 10, {"density": 1.8, "spread": 0.06}), (28, 5.5, {"density": 1.1, "error": 0.025, "spread": 0.06}),
        (16, 3, {"error": 0.05, "spread": 0.05})]
FALL = [(56, 11, {"density": 1.9, "spread": 0.05, "variety": 0.025, "lights_last": 0.5}),
        (36, 6, {"density": 1.5, "error": 0.02, "spread": 0.04, "variety": 0.03, "lights_last": 0.6}),
        (22, 3.2, {"density": 1.3, "error": 0.04, "spread": 0.04, "variety": 0.03, "lights_last": 0.7})]
MIST = [(50, 26, {"density": 1.7, "variety": 0.015, "spread": 0.8}), (30, 14, {"density": 0.9, "variety": 0.015, "spread": 0.8})]


def set_stage(given) -> None:
    stage.clear(given.width // 2, given.height // 2, 14)
    stage.camera(EYE, (0.15, 20, 3.9), 42)
    stage.sun(212, 40, (1.0, 0.84, 0.60), 5.2, 1.5)
    stage.sky([(0, (0.98, 0.88, 0.70)), (0.25, (0.86, 0.86, 0.78)), (0.5, (0.52, 0.69, 0.78)), (1, (0.16, 0.34, 0.58))], 0.9)


def see(rng) -> dict:
    """Models all there is and renders each layer alone: display RGBA by name."""
    wall, boulders, land, trees, tree = CLIFF.model(), rocks(rng), shore(rng), wood(rng), birch(rng)
    falls = [strand(CLIFF, path, rng, SPLITS) for path in STRANDS]
    froth = foam(FEET, rng)
    mist = [halo("mist", (x, y - 1.2, 0.55 + 0.5 * s), EYE, 1.3 + 1.5 * s, (0.93, 0.94, 0.92), 0.45 + 0.3 * s) for x, y, s in FEET]
    pool = grid("pool", np.linspace(-14, 14, 3), np.linspace(1, 22, 3), lambda x, y: 0 * x,
                water("pool", (0.014, 0.05, 0.045), 0.4, 0.30, 0.9, 2.2, 8))
    standing = [wall, *boulders, *land]
    fluid = [*falls, froth, *mist]
    linear = {
        "air": stage.render([], unseen=[*standing, *trees, *tree, pool, *fluid], transparent=False),
        "trees": stage.render(trees, unseen=fluid, hold_out=standing),
        "rock": stage.render(standing, unseen=[*fluid, *trees[-1:]], hold_out=[pool]),
        "pool": stage.render([pool], unseen=[froth, *mist], hold_out=standing, unmirrored=tree),
        "foam": stage.render([froth], unseen=[*falls, *mist], hold_out=standing),
        "fall": stage.render(falls, unseen=[froth, *mist], hold_out=[*boulders, *land, pool]),
        "mist": stage.render(mist, unseen=[*falls, froth, *boulders, wall, pool]),
        "tree": stage.render(tree, unseen=fluid, hold_out=[*land, *boulders]),
    }
    return {name: twice(stage.display(image, 1.05, 1.14)) for name, image in linear.items()}


def paint_layers(easel: Easel, seen: dict) -> list:
    """Name and painted layer, front first."""
    upright, level = easel.wander(np.pi / 2, 0.12, 140), easel.wander(0.0, 0.10, 160)
    still = easel.paint(seen["air"], AIR, easel.wander(-0.3, 0.5, 220), 0, 0.12)
    still = over(outlined(easel.paint(seen["trees"], GREEN, easel.wander(0.9, 0.6, 30), 3, 0.22), seen["trees"], 0.6), still)
    still = over(spread_under(easel.paint(seen["pool"], POOL, level, 0, 0.15)), still)
    still = over(outlined(easel.paint(seen["rock"], STANDING, easel.wander(1.2, 0.5, 90), 5, 0.24), seen["rock"], 0.8), still)

    froth = outlined(easel.paint(seen["foam"], POOL, level, 4, 0.12), seen["foam"], 0.6)
    wet = np.clip(seen["pool"][..., 3], 0, 1)
    wet = airy(over(froth, still)[..., :3], room(wet, 2 * easel.scale, 1.0, 1 - wet))
    behind = over(wet, still)

    fall = outlined(easel.paint(seen["fall"], FALL, upright, 5, 0.14), seen["fall"], 0.6)
    body = room(fall[..., 3], 5 * easel.scale, 1.9, np.zeros_like(fall[..., 3]))
    falling = airy(over(fall, behind)[..., :3], body)
    behind = over(falling, behind)

    mist = outlined(easel.paint(seen["mist"], MIST, easel.wander(0.6, 0.9, 120), 0, 0.0), seen["mist"], 0.9)
    leaning = easel.paint(seen["tree"], GREEN, easel.wander(0.9, 0.6, 30), 3, 0.26, sharp=True)
    return [("birch", leaning), ("mist", mist), ("fall", falling), ("pool", wet), ("rock", still)]


def main() -> None:
    given = stage.asked(__doc__, HERE, 800, (2, 3))
    easel = Easel(given.width, given.height, 1840)
    easel.scale = given.width / 1000  # a tall picture: its brushes go by its height too
    set_stage(given)
    layers = paint_layers(easel, see(easel.rng))
    write_sample(given.output, layers, filled=tuple(name for name, _ in layers[:-1]))
    # What the recipe says in pixels.
    for path in STRANDS:
        print("strand", [tuple(2 * np.array(stage.place((x, CLIFF.far - 1.5, z)))) for x, z, _ in path])
    print("feet", [tuple(2 * np.array(stage.place((x, y, 0)))) for x, y, _ in FEET])
    print("birch", *(2 * np.array(stage.place(at)) for at in ((*BIRCH, 0.3), (BIRCH[0] + 0.6, BIRCH[1], 7.6))))


if __name__ == "__main__":
    main()
