"""`harbour`: two fishing boats in a small port at sunset, seen from a boat that heels.

    build/blender-venv/bin/python blend_samples/harbour/scene.py [--width 1280]
"""

import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

import models.stage as stage  # noqa: E402
from models.boats import Boat  # noqa: E402
from models.clouds import cumulus  # noqa: E402
from models.harbour import block, house, tower  # noqa: E402
from models.land import bushes, hills  # noqa: E402
from models.materials import cloud, lamp, pigment, toned, water  # noqa: E402
from models.meshes import grid  # noqa: E402
from paint.easel import Easel  # noqa: E402
from paint.layers import spread_under, write_sample  # noqa: E402

EYE = 2.3
ROLL = 3.5
QUAY = -6.5  # x of its edge
TOP = 1.7  # its height


def port(rng):
    stone = pigment("stone", (0.13, 0.10, 0.09), (0.36, 0.28, 0.22), 1.4)
    walls, glass = toned("walls", 0.9), pigment("glass", (0.03, 0.04, 0.06), (0.08, 0.09, 0.12), 2, 0.15)
    glow = lamp("window light", (1.0, 0.50, 0.16), 3.0)
    things = [block("quay", (-60, 1.5, -1), (QUAY, 78, TOP), stone), block("mole", (-60, 78, -1), (9, 84, 1.5), stone),
              block("rim", (QUAY - 0.5, 1.5, TOP), (QUAY + 0.08, 78, TOP + 0.16), stone)]
    plaster = [(0.62, 0.42, 0.24), (0.55, 0.30, 0.22), (0.66, 0.56, 0.42), (0.50, 0.36, 0.30), (0.60, 0.48, 0.22)]
    tiles = [(0.24, 0.09, 0.055), (0.30, 0.13, 0.07), (0.20, 0.10, 0.08)]
    y = 13.0
    for k in range(10):
        length, eaves = rng.uniform(5, 7.5), rng.uniform(4.6, 7.6)
        things += house((-11.0 - rng.uniform(0, 0.8), y, TOP), (7.5, length, eaves), rng.uniform(2.2, 3.4),
                        plaster[k % 5], tiles[k % 3],
                        walls, glass, glow, rng)
        y += length + (0.1 if rng.uniform() < 0.7 else 2.0)
    for y in np.arange(6.0, 76, 4.5):
        things.append(tower("bollard", (QUAY - 0.6, y, TOP), 0.55, 0.16, 0.2, walls, [(0, (0.05, 0.045, 0.05))], 10))
    for y in np.arange(9.0, 76, 11.0):
        things.append(tower("lamp post", (QUAY - 1.6, y, TOP), 3.6, 0.09, 0.05, walls, [(0, (0.05, 0.05, 0.05))], 8))
        things.append(block("lantern", (QUAY - 1.78, y - 0.18, TOP + 3.55), (QUAY - 1.42, y + 0.18, TOP + 4.05),
                            lamp("lantern", (1.0, 0.6, 0.22), 9.0)))
    for y in np.arange(4.0, 70, 3.1):
        things.append(block("fender", (QUAY, y, 0.2), (QUAY + 0.16, y + 0.22, TOP - 0.1), walls, (0.09, 0.06, 0.045)))
    for _ in range(26):
        x, y, s = QUAY - rng.uniform(1.0, 3.4), rng.uniform(7, 50), rng.uniform(0.4, 0.8)
        if rng.uniform() < 0.5:
            things.append(tower("barrel", (x, y, TOP), s * 1.4, s * 0.48, s * 0.48, walls,
                                [(0, (0.22, 0.12, 0.06)), (0.3, (0.28, 0.16, 0.08)), (0.8, (0.2, 0.11, 0.06))], 12))
        else:
            things.append(block("crate", (x, y, TOP), (x + s, y + s, TOP + s * 0.8), walls, (0.34, 0.22, 0.11)))
    light = (5.5, 81, 1.5)
    things += [tower("lighthouse", light, 9.5, 1.5, 1.0, walls,
                     [(0, (0.62, 0.56, 0.50)), (0.36, (0.40, 0.10, 0.07)), (0.66, (0.62, 0.56, 0.50))]),
               tower("gallery", (light[0], light[1], 11.0), 0.35, 1.45, 1.45, walls, [(0, (0.1, 0.08, 0.08))]),
               tower("lamp room", (light[0], light[1], 11.3), 1.5, 0.75, 0.75, lamp("light", (1.0, 0.72, 0.36), 6),
                     [(0, (1, 1, 1))]),
               tower("cap", (light[0], light[1], 12.8), 1.0, 1.05, 0.05, walls, [(0, (0.35, 0.09, 0.06))])]
    things += [hills("cape", 320, 26, 22, (0.17, 0.14, 0.18), (0.26, 0.20, 0.20), 5, -3, 0.8, -180),
               hills("far cape", 900, 46, 40, (0.24, 0.20, 0.27), (0.30, 0.24, 0.28), 9, -5, 0.9, 250)]
    count = 2500
    x = rng.uniform(-70, -19, count)
    y = rng.uniform(20, 100, count)
    z = TOP + 7 + 0.12 * (-19 - x) + np.abs(rng.standard_normal(count)) * 2.5
    things.append(bushes("gardens", np.stack([x, y, z], axis=1), rng.uniform(0.7, 1.9, count),
                         np.array([[0.055, 0.07, 0.04]]) * rng.uniform(0.6, 1.8, (count, 1)), rng))
    return things


