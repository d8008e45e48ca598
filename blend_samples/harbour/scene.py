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
from models.clouds import evening_banks  # noqa: E402
from models.harbour import block, courses, halo, house, tower  # noqa: E402
from models.land import hills  # noqa: E402
from models.materials import lamp, pigment, toned, water  # noqa: E402
from models.meshes import grid  # noqa: E402
from paint.easel import Easel  # noqa: E402
from paint.layers import outlined, over, spread_under, write_sample  # noqa: E402

EYE = 2.3
ROLL = 3.5
QUAY = -6.5  # x of its edge
TOP = 1.7  # its height
SUN = (58, 6.5)  # where it stands: azimuth and elevation, degrees


def port(rng):
    stone = pigment("stone", (0.13, 0.10, 0.09), (0.36, 0.28, 0.22), 1.4)
    walls, glass = toned("walls", 0.9), pigment("glass", (0.03, 0.04, 0.06), (0.08, 0.09, 0.12), 2, 0.15)
    glow = lamp("window light", (1.0, 0.44, 0.11), 0.95)
    things = [block("quay", (-60, 1.5, -1), (QUAY, 78, TOP), stone), block("mole", (-60, 78, -1), (9, 84, 1.5), stone),
              block("rim", (QUAY - 0.5, 1.5, TOP), (QUAY + 0.08, 78, TOP + 0.16), stone),
              courses("courses", QUAY, (1.5, 78), (-0.2, TOP), walls, (0.27, 0.20, 0.155), rng)]
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
                            lamp("lantern", (1.0, 0.50, 0.15), 1.5)))
    for y in np.arange(4.0, 70, 3.1):
        things.append(block("fender", (QUAY, y, 0.2), (QUAY + 0.16, y + 0.22, TOP - 0.1), walls, (0.13, 0.085, 0.06)))
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
               tower("lamp room", (light[0], light[1], 11.3), 1.5, 0.75, 0.75, lamp("light", (1.0, 0.54, 0.17), 1.5),
                     [(0, (1, 1, 1))]),
               tower("cap", (light[0], light[1], 12.8), 1.0, 1.05, 0.05, walls, [(0, (0.35, 0.09, 0.06))])]
    things += [hills("cape", 320, 26, 22, (0.17, 0.14, 0.18), (0.26, 0.20, 0.20), 5, -3, 0.8, -180),
               hills("far cape", 900, 46, 40, (0.24, 0.20, 0.27), (0.30, 0.24, 0.28), 9, -5, 0.9, 250)]
    return things


def glows(town) -> list:
    """The soft light round lanterns, the lighthouse's lamp and lit windows."""
    sizes = {"lantern": (1.5, 0.62), "lamp room": (4.2, 0.75), "window": (1.2, 0.20)}
    discs = []
    for thing in town:
        kind = thing.name.split(".")[0]
        if kind in sizes and thing.active_material.name.split(".")[0] in {"lantern", "light", "window light"}:
            radius, cover = sizes[kind]
            corners = np.array([corner.co for corner in thing.data.vertices])
            discs.append(halo("halo", corners.mean(axis=0), (0, 0, EYE), radius, (1.0, 0.48, 0.15), cover))
    return discs


def near_boat():
    boat = Boat((4.3, 13.6), 204, 3)
    wood, cloth = toned("near paintwork", 0.45), toned("near canvas", through=0.48)
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
              (0.74, 0.60, 0.44), 6, folds=0.07)
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
    boat.sail([(1.15, 0, 3.1), (0.2, 0.1, 2.6), (0.9, 0, 7.6), (1.15, 0, 7.9)], 0.15, cloth, (0.62, 0.50, 0.36), 4)
    return boat


def cloth_pigment():
    return pigment("furled canvas", (0.34, 0.18, 0.09), (0.62, 0.40, 0.22), 2.5)


def rigging(boat) -> list:
    """Its spars and ropes, which a thinner brush paints."""
    return [part for part in boat.parts if part.active_material.name.endswith("spars")]


def clouds(rng):
    azimuth, elevation = np.radians(SUN)
    sun = (1 / np.tan(azimuth), np.tan(elevation) / np.sin(azimuth))
    banks = [(0.50, 0.078, 0.9, 0.016, 0.42), (0.15, 0.100, 0.9, 0.018, 0.40), (-0.30, 0.115, 1.3, 0.030, 0.34),
             (0.45, 0.150, 1.1, 0.030, 0.40), (-0.55, 0.190, 1.1, 0.060, 0.44), (0.20, 0.235, 1.2, 0.055, 0.41),
             (0.62, 0.290, 1.1, 0.080, 0.50), (-0.25, 0.340, 1.3, 0.100, 0.48), (0.35, 0.430, 1.3, 0.090, 0.46),
             (-0.55, 0.500, 1.2, 0.100, 0.46)]
    return [evening_banks("evening clouds", 4500, sun, banks, rng)]


