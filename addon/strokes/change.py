"""Selected strokes go to another grease-pencil layer, and with it to another role."""

import bpy
import numpy as np

from . import brush, control_points, gp_layers
from .read import layer_to_world
from .roles import Role

SAME = 1e-6  # spaces that differ less are one


def move_selected(context, picture, part, role: Role) -> set[str]:
    """Moves the strokes that are selected in edit mode to the grease-pencil layer `part`, where they are on the screen.

    Blender's own operator moves them, but leaves them the numbers that they had in their old layer's space.
    """
    settings, holder = context.scene.tool_settings, picture.strokes
    several, settings.use_grease_pencil_multi_frame_editing = settings.use_grease_pencil_multi_frame_editing, False
    try:
        gp_layers.ensure_key(part, role, context.scene.frame_current)
        here = layer_to_world(holder, part).inverted_safe()
        for other in holder.data.layers:
            key = other.get_frame_at(context.scene.frame_current)
            if other != part and key is not None and not other.hide and not other.lock:
                _transform_selected(key.drawing, np.array(here @ layer_to_world(holder, other)))
        holder.active_material_index = gp_layers.material(holder.data, role)
        bpy.ops.grease_pencil.stroke_material_set()
        return bpy.ops.grease_pencil.move_to_layer(target_layer_name=part.name)
    finally:
        settings.use_grease_pencil_multi_frame_editing = several


def _transform_selected(drawing, matrix: np.ndarray) -> None:
    stored = drawing.attributes
    if np.abs(matrix - np.eye(4)).max() < SAME or ".selection" not in stored or not drawing.curve_offsets:
        return
    chosen = _selected_points(drawing)
    for name in ("position", "handle_left", "handle_right"):
        if name in stored:
            places = np.empty(len(chosen) * 3, np.float32)
            stored[name].data.foreach_get("vector", places)
            places = places.reshape(-1, 3)
            places[chosen] = places[chosen] @ matrix[:3, :3].T + matrix[:3, 3]
            stored[name].data.foreach_set("vector", places.ravel())
    drawing.tag_positions_changed()


def _selected_points(drawing) -> np.ndarray:
    """All points of the strokes of which any is selected."""
    return np.repeat(_selected(drawing), np.diff(control_points.offsets_of(drawing)))


def _selected(drawing) -> np.ndarray:
    """Whether any point of each stroke is selected."""
    kept = drawing.attributes.get(".selection")
    if kept is None:
        return np.ones(drawing.attributes.domain_size("CURVE"), bool)
    flags = np.array([item.value for item in kept.data], bool)
    return np.logical_or.reduceat(flags, control_points.offsets_of(drawing)[:-1]) if kept.domain == "POINT" else flags


def set_flow(context, picture, said: dict) -> int:
    """Gives the strokes that are selected in edit mode, of those that say how something flows, these numbers.

    Returns how many there were.
    """
    count = 0
    for part, role in gp_layers.all_of(picture):
        key = part.get_frame_at(context.scene.frame_current)
        if not role.brushed or key is None or part.hide or part.lock or not len(key.drawing.curve_offsets):
            continue
        chosen = np.flatnonzero(_selected(key.drawing))
        if chosen.size:
            brush.write(key.drawing, chosen, [said] * chosen.size)
            key.drawing.tag_positions_changed()
            count += chosen.size
    return count
