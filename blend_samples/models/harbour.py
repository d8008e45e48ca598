"""A small port: houses with gables, a quay with its furniture, a lighthouse."""

import bpy
import numpy as np

from .materials import veil
from .meshes import mesh


def block(name: str, low: tuple, high: tuple, material: bpy.types.Material,
          tone: tuple = (1, 1, 1)) -> bpy.types.Object:
    """A box from corner `low` to corner `high`."""
    corners = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    faces = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    return mesh(name, corners, faces, material, np.tile(tone, (6, 1)), smooth=False)


def house(at: tuple, size: tuple, roof: float, wall: tuple, tiles: tuple, paint: bpy.types.Material,
          glass: bpy.types.Material, glow: bpy.types.Material, rng: np.random.Generator) -> list:
    """A house with its front towards +X and its gable towards -Y.

    at: corner (largest x, smallest y, ground); size: depth along -X, length along +Y, height to the eaves, metres;
    roof: height of the ridge over the eaves. Some windows are lit.
    """
    x, y, z = at
    depth, length, eaves = size
    things = [block("walls", (x - depth, y, z), (x, y + length, z + eaves), paint, wall)]
    over = 0.35
    ridge = (x - depth / 2, z + eaves + roof)
    rim = np.array([[x + over, y - over, z + eaves - 0.15], [x + over, y + length + over, z + eaves - 0.15],
                    [ridge[0], y + length + over, ridge[1]], [ridge[0], y - over, ridge[1]],
                    [x - depth - over, y + length + over, z + eaves - 0.15], [x - depth - over, y - over,
                                                                              z + eaves - 0.15]])
    things.append(mesh("roof", rim, np.array([[0, 1, 2, 3], [3, 2, 4, 5]]), paint, np.tile(tiles, (2, 1)),
                       smooth=False))
    gable = np.array([[x, y, z + eaves], [x - depth, y, z + eaves], [ridge[0], y, ridge[1] - 0.15],
                      [ridge[0], y, ridge[1] - 0.16]])
    things.append(mesh("gable", gable, np.array([[0, 1, 2, 3]]), paint, np.array([wall]), smooth=False))
    chimney = y + length * rng.uniform(0.2, 0.8)
    things.append(block("chimney", (ridge[0] - 0.3, chimney, ridge[1] - 0.5),
                        (ridge[0] + 0.3, chimney + 0.7, ridge[1] + 0.9), paint, (0.28, 0.13, 0.09)))
    floors = max(int(eaves // 2.6), 1)
    for floor in range(floors):
        low = z + 0.9 + floor * eaves / floors
        for along in np.arange(y + 0.9, y + length - 1.2, 1.75):
            lit = glow if rng.uniform() < 0.28 else glass
            things.append(block("frame", (x, along - 0.12, low - 0.12), (x + 0.04, along + 0.97, low + 1.42), paint,
                                (0.5, 0.45, 0.38)))
            things.append(block("window", (x, along, low), (x + 0.07, along + 0.85, low + 1.3), lit))
        for across in np.arange(x - depth + 0.9, x - 1.1, 1.8):
            lit = glow if rng.uniform() < 0.3 else glass
            things.append(block("window", (across, y - 0.06, low), (across + 0.85, y, low + 1.3), lit))
    return things


def tower(name: str, at: tuple, height: float, low: float, high: float, material: bpy.types.Material, bands: list,
          sides: int = 20) -> bpy.types.Object:
    """A round tower with radii `low` to `high`; bands: (share of the height from which it holds, linear colour)."""
    levels = np.linspace(0, 1, 31)
    turn = np.arange(sides) * 2 * np.pi / sides
    radius = low + (high - low) * levels**0.7
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    points = np.concatenate([np.stack([*(at[:2] + ring * r).T, np.full(sides, at[2] + height * level)], axis=-1)
                             for r, level in zip(radius, levels)])
    k, s = np.meshgrid(np.arange(30), np.arange(sides), indexing="ij")
    faces = np.stack([k * sides + s, k * sides + (s + 1) % sides, (k + 1) * sides + (s + 1) % sides,
                      (k + 1) * sides + s], axis=-1).reshape(-1, 4)
    share = (points[faces].mean(axis=1)[:, 2] - at[2]) / height
    tones = np.zeros((len(faces), 3))
    for start, colour in bands:
        tones[share >= start] = colour
    return mesh(name, points, faces, material, tones)


def courses(name: str, wall: float, along: tuple, high: tuple, material: bpy.types.Material, tone: tuple,
            rng: np.random.Generator, course: float = 0.44) -> bpy.types.Object:
    """The dressed stones of a wall at x = `wall` that faces +X, from along[0] to along[1] and high[0] to high[1]."""
    points, tones = [], []
    for low in np.arange(high[0], high[1] - 0.1, course):
        top = min(low + course, high[1]) - 0.03
        start = along[0] - rng.uniform(0, 1)
        while start < along[1]:
            end = start + rng.uniform(0.7, 1.5)
            out = wall + rng.uniform(0.01, 0.05)
            points += [(out, start, low), (out, end - 0.03, low), (out, end - 0.03, top), (out, start, top)]
            tones.append(np.array(tone) * rng.uniform(0.7, 1.2) * rng.uniform(0.94, 1.06, 3))
            start = end
    faces = np.arange(len(points)).reshape(-1, 4)
    return mesh(name, np.array(points), faces, material, np.array(tones), smooth=False)


def halo(name: str, at: tuple, eye: tuple, radius: float, tone: tuple, cover: float) -> bpy.types.Object:
    """The glow round a lamp, a disc turned to the eye: `cover` (0..1) in its middle, none at its rim."""
    at = np.asarray(at, float)
    ahead = np.asarray(eye, float) - at
    ahead /= np.linalg.norm(ahead)
    side = np.cross([0, 0, 1], ahead)
    side /= np.linalg.norm(side)
    rise = np.cross(ahead, side)
    rings, sectors = np.linspace(0, 1, 15), 32
    turn = np.arange(sectors) * 2 * np.pi / sectors
    circle = np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * rise
    points = at + ahead * 0.4 + radius * (rings[:, None, None] * circle)
    k, s = np.meshgrid(np.arange(len(rings) - 1), np.arange(sectors), indexing="ij")
    faces = np.stack([k * sectors + s, k * sectors + (s + 1) % sectors,
                      (k + 1) * sectors + (s + 1) % sectors, (k + 1) * sectors + s], axis=-1).reshape(-1, 4)
    fade = cover * (1 - (rings[:-1] + rings[1:]) / 2) ** 2.2
    tones = np.concatenate([np.tile(tone, (len(faces), 1)), np.repeat(fade, sectors)[:, None]], axis=1)
    disc = mesh(name, points.reshape(-1, 3), faces, veil(name), tones)
    disc.visible_shadow = disc.visible_diffuse = False
    return disc
