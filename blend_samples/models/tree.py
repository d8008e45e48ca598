"""Trees: branches that grow towards the light of a crown made of lobes, and leaves at their twigs.

The branching is space colonisation (Runions, Lane, Prusinkiewicz 2007): points of light pull the nearest twig
and go out when one comes near. Thickness adds up as in da Vinci's rule, r^2.4 = sum of r_i^2.4.
"""

from dataclasses import dataclass

import bpy
import numpy as np

from .meshes import cards, mesh


@dataclass
class Crown:
    """Lobes: centres (L, 3) and radii (L, 3) in metres."""

    centres: np.ndarray
    radii: np.ndarray

    def broken(self, pieces: int, rng: np.random.Generator, size: float = 0.55) -> "Crown":
        """Each lobe as `pieces` smaller ones round its upper and outer side, so that light and shadow break up."""
        away = rng.standard_normal((len(self.centres), pieces, 3)) + [0, -0.35, 0.25]
        away /= np.linalg.norm(away, axis=2, keepdims=True)
        centres = self.centres[:, None] + 0.62 * away * self.radii[:, None]
        radii = self.radii[:, None] * size * rng.uniform(0.5, 1.25, (len(self.centres), pieces, 1))
        return Crown(centres.reshape(-1, 3), radii.reshape(-1, 3))


def grow(trunk: np.ndarray, crown: Crown, rng: np.random.Generator, step: float = 0.3, lights: int = 1500,
         reach: float = 3.0) -> tuple[np.ndarray, np.ndarray]:
    """Nodes (N, 3) and each one's parent (-1: foot) of a tree with the trunk (K, 3) given."""
    nodes = [trunk[0]]
    parents = [-1]
    for a, b in zip(trunk[:-1], trunk[1:]):
        pieces = max(int(np.linalg.norm(b - a) / step), 1)
        for k in range(pieces):
            nodes.append(a + (b - a) * (k + 1) / pieces)
            parents.append(len(nodes) - 2)
    size = crown.radii.prod(axis=1) ** (2 / 3)
    lobe = rng.choice(len(size), lights, p=size / size.sum())
    away = rng.standard_normal((lights, 3))
    away *= (rng.uniform(0.35, 1, (lights, 1)) ** 0.5) / np.linalg.norm(away, axis=1, keepdims=True)
    light = crown.centres[lobe] + away * crown.radii[lobe]
    nodes, parents = np.array(nodes), list(parents)
    nearest = np.full(lights, 1e9)
    owner = np.zeros(lights, int)
    fresh = np.arange(len(nodes))
    for _ in range(120):
        gap = np.linalg.norm(light[:, None] - nodes[None, fresh], axis=2)
        best = gap.argmin(axis=1)
        better = gap[np.arange(len(light)), best] < nearest
        nearest[better], owner[better] = gap[np.arange(len(light)), best][better], fresh[best[better]]
        alive = nearest > step * 1.3
        light, nearest, owner = light[alive], nearest[alive], owner[alive]
        pulling = nearest < (reach if len(nodes) > len(trunk) * 8 else 1e8)
        if not pulling.any():
            break
        pull = np.zeros_like(nodes)
        towards = (light - nodes[owner]) / nearest[:, None]
        np.add.at(pull, owner[pulling], towards[pulling])
        growing = np.flatnonzero(np.linalg.norm(pull, axis=1) > 0.05)
        heading = pull[growing] + 0.25 * rng.standard_normal((len(growing), 3))
        heading /= np.linalg.norm(heading, axis=1, keepdims=True)
        new = nodes[growing] + step * heading
        fresh = np.arange(len(nodes), len(nodes) + len(new))
        nodes = np.concatenate([nodes, new])
        parents += list(growing)
    return nodes, np.array(parents)


def thickness(parents: np.ndarray, twig: float = 0.018, power: float = 2.4) -> np.ndarray:
    """Radius of the branch at each node, in metres."""
    flow = np.zeros(len(parents))
    children = np.bincount(parents[parents >= 0], minlength=len(parents))
    flow[children == 0] = twig**power
    for k in range(len(parents) - 1, 0, -1):
        flow[parents[k]] += flow[k]
    return flow ** (1 / power)


