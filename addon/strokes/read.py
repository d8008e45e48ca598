"""The strokes of a picture as they lie in it: through grease-pencil layer, object, parents and camera.

A hidden object or grease-pencil layer does not count, nor do the object's modifiers. A role whose strokes hold from
their key on reads every key; any other reads the drawing that the scene's first frame shows.
"""

from collections.abc import Callable

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from ..properties import plane
from . import brush, control_points, gp_layers, projection
from .curves import evaluate
from .lines import Stroke
from .roles import Role

TOLERANCE = 0.01  # px that a polyline may leave its curve by where that saves points
RADIUS, SEED = "stillwater_radius", "stillwater_seed"  # attributes of a curve: a touch-up's own


def strokes(scene, picture, layer_id: str, role: Role, seen: Callable | None = None) -> list[Stroke]:
    """All strokes of one role, in the order in which they lie upon each other.

    `seen`: gives projection_of(picture), where that is known already. Throws ValueError with a sentence where the picture has no plane, or a stroke is out of its camera's sight.
    """
    found = []
    for part, keys in _shown(scene, picture, layer_id, role):
        if role.on_clip:
            projected = projection.onto_picture(np.array(gp_layers.pixels_to_world(picture, layer_id, role)))
        else:
            projected = seen() if seen is not None else projection_of(picture)
        try:
            for key in keys:
                found += _in_drawing(picture.strokes, part, key, projected, role.brushed)
        except ValueError as error:
            raise ValueError(rpt_("{name}: a stroke {error}").format(name=part.name, error=rpt_(str(error)))) from error
    return found


def is_drawn(scene, picture, layer_id: str, role: Role) -> bool:
    """Whether there is a stroke that says something; so cheap that panels may ask."""
    drawings = [key.drawing for _, keys in _shown(scene, picture, layer_id, role) for key in keys]
    return any(np.any(np.diff(control_points.offsets_of(drawing)) >= role.points) for drawing in drawings)


def count(scene, picture, layer_id: str, role: Role) -> int:
    """How many strokes of a role say something, of one that is not keyed; as cheap."""
    drawings = [key.drawing for _, keys in _shown(scene, picture, layer_id, role) for key in keys]
    return sum(int(np.sum(np.diff(control_points.offsets_of(drawing)) >= 1)) for drawing in drawings)


def _shown(scene, picture, layer_id: str, role: Role):
    """The grease-pencil layers of a role that are visible, each with the keys that count."""
    parts = gp_layers.of(picture, layer_id, role)
    view_layer = bpy.context.view_layer if bpy.context.scene == scene else scene.view_layers[0]
    if parts and picture.strokes.visible_get(view_layer=view_layer):
        for part in parts:
            keys = sorted(part.frames, key=lambda frame: frame.frame_number)
            if keys and _is_visible(part):
                yield part, keys if role.keyed else [part.get_frame_at(scene.frame_start) or keys[0]]


def _is_visible(part) -> bool:
    """A grease-pencil layer is hidden with any group around it."""
    while part is not None and not part.hide:
        part = part.parent_group
    return part is None


def projection_of(picture) -> projection.Projection:
    """From the scene onto the picture. Throws ValueError where there is no plane, or it is seen from its edge."""
    pixels = np.array(plane.pixels_to_world(picture))
    try:
        return projection.onto_picture(pixels, _eye(picture.camera))
    except projection.OutOfSight as error:
        sentence = rpt_("{name}: {error}; turn one of them")
        raise ValueError(sentence.format(name=picture.name, error=rpt_(str(error)))) from error


def _eye(camera) -> np.ndarray | None:
    if camera is None or camera.type != "CAMERA":
        return None
    parallel = camera.data.type == "ORTHO"
    return np.append(np.array(camera.matrix_world)[:3, 2 if parallel else 3], 0.0 if parallel else 1.0)


def _in_drawing(holder, part, key, seen: projection.Projection, brushed: bool) -> list[Stroke]:
    to_world = np.array(layer_to_world(holder, part))

    def place(points):
        return seen.place(points[:, :3] @ to_world[:3, :3].T + to_world[:3, 3])

    curves = control_points.of(key.drawing)
    finest = place(curves.points)[1].max(initial=0) * np.linalg.norm(to_world[:3, :3], 2)  # px for a unit of its space
    offsets, points = evaluate(curves, TOLERANCE / finest if finest else 0)
    pixels, scale = place(points)
    widths = np.maximum(2 * (points[:, 3] + part.radius_offset) * size_of(holder) * scale, 0)
    count = len(offsets) - 1
    flows = brush.of_curves(key.drawing, count) if brushed else [None] * count
    own = (*(_own(key.drawing, name, count) for name in (RADIUS, SEED)), flows)
    parts = [(slice(a, b), said) for a, b, *said in zip(offsets[:-1], offsets[1:], *own, strict=True) if b > a]
    return [Stroke(pixels[part], widths[part], key.frame_number, *said) for part, said in parts]


def size_of(holder) -> float:
    """By how much Blender scales the widths that it draws: by the object's scale, not by the layer's."""
    return float(np.linalg.norm(np.array(holder.matrix_world)[:3, :3].sum(axis=1)) / np.sqrt(3))


def _own(drawing, name: str, count: int) -> list:
    """A number that each curve has of its own, 0 where it has none."""
    kept = drawing.attributes.get(name)
    return [item.value for item in kept.data] if kept is not None and kept.domain == "CURVE" else [0] * count


def layer_to_world(holder, part):
    """4x4: from a grease-pencil layer's own space to the world. A bone is a parent by its posed head."""
    parent = part.parent
    if parent is None:
        return holder.matrix_world @ part.matrix_local
    bone = parent.pose.bones.get(part.parent_bone) if parent.type == "ARMATURE" and part.parent_bone else None
    space = parent.matrix_world @ bone.matrix if bone else parent.matrix_world
    return space @ part.matrix_parent_inverse @ part.matrix_local
