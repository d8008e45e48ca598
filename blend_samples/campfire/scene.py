"""`campfire`: a fire among pines at night, a tent in its light.

    build/blender-venv/bin/python blend_samples/campfire/scene.py [--width 960]
"""

import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))

import models.stage as stage  # noqa: E402
from models.fire import log, stone, tongue, wisp  # noqa: E402
from models.harbour import block, halo  # noqa: E402
from models.materials import lamp, pigment, toned  # noqa: E402
from models.meshes import grid, mesh, ripple_noise  # noqa: E402
from models.pine import pine  # noqa: E402
from paint.easel import Easel  # noqa: E402
from paint.fields import twice  # noqa: E402
from paint.layers import airy, outlined, over, room, write_sample  # noqa: E402

EYE = (0.0, 0.0, 1.35)
FIRE = np.array([0.0, 6.0, 0.0])


def ground(rng):
    seed = rng.integers(1 << 30)

    def form(x, y):
        return 0.05 * ripple_noise(x, y, 1.7, np.random.default_rng(seed), 4) + 0.02 * np.hypot(x, y - 6) - 0.08

    earth = pigment("earth", (0.10, 0.062, 0.036), (0.34, 0.22, 0.125), 5)
    return grid("ground", np.linspace(-22, 22, 260), np.linspace(0.5, 40, 220), form, earth)


def hearth(rng):
    """What stands behind the flames, and what stands before them."""
    rock, wood = pigment("rock", (0.14, 0.12, 0.11), (0.42, 0.37, 0.32), 6, attribute="tone"), toned("bark", 0.9)
    back, front = [], []
    for k in range(13):
        turn = 2 * np.pi * (k + rng.uniform(-0.16, 0.16)) / 13
        size = np.array([rng.uniform(0.15, 0.22), rng.uniform(0.14, 0.19), rng.uniform(0.11, 0.17)])
        at = FIRE + [0.86 * np.cos(turn), 0.62 * np.sin(turn), 0.05]
        (back if np.sin(turn) > 0.25 else front).append(stone("stone", at, size, rock, (1, 1, 1), rng))
    char = (0.045, 0.032, 0.026)
    for x, y, top_x, top_z in ((-0.62, 0.2, 0.16, 0.78), (0.6, 0.25, -0.14, 0.82), (0.1, 0.5, 0.02, 0.7)):
        back.append(log("log", FIRE + [x, y, 0.04], FIRE + [top_x, 0.05, top_z], 0.075, wood, char, rng))
    for x, y, top_x, top_z in ((-0.5, -0.36, 0.2, 0.36), (0.55, -0.3, -0.2, 0.40), (0.02, -0.5, 0.02, 0.24)):
        front.append(log("log", FIRE + [x, y, 0.06], FIRE + [top_x, 0.0, top_z], 0.085, wood, char, rng, (0.42, 0.15, 0.04)))
    coal = lamp("coal", (1.0, 0.22, 0.03), 1.5)
    for _ in range(70):
        x, y = rng.normal(0, 0.26), rng.normal(-0.08, 0.2)
        s = rng.uniform(0.025, 0.06)
        at = FIRE + [x, y, 0.02]
        front.append(block("coal", at, at + [s * 1.5, s, s], coal))
    return back, front


def camp(rng):
    """A tent, logs to sit on, split wood."""
    wood, cloth = toned("old bark", 0.9), toned("canvas", through=0.25)
    things = [log("seat", (-2.55, 5.3, 0.2), (-1.45, 6.9, 0.2), 0.2, wood, (0.20, 0.125, 0.075), rng),
              log("seat", (1.5, 4.75, 0.18), (2.6, 5.75, 0.19), 0.19, wood, (0.19, 0.12, 0.075), rng)]
    for k, (x, z) in enumerate(((-3.55, 0.1), (-3.3, 0.1), (-3.05, 0.1), (-3.42, 0.3), (-3.18, 0.3), (-3.3, 0.48))):
        things.append(log("firewood", (x, 6.9, z), (x - 0.1, 8.0, z), 0.115, wood, (0.16, 0.10, 0.065), rng))
    base, ridge = np.array([2.75, 8.3, 0.0]), 1.75
    turn = np.radians(32)
    right, back = np.array([np.cos(turn), np.sin(turn), 0]), np.array([-np.sin(turn), np.cos(turn), 0])
    u, v = np.meshgrid(np.linspace(-1, 1, 41), np.linspace(0, 1, 16))
    sag = 0.06 * np.sin(np.pi * v) * (1 - np.abs(u)) + 0.10 * np.sin(np.pi * np.abs(u))
    points = (base + (u * 1.35)[..., None] * right + (v * 2.6)[..., None] * back
              + ((1 - np.abs(u)) * ridge - sag)[..., None] * np.array([0, 0, 1.0]))
    index = np.arange(u.size).reshape(u.shape)
    faces = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    things.append(mesh("tent", points.reshape(-1, 3), faces, cloth, np.tile((0.62, 0.50, 0.33), (len(faces), 1))))
    inside = base + 0.35 * back
    for side in (-1, 1):  # the two flaps, drawn aside
        flap = np.array([inside + side * 1.28 * right, inside + side * 0.42 * right - 0.25 * back + [0, 0, 0.02],
                         inside + side * 0.06 * right + [0, 0, ridge - 0.12], inside + side * 0.10 * right + [0, 0, ridge - 0.12]])
        things.append(mesh("flap", flap, np.array([[0, 1, 2, 3]]), cloth, np.array([(0.56, 0.44, 0.28)]), smooth=False))
    return things


