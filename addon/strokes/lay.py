"""Strokes as a recipe has them, laid on the picture as grease pencil: read.py the other way round."""

import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from . import brush, gp_layers, read, roles
from .lines import ANYWHERE

POLY = "POLY"


def down(scene, picture, layer_id: str, said: dict[str, list]) -> None:
    """Draws, for each role's key, what the recipe has for it: strokes, touch-ups, or the corners of an outline.

    Throws ValueError, OSError where the picture has no object for strokes, or a clip can't be shown.
    """
    if any(said.values()) and gp_layers.data_of(picture) is None:
        sentence = rpt_("{name}: has no drawing for strokes; make it anew with Set Up in Scene")
        raise ValueError(sentence.format(name=picture.name))
    for key, strokes in said.items():
        if strokes:
            role = roles.by_key(key)
            outline = [{"points": strokes}] if isinstance(strokes[0], list) else strokes
            _draw_at_keys(scene, picture, layer_id, role, outline)
    drawing = scene.stillwater.drawing
    gp_layers.fade(picture, drawing.layer_id if drawing.role else "")


def _draw_at_keys(scene, picture, layer_id: str, role: roles.Role, strokes: list[dict]) -> None:
    """Strokes with a frame lie on a key there, all others on the key that holds at the scene's first frame."""
    part = gp_layers.ensure(picture, layer_id, role)
    for frame in sorted({stroke.get("frame") for stroke in strokes}, key=lambda frame: (frame is not None, frame)):
        if frame is None:
            gp_layers.ensure_key(part, role, scene.frame_start)
            key = part.get_frame_at(scene.frame_start) or part.frames[0]
        else:
            key = next((key for key in part.frames if key.frame_number == frame), None) or part.frames.new(frame)
        to_world = np.array(gp_layers.pixels_to_world(picture, layer_id, role))
        said = [stroke for stroke in strokes if stroke.get("frame") == frame]
        _draw(picture, part, key.drawing, role, said, to_world)


def _draw(picture, part, drawing, role: roles.Role, strokes: list[dict], to_world: np.ndarray) -> None:
    lines = [stroke.get("stroke", stroke) for stroke in strokes]
    counts = [len(line["points"]) for line in lines]
    before, points_before = len(drawing.strokes), drawing.attributes.domain_size("POINT")
    drawing.add_strokes(counts)
    drawing.set_types(type=POLY, indices=list(range(before, before + len(counts))))
    pixels = np.array([point[:2] for line in lines for point in line["points"]], np.float64)
    pressures = [point[2] if len(point) > 2 else 1.0 for line in lines for point in line["points"]]
    widths = np.repeat([line.get("width", 4.0) for line in lines], counts) * pressures
    places, unit = _on_plane(picture, part, pixels, to_world)
    _store(drawing, "position", "FLOAT_VECTOR", "POINT", points_before, places)
    _store(drawing, "radius", "FLOAT", "POINT", points_before, widths / 2 * unit - part.radius_offset)
    slot = gp_layers.material(picture.strokes.data, role)
    _store(drawing, "material_index", "INT", "CURVE", before, [slot] * len(counts))
    _store(drawing, "cyclic", "BOOLEAN", "CURVE", before, [role.of.endswith(".lasso")] * len(counts))
    if role.brushed:
        brush.write(drawing, range(before, before + len(counts)), strokes)
    radii = [(stroke["radius"] or ANYWHERE) if "radius" in stroke else 0.0 for stroke in strokes]
    seeds = [stroke["seed"] + 1 if "seed" in stroke else 0 for stroke in strokes]
    for name, kind, own in ((read.RADIUS, "FLOAT", radii), (read.SEED, "INT", seeds)):
        if any(own):
            _store(drawing, name, kind, "CURVE", before, own)
    drawing.tag_positions_changed()


def _on_plane(picture, part, pixels: np.ndarray, to_world: np.ndarray) -> tuple[np.ndarray, float]:
    """Pixels (n, 2) in a grease-pencil layer's own space (n, 3), and how long a pixel is for a radius."""
    from_world = np.array(read.layer_to_world(picture.strokes, part).inverted_safe())
    matrix = from_world @ to_world
    pixel = np.sqrt(np.linalg.norm(to_world[:3, 0]) * np.linalg.norm(to_world[:3, 1]))
    places = pixels @ matrix[:3, :2].T + matrix[:3, 3]
    return places, pixel / read.size_of(picture.strokes)


def _store(drawing, name: str, kind: str, domain: str, first: int, values) -> None:
    """Writes an attribute from the `first` point or curve on."""
    kept = drawing.attributes.get(name) or drawing.attributes.new(name, kind, domain)
    for item, value in zip(kept.data[first:], values, strict=True):
        if kind == "FLOAT_VECTOR":
            item.vector = value
        else:
            item.value = value