def near_boat():
    boat = Boat((4.3, 13.6), 204, 3)
    wood, cloth = toned("near paintwork", 0.45), toned("near canvas", through=0.6)
    oak = pigment("near spars", (0.18, 0.10, 0.05), (0.36, 0.21, 0.10), 3)
    boat.hull(7.4, 2.5, 0.95, wood, [(-2, (0.20, 0.06, 0.04)), (0.08, (0.05, 0.15, 0.19)), (0.72, (0.66, 0.54, 0.34)),
                                     (0.84, (0.05, 0.15, 0.19)), (0.94, (0.34, 0.19, 0.08))], 0.7, 0.6)
    boat.spar((0.9, 0, 0.2), (0.7, 0, 6.6), 0.10, oak)
    boat.spar((3.5, 0, 1.45), (5.2, 0, 1.95), 0.07, oak)
    boat.spar((0.75, 0.05, 1.85), (-3.3, 0.75, 2.1), 0.07, oak)
    boat.spar((0.9, 0.1, 4.7), (-2.1, 0.7, 6.6), 0.06, oak)
    for side in (1, -1):
        boat.spar((0.4, side * 1.15, 1.0), (0.72, 0, 6.0), 0.018, oak, 1.0)
        boat.spar((1.2, side * 1.1, 1.0), (0.74, 0, 6.0), 0.018, oak, 1.0)
    boat.spar((5.1, 0, 1.92), (0.7, 0, 6.4), 0.018, oak, 1.0)
    boat.sail([(0.68, 0.1, 1.95), (-3.2, 0.74, 2.2), (-2.0, 0.68, 6.45), (0.68, 0.1, 4.75)], -0.3, cloth,
              (0.80, 0.30, 0.12), 6)
    boat.person((-2.0, -0.2, 0.75), (0.09, 0.11, 0.17), (0.45, 0.30, 0.12), wood, 1.05)
    for k in range(3):
        boat.spar((-0.4 - 0.45 * k, 0.5, 0.55), (-0.4 - 0.45 * k, 0.5, 1.15), 0.22, toned("baskets"), 1.15)
    return boat


def far_boat():
    boat = Boat((-3.5, 27.0), 262, -2)
    wood = toned("far paintwork", 0.45)
    oak = pigment("far spars", (0.20, 0.12, 0.06), (0.40, 0.25, 0.12), 3)
    cloth = toned("far canvas", through=0.3)
    boat.hull(9.0, 3.0, 1.15, wood, [(-2, (0.08, 0.06, 0.06)), (0.1, (0.42, 0.11, 0.06)), (0.80, (0.62, 0.58, 0.50)),
                                     (0.92, (0.30, 0.17, 0.08))], 0.66, 0.6)
    boat.spar((1.4, 0, 0.3), (1.2, 0, 8.6), 0.11, oak)
    boat.spar((-2.6, 0, 0.3), (-2.75, 0, 6.4), 0.09, oak)
    boat.spar((4.2, 0, 1.75), (6.2, 0, 2.3), 0.08, oak)
    boat.spar((1.15, 0, 2.2), (-2.3, 0.3, 2.5), 0.30, cloth_pigment(), 0.75)
    boat.spar((-2.8, 0, 2.0), (-5.2, 0.2, 2.2), 0.2, cloth_pigment(), 0.7)
    for side in (1, -1):
        boat.spar((0.8, side * 1.4, 1.2), (1.2, 0, 8.0), 0.02, oak, 1.0)
        boat.spar((1.8, side * 1.3, 1.25), (1.22, 0, 8.0), 0.02, oak, 1.0)
    boat.spar((6.1, 0, 2.28), (1.2, 0, 8.3), 0.02, oak, 1.0)
    boat.spar((1.2, 0, 8.4), (-2.75, 0, 6.3), 0.018, oak, 1.0)
    boat.sail([(1.15, 0, 3.1), (0.2, 0.1, 2.6), (0.9, 0, 7.6), (1.15, 0, 7.9)], 0.15, cloth, (0.62, 0.45, 0.28), 4)
    return boat


def cloth_pigment():
    return pigment("furled canvas", (0.34, 0.18, 0.09), (0.62, 0.40, 0.22), 2.5)


def clouds(rng):
    ember = cloud("evening cloud", (0.80, 0.52, 0.42), (0.50, 0.31, 0.37), 0.5)
    things = []
    banks = [(300, 4200, 1020, 3600, 110), (-1500, 4600, 1500, 3000, 170), (1900, 4600, 1560, 3400, 200),
             (-700, 5200, 610, 3000, 70), (1900, 5600, 700, 3400, 80), (200, 4000, 2050, 3000, 150),
             (-2700, 5000, 850, 2600, 120)]
    for k, (x, y, z, wide, tall) in enumerate(banks):
        things.append(cumulus(f"bank {k}", (x, y, z), wide, tall, ember, rng, 22))
    return things


