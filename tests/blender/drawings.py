"""Pictures to draw on, and strokes in their drawings as Blender's brush would leave them."""

import importlib

import bpy
import numpy as np
from pixels import PACKAGE

strokes = importlib.import_module(f"{PACKAGE}.strokes")
versions = importlib.import_module(f"{PACKAGE}.versions")
SIZE = (1280, 800)  # px


def lay_out(scene, picture) -> None:
    """Gives a picture its plane, 8 m wide with its middle at the origin, and an object for strokes."""
    plane = bpy.data.objects.new("Plane", None)
    plane.empty_display_type, plane.empty_display_size, plane.empty_image_offset = "IMAGE", 8, (-0.5, -0.5)
    data = versions.grease_pencils().new("Strokes")
    holder = bpy.data.objects.new("Strokes", data)
    for made in (plane, holder):
        scene.collection.objects.link(made)
    picture.plane, picture.strokes, picture.picture_size = plane, holder, SIZE
    scene.view_layers[0].update()


def add_camera(scene, picture, kind: str = "ORTHO"):
    """A camera 10 m before the plane that sees just the picture."""
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale, camera.location = kind, 8, (0, 0, 10)
    scene.collection.objects.link(camera)
    scene.camera = picture.camera = camera
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.view_layers[0].update()
    return camera


def on_plane(*pixels) -> np.ndarray:
    """The places of pixels on the plane as lay_out() leaves it."""
    return np.array([[(x - SIZE[0] / 2) / 160, (SIZE[1] / 2 - y) / 160, 0] for x, y in pixels])


def draw(part, points, frame: int = 1, kind: str = "POLY", radius=0.05, **stored):
    """Adds a stroke to a grease-pencil layer, in the layer's own space; returns the drawing.

    `stored`: attributes of the curve or of its points by name.
    """
    key = next((key for key in part.frames if key.frame_number == frame), None) or part.frames.new(frame)
    drawing = key.drawing
    drawing.add_strokes([len(points)])
    curve = len(drawing.curve_offsets) - 2
    drawing.set_types(type=kind, indices=[curve])
    stored = {"position": points, "radius": np.broadcast_to(radius, len(points)), **stored}
    for name, values in stored.items():
        store(drawing, curve, name, np.asarray(values))
    drawing.tag_positions_changed()
    return drawing


KINDS = {
    "position": ("FLOAT_VECTOR", "POINT"), "radius": ("FLOAT", "POINT"), "nurbs_weight": ("FLOAT", "POINT"),
    "handle_left": ("FLOAT_VECTOR", "POINT"), "handle_right": ("FLOAT_VECTOR", "POINT"),
    "handle_type_left": ("INT8", "POINT"), "handle_type_right": ("INT8", "POINT"),
    "cyclic": ("BOOLEAN", "CURVE"), "resolution": ("INT", "CURVE"),
    "nurbs_order": ("INT8", "CURVE"), "knots_mode": ("INT8", "CURVE"), "material_index": ("INT", "CURVE"),
    ".selection": ("BOOLEAN", "CURVE"),
}


def store(drawing, curve: int, name: str, values: np.ndarray) -> None:
    """Writes one attribute of one curve, or of its points."""
    kind, domain = KINDS[name]
    attribute = drawing.attributes.get(name) or drawing.attributes.new(name, kind, domain)
    first = curve if domain == "CURVE" else drawing.curve_offsets[curve].value
    for item, value in zip(attribute.data[first : first + max(1, values.size)], np.atleast_1d(values), strict=False):
        if kind == "FLOAT_VECTOR":
            item.vector = value
        else:
            item.value = value.item()


def distance(a: np.ndarray, b: np.ndarray) -> float:
    """How far two polylines are apart where they are farthest (Hausdorff), of their corners and the middles between."""
    with_middles = [np.concatenate([line, (line[1:] + line[:-1]) / 2]) for line in (a, b)]
    return max(farthest(with_middles[0], b), farthest(with_middles[1], a))


def farthest(points: np.ndarray, line: np.ndarray) -> float:
    """How far the farthest of the points is from a polyline."""
    if len(line) == 1:
        return float(np.linalg.norm(points - line[0], axis=1).max())
    start, step = line[:-1], np.diff(line, axis=0)
    square = (step**2).sum(axis=1)
    along = ((points[:, None] - start) * step).sum(axis=2) / np.where(square > 0, square, 1)
    nearest = start + np.clip(along, 0, 1)[..., None] * step
    return float(np.linalg.norm(points[:, None] - nearest, axis=2).min(axis=1).max())
