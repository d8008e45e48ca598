"""The control points of a drawing, read by the array. What Blender has not stored has the value it would show."""

import numpy as np

from .curves import ENDPOINT_BEZIER, NURBS, Curves

RADIUS = 0.01  # of a point without one, in the scene's units


def offsets_of(drawing) -> np.ndarray:
    """Where each curve's points begin, and where the last one's end."""
    curves = drawing.attributes.domain_size("CURVE")
    offsets = np.zeros(curves + 1, np.int32)
    if curves:
        drawing.curve_offsets.foreach_get("value", offsets)
    return offsets


def of(drawing) -> Curves:
    """All curves of a drawing, with the radius as a fourth coordinate. Throws ValueError for knots it can't read."""
    offsets = offsets_of(drawing)
    curves, points = len(offsets) - 1, int(offsets[-1])
    stored = drawing.attributes

    def numbers(name: str, kind, count: int, usual):
        values = np.full(count, usual, kind)
        if name in stored and count:
            stored[name].data.foreach_get("value", values)
        return values

    def places(name: str, usual):
        values = np.array(usual, np.float32)
        if name in stored and points:
            flat = np.empty(points * 3, np.float32)
            stored[name].data.foreach_get("vector", flat)
            values = flat.reshape(points, 3)
        return values

    positions = places("position", np.zeros((points, 3)))
    types, knots = numbers("curve_type", np.int8, curves, 0), numbers("knots_mode", np.int8, curves, 0)
    if np.any(knots[types == NURBS] > ENDPOINT_BEZIER):
        raise ValueError("has knots of its own, which can't be read; set its curve type anew")
    return Curves(
        offsets=offsets,
        points=np.column_stack([positions, numbers("radius", np.float32, points, RADIUS)]).astype(np.float64),
        types=types,
        cyclic=numbers("cyclic", np.bool_, curves, False),
        resolution=numbers("resolution", np.int32, curves, 12),
        left=places("handle_left", positions),
        right=places("handle_right", positions),
        order=numbers("nurbs_order", np.int8, curves, 4),
        knots=knots,
        weights=numbers("nurbs_weight", np.float32, points, 1).astype(np.float64),
    )