SKY = [(64, 20, {"density": 1.7, "variety": 0.03}), (36, 11, {"density": 0.9, "variety": 0.032})]
CLOUDS = [(46, 14, {"density": 1.5, "variety": 0.03}), (28, 8, {"density": 1.2, "error": 0.02, "variety": 0.03}),
          (16, 5, {"error": 0.05, "variety": 0.025})]
TOWN = [(22, 8, {"density": 1.8, "spread": 0.12}), (13, 4.4, {"density": 1.3, "error": 0.03, "spread": 0.1}),
        (8, 2.4, {"density": 1.2, "error": 0.05, "spread": 0.08})]
WATER = [(48, 9, {"density": 1.8, "spread": 0.07}), (30, 5, {"density": 1.0, "error": 0.03, "spread": 0.06}),
         (17, 2.6, {"error": 0.06, "spread": 0.05})]
BOAT = [(16, 5, {"density": 1.6, "variety": 0.03, "spread": 0.12}),
        (9, 2.6, {"density": 1.3, "error": 0.03, "spread": 0.1}), (5, 1.6, {"error": 0.05, "spread": 0.1})]
MIRRORED = [(24, 5, {"density": 1.6, "spread": 0.06}), (14, 3, {"density": 1.2, "error": 0.04, "spread": 0.05})]


def set_stage(given) -> None:
    stage.clear(given.width, given.height, 12)
    stage.camera((0, 0, EYE), (0.0, 20, EYE + 1.15), 70, ROLL)
    stage.sun(58, 9, (1.0, 0.52, 0.22), 5.5, 2.5)
    stage.sky([(0, (1.0, 0.52, 0.24)), (0.08, (0.86, 0.50, 0.34)), (0.22, (0.46, 0.38, 0.46)),
               (0.5, (0.16, 0.20, 0.38)),
               (1, (0.06, 0.09, 0.22))], 0.75, ((0.53, 0.85, 0.07), (1.6, 0.85, 0.32), 26))


def see(rng) -> dict:
    """Models all there is and renders each layer alone: display RGBA by name."""
    town, near, far, heaven = port(rng), near_boat().parts, far_boat().parts, clouds(rng)
    sea = grid("sea", np.linspace(-900, 900, 3), np.linspace(0.3, 900, 3), lambda x, y: 0 * x,
               water("sea", (0.012, 0.03, 0.045), 0.42, 0.30, 1.2, 2.2, 0))
    boats = [*near, *far]
    linear = {
        "sky": stage.render([], unseen=[*town, *boats, *heaven, sea], transparent=False),
        "clouds": stage.render(heaven, unseen=[*town, *boats, sea]),
        "town": stage.render(town, hold_out=[sea]),
        "water": stage.render([sea], unmirrored=boats),
        "near boat": stage.render(near, hold_out=[sea]),
        "far boat": stage.render(far, hold_out=[sea]),
        "near reflection": stage.render_mirrored(near, unseen=[sea]),
        "far reflection": stage.render_mirrored(far, unseen=[sea]),
    }
    return {name: stage.display(image, 1.05, 1.1) for name, image in linear.items()}


def paint_layers(easel: Easel, seen: dict) -> list:
    """Name and painted layer, front first."""
    mirrored = {f"{which} reflection": easel.mirror(seen[f"{which} reflection"], stage.horizon(), 30, 12, 0.72,
                                                    (0.05, 0.05, 0.07), 0.93) for which in ("near", "far")}
    tilt = np.radians(ROLL)
    air = easel.wander(-tilt, 0.25, 240)
    painted = {
        "sky": easel.paint(seen["sky"], SKY, air, 0, 0.15),
        "clouds": easel.paint(seen["clouds"], CLOUDS, air, 8, 0.18),
        "town": easel.paint(seen["town"], TOWN, -tilt, 4, 0.25, sharp=True),
        "water": spread_under(easel.paint(seen["water"], WATER, -tilt, 0, 0.2)),
    }
    for which in ("near", "far"):
        painted[f"{which} boat"] = easel.paint(seen[f"{which} boat"], BOAT, 0.2, 4, 0.2, sharp=True)
        painted[f"{which} reflection"] = easel.paint(mirrored[f"{which} reflection"], MIRRORED, -tilt, 0, 0.2)
    order = ("near boat", "near reflection", "far boat", "far reflection", "town", "water", "clouds", "sky")
    return [(name, painted[name]) for name in order]


def main() -> None:
    given = stage.asked(__doc__, HERE)
    easel = Easel(given.width, given.height, 1872)
    set_stage(given)
    layers = paint_layers(easel, see(easel.rng))
    write_sample(given.output, layers, filled=tuple(name for name, _ in layers[:-1]))
    # What the recipe says in pixels.
    print("horizon", stage.horizon())
    for boat in (near_boat(), far_boat()):
        print("waterline", [stage.place(point) for side in (1, -1) for point in boat.waterline(side)])


if __name__ == "__main__":
    main()