def wood(rng):
    bark = toned("pine bark", 0.9)
    near = [(-4.6, 8.6, 11.5, 2.2, 0.26), (-2.7, 11.2, 9.5, 2.0, 0.12), (5.6, 10.8, 12.5, 2.3, 0.22),
            (3.6, 13.2, 10.5, 2.0, 0.1), (-6.9, 11.8, 13.0, 2.5, 0.2), (1.25, 15.5, 8.2, 1.9, 0.06),
            (8.3, 13.5, 12.0, 2.5, 0.15), (-0.9, 17.5, 7.2, 1.8, 0.06)]
    things = []
    for x, y, height, spread, bare in near:
        things += pine((x, y, -0.1), height, spread, bark, (0.075, 0.10, 0.045), rng, bare)
    for x in np.arange(-19, 20, 2.1):
        at = (x + rng.uniform(-0.8, 0.8), rng.uniform(22, 30), -0.1)
        things += pine(at, rng.uniform(6.0, 10.5), rng.uniform(1.6, 2.3), bark, (0.05, 0.075, 0.07), rng, 0.03, 9)
    return things


def stars(rng):
    shine = lamp("star", (0.80, 0.86, 1.0), 1.1)
    lights = []
    for _ in range(90):
        x, z, s = rng.uniform(-150, 150), rng.uniform(30, 160), rng.uniform(0.25, 0.75) ** 2
        at = np.array([x, 250, z])
        lights.append(block("star", at - s, at + s, shine))
    return lights


def flames(rng):
    tongues = []
    for count, spread, tall, wide, heat, away in ((11, 0.46, (0.95, 2.05), 0.36, 0.36, 0.06), (13, 0.35, (0.70, 1.70), 0.26, 0.62, 0.0),
                                                  (11, 0.26, (0.45, 1.15), 0.19, 1.0, -0.06)):
        for k in range(count):
            share = (k + rng.uniform(0.2, 0.8)) / count * 2 - 1
            x = spread * share
            height = (tall[0] + (tall[1] - tall[0]) * (1 - abs(share) ** 1.4)) * rng.uniform(0.72, 1.12)
            at = FIRE + [x, away + rng.uniform(-0.03, 0.03), 0.06]
            tongues.append(tongue(at, height, wide * rng.uniform(0.7, 1.2), -0.55 * x + rng.normal(0, 0.07), heat, rng))
    return tongues


def smokes(rng):
    return [wisp(FIRE + [x, 0.2, z], 2.6, width, lean, (0.085, 0.10, 0.135), cover, rng)
            for x, z, width, lean, cover in ((-0.08, 1.25, 0.5, 0.25, 0.42), (0.10, 1.4, 0.4, 0.62, 0.36),
                                             (0.0, 1.3, 0.8, 0.45, 0.36), (-0.14, 1.5, 0.36, -0.08, 0.34))]


NIGHT = [(60, 20, {"density": 1.7, "variety": 0.03}), (32, 10, {"density": 1.2, "error": 0.015, "variety": 0.035}),
         (16, 5, {"density": 1.2, "error": 0.03, "variety": 0.035}), (9, 3, {"error": 0.05, "variety": 0.03})]
STANDING = [(26, 9, {"density": 1.7, "spread": 0.3, "variety": 0.04}), (15, 5, {"density": 1.3, "error": 0.02, "spread": 0.25}),
            (9, 3, {"density": 1.3, "error": 0.035, "spread": 0.2}), (6, 2, {"error": 0.06, "spread": 0.15})]
