"""Meshes from arrays."""

import bpy
import numpy as np


def mesh(name: str, points: np.ndarray, faces: np.ndarray, material: bpy.types.Material,
         tones: np.ndarray | None = None, smooth: bool = True) -> bpy.types.Object:
    """An object of points (N, 3) and faces (M, corners); tones: a linear colour (M, 3), or colour and coverage
    (M, 4), a face: attribute "tone"."""
    data = bpy.data.meshes.new(name)
    corners = faces.shape[1]
    data.vertices.add(len(points))
    data.vertices.foreach_set("co", np.ascontiguousarray(points, np.float32).ravel())
    data.loops.add(faces.size)
    data.loops.foreach_set("vertex_index", np.ascontiguousarray(faces, np.int32).ravel())
    data.polygons.add(len(faces))
    data.polygons.foreach_set("loop_start", np.arange(0, faces.size, corners, dtype=np.int32))
    data.polygons.foreach_set("use_smooth", np.full(len(faces), smooth))
    data.update(calc_edges=True)
    data.validate()
    if tones is not None:
        attribute = data.color_attributes.new("tone", "FLOAT_COLOR", "CORNER")
        rgba = tones if tones.shape[1] == 4 else np.concatenate([tones, np.ones((len(tones), 1))], axis=1)
        attribute.data.foreach_set("color", np.repeat(rgba, corners, axis=0).astype(np.float32).ravel())
    data.materials.append(material)
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def grid(name: str, xs: np.ndarray, ys: np.ndarray, height, material: bpy.types.Material,
         tones=None) -> bpy.types.Object:
    """A height field over the grid xs x ys; height(x, y) and tones(x, y) take arrays."""
    x, y = np.meshgrid(xs, ys)
    points = np.stack([x, y, height(x, y)], axis=-1).reshape(-1, 3)
    index = np.arange(len(points)).reshape(x.shape)
    faces = np.stack([index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1]], axis=-1).reshape(-1, 4)
    middle = points[faces].mean(axis=1)
    return mesh(name, points, faces, material, None if tones is None else tones(middle[:, 0], middle[:, 1]))


def cards(name: str, at: np.ndarray, normal: np.ndarray, along: np.ndarray, length: np.ndarray, width: np.ndarray,
          material: bpy.types.Material, tones: np.ndarray) -> bpy.types.Object:
    """Leaves or blades: a lozenge each, of the given length and width, `along` made square to `normal`."""
    normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    along = along - (along * normal).sum(axis=1, keepdims=True) * normal
    along /= np.linalg.norm(along, axis=1, keepdims=True) + 1e-9
    side = np.cross(normal, along)
    length, width = np.asarray(length)[:, None], np.asarray(width)[:, None]
    corners = [at, at + along * length * 0.45 + side * width / 2, at + along * length,
               at + along * length * 0.45 - side * width / 2]
    points = np.stack(corners, axis=1).reshape(-1, 3)
    faces = np.arange(len(points)).reshape(-1, 4)
    return mesh(name, points, faces, material, tones, smooth=False)


def ripple_noise(x: np.ndarray, y: np.ndarray, size: float, rng: np.random.Generator, octaves: int = 4) -> np.ndarray:
    """Smooth heights of about -1..1 at places x, y: sums of sines of random heading, features of `size`."""
    total = np.zeros_like(x, dtype=float)
    for k in range(octaves):
        for _ in range(4):
            heading, phase = rng.uniform(0, 2 * np.pi, 2)
            turns = 2 * np.pi / size * 2**k * rng.uniform(0.7, 1.3)
            total += 0.3 * 0.5**k * np.sin(turns * (x * np.cos(heading) + y * np.sin(heading)) + phase)
    return total
