"""Boats: hulls lofted from stations, spars, sails, and people in them."""

import bpy
import numpy as np

from .meshes import mesh


def turned(points: np.ndarray, heading: float, heel: float = 0.0) -> np.ndarray:
    """Points of a boat (bow at +X) heeled about its length and turned to `heading`, degrees from +X to +Y."""
    a, b = np.radians(heading), np.radians(heel)
    roll = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    yaw = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    return points @ roll.T @ yaw.T


class Boat:
    """A boat under construction at a place on the water (z = 0); parts are added, `parts` holds the objects."""

    def __init__(self, at: tuple, heading: float, heel: float = 0.0) -> None:
        self.at, self.heading, self.heel = np.array([at[0], at[1], 0.0]), heading, heel
        self.parts: list[bpy.types.Object] = []

    def put(self, points: np.ndarray) -> np.ndarray:
        """Points of the boat's own space (bow +X, port +Y, water at 0) in the world's."""
        return turned(np.asarray(points, float), self.heading, self.heel) + self.at

    def hull(self, length: float, beam: float, freeboard: float, material: bpy.types.Material, bands: list,
             stern: float = 0.62, sheer: float = 0.5) -> None:
        """bands: (height from which it holds as a share of the freeboard, linear colour), lowest first.

        stern: how broad the transom is, in beams; sheer: how far the bow rises, in freeboards.
        """
        self.length, self.beam, self.stern = length, beam, stern
        s = np.linspace(-1, 1, 81)
        rise = freeboard * (1 + sheer * np.clip(s, 0, 1) ** 2 + 0.3 * sheer * np.clip(-s, 0, 1) ** 2)
        v = np.linspace(0, 1, 61)
        skin, inner = [], []
        for side in (1, -1):
            half = self.half_beam(s)[:, None] * (0.55 + 0.45 * np.sqrt(v))[None, :]
            x = s[:, None] * length / 2 + np.clip(s, 0, 1)[:, None] ** 2 * 0.06 * length * v[None, :]
            z = -0.3 * freeboard + v[None, :] * (rise[:, None] + 0.3 * freeboard)
            outside = np.stack([x, side * half, z], axis=-1)
            inside = np.stack([x, side * np.clip(half - 0.05, 0, None), z - 0.01], axis=-1)
            skin.append(outside)
            inner.append(inside)
        for k, (sheet, pull) in enumerate([(skin[0], 0), (skin[1], 0), (inner[0], 1), (inner[1], 1)]):
            faces = _sheet(sheet.shape[:2])
            middle = sheet.reshape(-1, 3)[faces].mean(axis=1)
            share = middle[:, 2] / np.interp(middle[:, 0] / (length / 2), s, rise)
            tones = np.zeros((len(faces), 3))
            for low, colour in bands:
                tones[share >= low] = colour
            if pull:
                tones[:] = np.array(bands[-1][1]) * 0.55
            self.parts.append(mesh(f"hull {k}", self.put(sheet.reshape(-1, 3)), faces, material, tones))
        cross = np.stack([skin[0][0], skin[1][0]])
        faces = _sheet(cross.shape[:2])
        self.parts.append(mesh("transom", self.put(cross.reshape(-1, 3)), faces, material,
                               np.tile(np.array(bands[-1][1]) * 0.8, (len(faces), 1))))
        deck = np.stack([inner[0][:, 30], inner[1][:, 30]])
        faces = _sheet(deck.shape[:2])
        self.parts.append(mesh("floor", self.put(deck.reshape(-1, 3)), faces, material,
                               np.tile([0.16, 0.1, 0.05], (len(faces), 1))))

    def half_beam(self, s: np.ndarray) -> np.ndarray:
        """Half the beam at station s (-1 stern .. 1 bow), metres."""
        bow = np.clip(1 - np.clip(s, 0, 1) ** 2.2, 0, 1)
        aft = 1 - (1 - self.stern) * np.clip(-s, 0, 1) ** 2
        return self.beam / 2 * bow * aft

    def waterline(self, side: int, count: int = 7, reach: float = 0.95) -> np.ndarray:
        """Points (count, 3) of the world along the hull at the water, from stern to bow; side 1 port, -1 starboard."""
        s = np.linspace(-1, reach, count)
        y = side * self.half_beam(s) * 0.86
        flat = np.stack([s * self.length / 2, y, 0 * s], axis=-1)
        return turned(flat, self.heading) + self.at

    def spar(self, start: tuple, end: tuple, thick: float, material: bpy.types.Material, thin: float = 0.6) -> None:
        """A round pole from start to end in the boat's space; thick: its radius, `thin` of it at the end."""
        a, b = np.asarray(start, float), np.asarray(end, float)
        axis = (b - a) / np.linalg.norm(b - a)
        u = np.cross(axis, [0.3, 0.9, 0.2])
        u /= np.linalg.norm(u)
        v = np.cross(axis, u)
        turn = np.arange(9) * 2 * np.pi / 8
        ring = np.cos(turn)[:, None] * u + np.sin(turn)[:, None] * v
        tube = np.stack([a + ring * thick, b + ring * thick * thin])
        self.parts.append(mesh("spar", self.put(tube.reshape(-1, 3)), _sheet(tube.shape[:2]), material))

    def sail(self, corners: list, belly: float, material: bpy.types.Material, tone: tuple, seams: int = 7,
             stain: float = 0.12, folds: float = 0.0) -> None:
        """A sail between four corners (tack, clew, peak, throat; the last two may agree), bellied to starboard.

        folds: height, in metres, of the creases that run from its corners; such a sail has a reef band, too.
        """
        tack, clew, peak, throat = (np.asarray(c, float) for c in corners)
        u, v = np.meshgrid(np.linspace(0, 1, 73 if folds else 24), np.linspace(0, 1, 97 if folds else 30))
        u, v = u[..., None], v[..., None]
        sheet = (1 - v) * ((1 - u) * tack + u * clew) + v * ((1 - u) * throat + u * peak)
        sheet = sheet + np.array([0, -1.0, 0]) * belly * np.sin(np.pi * u) ** 0.8 * np.sin(np.pi * (0.15 + 0.8 * v))
        if folds:
            sheet = sheet + np.array([0, folds, 0]) * _creases(u, v)
        faces = _sheet(sheet.shape[:2])
        place = (u * np.ones_like(v)).reshape(-1)[faces].mean(axis=1)
        high = (v * np.ones_like(u)).reshape(-1)[faces].mean(axis=1)
        cloth = 1 - 0.14 * ((place * seams) % 1 < 0.17) - stain * (1 - high) + 0.05 * np.sin(9 * high + 4 * place)
        if folds:
            cloth += 0.07 * np.sin(12.9 * np.floor(place * seams) + 1) - 0.16 * (np.abs(high - 0.3) < 0.012)
        self.parts.append(mesh("sail", self.put(sheet.reshape(-1, 3)), faces, material,
                               np.array(tone) * cloth[:, None]))

    def person(self, at: tuple, coat: tuple, hat: tuple, material: bpy.types.Material, tall: float = 1.0) -> None:
        """A sitting figure, its seat at `at` in the boat's space."""
        at = np.asarray(at, float)
        for centre, radii, tone in [((0, 0, 0.32), (0.2, 0.24, 0.36), coat),
                                    ((0.06, 0, 0.78), (0.11, 0.1, 0.13), (0.45, 0.24, 0.15)),
                                    ((0.05, 0, 0.87), (0.2, 0.19, 0.03), hat),
                                    ((0.05, 0, 0.92), (0.11, 0.1, 0.08), hat),
                                    ((0.25, 0, 0.08), (0.3, 0.2, 0.12), tuple(0.6 * c for c in coat)),
                                    ((0.18, 0.15, 0.4), (0.24, 0.07, 0.07), coat)]:
            tilt, turn = np.meshgrid(np.linspace(0, np.pi, 9), np.linspace(0, 2 * np.pi, 13))
            ball = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], axis=-1)
            points = at + tall * (np.array(centre) + ball * np.array(radii))
            faces = _sheet(ball.shape[:2])
            self.parts.append(mesh("person", self.put(points.reshape(-1, 3)), faces, material,
                                   np.tile(tone, (len(faces), 1))))


def _creases(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Heights, about -1..1, of the creases a pulled cloth throws at its corners (u, v in 0..1)."""
    height = np.zeros_like(u * v)
    for corner_u, corner_v, turns, phase in ((0, 0, 15, 0.4), (1, 0, 13, 2.0), (1, 1, 17, 1.1), (0, 1, 14, 3.0)):
        away = np.hypot(u - corner_u, v - corner_v)
        bearing = np.arctan2(np.abs(v - corner_v), np.abs(u - corner_u) + 1e-6)
        height += np.sin(turns * bearing + phase) * np.exp(-1.8 * away) * np.clip(3 * away, 0, 1)
    return height + 0.35 * np.sin(2 * np.pi * (2.3 * u + 0.6 * v) + 0.8)


def _sheet(shape: tuple[int, int]) -> np.ndarray:
    index = np.arange(shape[0] * shape[1]).reshape(shape)
    return np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