GLOW = [(44, 18, {"density": 1.6, "variety": 0.02}), (24, 9, {"density": 1.0, "variety": 0.02})]
SMOKE = [(46, 11, {"density": 1.8, "variety": 0.03, "spread": 0.12}), (26, 5, {"density": 1.2, "variety": 0.03, "spread": 0.12})]
FLAME = [(44, 11, {"density": 1.8, "spread": 0.10, "variety": 0.03, "lights_last": 0.7}),
         (28, 5.5, {"density": 1.5, "error": 0.02, "spread": 0.08, "variety": 0.04, "lights_last": 0.7}),
         (16, 3, {"density": 1.2, "error": 0.04, "spread": 0.08, "variety": 0.04, "lights_last": 0.7})]


def set_stage(given) -> None:
    stage.clear(given.width // 2, given.height // 2, 12)
    stage.camera(EYE, (0.36, 6, 1.22), 50)
    stage.glimmer(FIRE + [0, -0.02, 0.62], (1.0, 0.47, 0.14), 330, 0.28)
    stage.glimmer(FIRE + [0.05, 0.1, 1.15], (1.0, 0.42, 0.11), 130, 0.35)
    stage.sun(125, 38, (0.45, 0.6, 1.0), 0.10, 3)
    stage.sky([(0, (0.075, 0.13, 0.19)), (0.12, (0.045, 0.085, 0.155)), (0.3, (0.020, 0.042, 0.10)),
               (0.7, (0.008, 0.017, 0.05))], 1.0)


def see(rng) -> dict:
    """Models all there is and renders each layer alone: display RGBA by name."""
    earth, tents, trees, heaven = ground(rng), camp(rng), wood(rng), stars(rng)
    back, front = hearth(rng)
    fire, smoke = flames(rng), smokes(rng)
    haze = [halo("halo", FIRE + [0, 0.5, 0.8], EYE, 2.6, (0.62, 0.19, 0.045), 0.42)]
    air = [*fire, *smoke, *haze, *heaven]
    linear = {
        "sky": stage.render(heaven, unseen=[*fire, *smoke, *haze], transparent=False),
        "trees": stage.render(trees, unseen=air, hold_out=[earth, *tents]),
        "camp": stage.render([earth, *tents, *back, *front], unseen=air),
        "front": stage.render(front, unseen=air, hold_out=[earth]),
        "glow": stage.render(haze, unseen=[*fire, *smoke, *heaven]),
        "smoke": stage.render(smoke, unseen=[*fire, *haze, *heaven]),
        "fire": stage.render(fire, unseen=[*smoke, *haze, *heaven]),
    }
    return {name: twice(stage.display(image, 1.15, 1.12)) for name, image in linear.items()}


def paint_layers(easel: Easel, seen: dict) -> list:
    """Name and painted layer, front first."""
    level = easel.wander(0.0, 0.22, 260)
    upright = easel.wander(np.pi / 2, 0.16, 120)
    night = easel.paint(seen["sky"], NIGHT, easel.wander(-0.35, 0.5, 260), 0, 0.1)
    night = over(outlined(easel.paint(seen["camp"], STANDING, level, 5, 0.22), seen["camp"], 0.6), night)
    night = over(outlined(easel.paint(seen["trees"], STANDING, upright, 5, 0.2), seen["trees"], 0.8), night)
    haze = outlined(easel.paint(seen["glow"], GLOW, easel.wander(0.6, 0.8, 200), 0, 0.03), seen["glow"])
    night = over(0.7 * haze, night)  # it hangs before and behind
    hidden = np.clip(seen["front"][..., 3], 0, 1)

    smoke = outlined(easel.paint(seen["smoke"], SMOKE, upright, 9, 0.0), seen["smoke"], 0.9)
    air = room(smoke[..., 3], 12 * easel.scale, 2.6, hidden)
    smoky = airy(over(smoke, night)[..., :3], air)
    behind = over(smoky, night)

    fire = outlined(easel.paint(seen["fire"], FLAME, upright, 5, 0.16), seen["fire"], 0.35)
    heat = room(fire[..., 3], 15 * easel.scale, 2.6, hidden)
    burning = airy(over(fire, behind)[..., :3], heat)
    return [("fire", burning), ("smoke", smoky), ("night", night)]


def main() -> None:
    given = stage.asked(__doc__, HERE, 960)
    easel = Easel(given.width, given.height, 1903)
    set_stage(given)
    write_sample(given.output, paint_layers(easel, see(easel.rng)), filled=("fire", "smoke"))
    # What the recipe says in pixels.
    print("foot", *(2 * np.array(stage.place(FIRE))), "tips", *(2 * np.array(stage.place(FIRE + [0, 0, 1.6]))))


if __name__ == "__main__":
    main()