SKY = [(64, 20, {"density": 1.7, "variety": 0.02}), (36, 11, {"density": 0.9, "variety": 0.022})]
CLOUDS = [(46, 14, {"density": 1.5, "variety": 0.03}), (28, 8, {"density": 1.2, "error": 0.02, "variety": 0.03}),
          (16, 5, {"error": 0.05, "variety": 0.025})]
TOWN = [(22, 8, {"density": 1.8, "spread": 0.12}), (13, 4.4, {"density": 1.3, "error": 0.03, "spread": 0.1}),
        (8, 2.4, {"density": 1.2, "error": 0.05, "spread": 0.08})]
WATER = [(48, 9, {"density": 1.8, "spread": 0.07}), (30, 5, {"density": 1.0, "error": 0.03, "spread": 0.06}),
         (17, 2.6, {"error": 0.06, "spread": 0.05})]
BOAT = [(16, 5, {"density": 1.6, "variety": 0.03, "spread": 0.12}),
        (9, 2.6, {"density": 1.3, "error": 0.03, "spread": 0.1}), (5, 1.6, {"error": 0.05, "spread": 0.1})]
RIGGING = [(12, 2.6, {"density": 2.0, "variety": 0.03, "spread": 0.04}),
           (8, 1.5, {"error": 0.04, "spread": 0.04})]
GLOW = [(26, 12, {"density": 1.6, "variety": 0.015}), (15, 7, {"density": 1.0, "variety": 0.015})]
MIRRORED = [(24, 5, {"density": 1.6, "spread": 0.06}), (14, 3, {"density": 1.2, "error": 0.04, "spread": 0.05})]


def set_stage(given) -> None:
    stage.clear(given.width, given.height, 12)
    stage.camera((0, 0, EYE), (0.0, 20, EYE + 1.15), 70, ROLL)
    stage.sun(*SUN, (1.0, 0.52, 0.22), 5.0, 2.5, mirrored=False)
    azimuth, elevation = np.radians(SUN)
    towards = (np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation), np.sin(elevation))
    stage.sky([(0, (1.0, 0.52, 0.24)), (0.08, (0.86, 0.50, 0.34)), (0.22, (0.46, 0.38, 0.46)),
               (0.5, (0.16, 0.20, 0.38)),
               (1, (0.06, 0.09, 0.22))], 0.75, ((0.53, 0.85, 0.08), (1.1, 0.47, 0.13), 22),
              (towards, (3.0, 1.25, 0.14), 900))


def see(rng) -> dict:
    """Models all there is and renders each layer alone: display RGBA by name."""
    town, near, far, heaven = port(rng), near_boat(), far_boat(), clouds(rng)
    lights = glows(town)
    sea = grid("sea", np.linspace(-900, 900, 3), np.linspace(0.3, 900, 3), lambda x, y: 0 * x,
               water("sea", (0.012, 0.03, 0.045), 0.42, 0.30, 1.2, 2.2, 0))
    boats = [*near.parts, *far.parts]
    linear = {
        "sky": stage.render([], unseen=[*town, *lights, *boats, *heaven, sea], transparent=False),
        "clouds": stage.render(heaven, unseen=[*town, *lights, *boats, sea]),
        "town": stage.render(town, hold_out=[sea]),
        "glow": stage.render(lights, hold_out=[*town, sea]),
        "water": stage.render([sea], unmirrored=boats),
    }
    for which, boat in (("near", near), ("far", far)):
        lines = rigging(boat)
        body = [part for part in boat.parts if part not in lines]
        linear[f"{which} boat"] = stage.render(body, hold_out=[sea])
        linear[f"{which} rigging"] = stage.render(lines, hold_out=[*body, sea])
        linear[f"{which} reflection"] = stage.render_mirrored(boat.parts, unseen=[sea])
    return {name: stage.display(image, 1.05, 1.1) for name, image in linear.items()}


def paint_layers(easel: Easel, seen: dict) -> list:
    """Name and painted layer, front first."""
    mirrored = {f"{which} reflection": easel.mirror(seen[f"{which} reflection"], stage.horizon(), 30, 12, 0.72,
                                                    (0.05, 0.05, 0.07), 0.93) for which in ("near", "far")}
    tilt = np.radians(ROLL)
    air = easel.wander(-tilt, 0.25, 240)
    painted = {
        "sky": easel.paint(seen["sky"], SKY, air, 0, 0.15),
        "clouds": outlined(easel.paint(seen["clouds"], CLOUDS, air, 8, 0.18), seen["clouds"], 0.65),
        "town": over(outlined(easel.paint(seen["glow"], GLOW, air, 0, 0.05), seen["glow"]),
                     outlined(easel.paint(seen["town"], TOWN, -tilt, 4, 0.25, sharp=True), seen["town"])),
        "water": spread_under(easel.paint(seen["water"], WATER, -tilt, 0, 0.2)),
    }
    for which in ("near", "far"):
        whole = seen[f"{which} boat"]
        body = outlined(easel.paint(whole, BOAT, 0.2, 4, 0.2, sharp=True), whole, 0.7)
        lines = seen[f"{which} rigging"]
        painted[f"{which} boat"] = over(outlined(easel.paint(lines, RIGGING, 1.5, 3, 0.15), lines), body)
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