def bark(name: str, nodes: np.ndarray, parents: np.ndarray, radius: np.ndarray, material: bpy.types.Material,
         flare: float = 0.8, sides: int = 7) -> bpy.types.Object:
    """The branches as tubes; `flare` widens the foot into roots."""
    foot = nodes[0]
    wide = radius * (1 + flare * np.exp(-np.linalg.norm(nodes - foot, axis=1) / 0.7))
    kept = np.flatnonzero(parents >= 0)
    a, b = nodes[parents[kept]], nodes[kept]
    ra, rb = wide[parents[kept]], wide[kept]
    ra = np.minimum(ra, rb * 1.6)
    axis = b - a
    axis /= np.linalg.norm(axis, axis=1, keepdims=True) + 1e-9
    other = np.where(np.abs(axis[:, 2:]) < 0.9, [[0, 0, 1.0]], [[1.0, 0, 0]])
    u = np.cross(axis, other)
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    v = np.cross(axis, u)
    turn = np.arange(sides) * 2 * np.pi / sides
    ring = u[:, None] * np.cos(turn)[None, :, None] + v[:, None] * np.sin(turn)[None, :, None]
    low = a[:, None] + ring * ra[:, None, None]
    high = (b + 0.15 * (b - a))[:, None] + ring * rb[:, None, None]
    points = np.concatenate([low, high], axis=1).reshape(-1, 3)
    base = np.arange(len(kept))[:, None] * 2 * sides
    k = np.arange(sides)[None, :]
    following = (k + 1) % sides
    faces = np.stack([base + k, base + following, base + sides + following, base + sides + k], axis=-1).reshape(-1, 4)
    return mesh(name, points, faces, material)


def leaves(name: str, nodes: np.ndarray, radius: np.ndarray, crown: Crown, material: bpy.types.Material,
           rng: np.random.Generator, palette: np.ndarray, count: int = 30000, size: float = 0.24,
           spread: float = 0.4, droop: float = 0.3) -> bpy.types.Object:
    """`count` leaves, a quarter round the thin twigs, the rest about the lobes' shells, turned outward from their lobe
    so that a lobe shades as one form.

    palette (P, 3) linear colours: each lobe leans to one of them, each leaf strays.
    """
    thin = np.flatnonzero(radius <= np.quantile(radius, 0.7))
    twig = rng.choice(thin, count // 4)
    shell = rng.integers(0, len(crown.centres), count - len(twig))
    away = rng.standard_normal((len(shell), 3))
    away *= rng.uniform(0.45, 1, (len(shell), 1)) ** 0.4 / np.linalg.norm(away, axis=1, keepdims=True)
    at = np.concatenate([nodes[twig], crown.centres[shell] + away * crown.radii[shell]])
    loose = np.where(rng.uniform(0, 1, (count, 1)) < 0.25, 0.8, 0.35)
    at += spread * loose * rng.standard_normal((count, 3)) * [1, 1, 0.8]
    gap = np.linalg.norm((at[:, None] - crown.centres[None]) / crown.radii[None], axis=2)
    lobe = gap.argmin(axis=1)
    out = (at - crown.centres[lobe]) / crown.radii[lobe]
    out /= np.linalg.norm(out, axis=1, keepdims=True) + 1e-9
    normal = out + 0.38 * rng.standard_normal((count, 3)) + [0, 0, 0.2]
    along = rng.standard_normal((count, 3)) + [0, 0, -droop]
    leaning = rng.integers(0, len(palette), len(crown.centres))
    pick = np.where(rng.uniform(0, 1, count) < 0.6, leaning[lobe], rng.integers(0, len(palette), count))
    tone = palette[pick] * rng.uniform(0.65, 1.3, (count, 1))
    scale = rng.uniform(0.6, 1.3, count)
    return cards(name, at, normal, along, size * scale, 0.62 * size * scale, material, tone)
