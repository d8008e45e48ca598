"""Drawn curves from their control points: what Blender shows between them, as polylines.

A drawing keeps control points only. Catmull-Rom, Bezier and NURBS curves are evaluated here as Blender's own nodes do
it, all curves of a drawing at once; what belongs to a point (its radius) is carried along the curve. numpy, no bpy.
"""

from dataclasses import dataclass

import numpy as np

CATMULL_ROM, POLY, BEZIER, NURBS = range(4)  # as Blender numbers them
NORMAL, ENDPOINT, BEZIER_KNOTS, ENDPOINT_BEZIER = range(4)  # what a NURBS curve's knots are like


@dataclass(frozen=True)
class Curves:
    """Control points of `n` curves, one after the other, `p` in all."""

    offsets: np.ndarray  # (n + 1,): curve i has the points offsets[i] .. offsets[i + 1] - 1
    points: np.ndarray  # (p, c): x, y, z and whatever else is carried along the curve
    types: np.ndarray  # (n,)
    cyclic: np.ndarray  # (n,) bool
    resolution: np.ndarray  # (n,): points made of each segment
    left: np.ndarray  # (p, 3): Bezier handles
    right: np.ndarray  # (p, 3)
    order: np.ndarray  # (n,): of NURBS curves
    knots: np.ndarray  # (n,): NORMAL, ...
    weights: np.ndarray  # (p,): of NURBS curves


def evaluate(curves: Curves) -> tuple[np.ndarray, np.ndarray]:
    """The polylines' offsets (n + 1,) and points (q, c). A cyclic curve ends at its first point again."""
    sizes = np.diff(curves.offsets)
    steps = np.where(curves.types == POLY, 1, np.maximum(curves.resolution, 1))
    segments = np.maximum(np.where(curves.cyclic & (sizes > 1), sizes, sizes - 1), 0)
    bent = {i: _nurbs(curves, i) for i in np.flatnonzero(curves.types == NURBS)}
    counts = np.where(sizes > 0, segments * steps + 1, 0)
    for i, points in bent.items():
        counts[i] = len(points)
    offsets = np.concatenate([[0], np.cumsum(counts)])
    made = np.empty((offsets[-1], curves.points.shape[1]))
    for kind, segment in ((POLY, _straight), (CATMULL_ROM, _catmull_rom), (BEZIER, _bezier)):
        for step in np.unique(steps[curves.types == kind]):
            chosen = np.flatnonzero((curves.types == kind) & (steps == step) & (sizes > 0))
            _fill(made, offsets, curves, chosen, segments, segment, int(step))
    for i, points in bent.items():
        made[offsets[i] : offsets[i + 1]] = points
    return offsets, made


def _fill(made, offsets, curves: Curves, chosen, segments, segment, step: int) -> None:
    """Writes the points of all `chosen` curves, which have one type and one number of steps a segment."""
    counts = segments[chosen]
    curve = np.repeat(chosen, counts)
    local = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    first, size = curves.offsets[curve], np.diff(curves.offsets)[curve]

    def neighbour(distance: int):
        index = local + distance
        return first + np.where(curves.cyclic[curve], index % size, np.clip(index, 0, size - 1))

    place = (offsets[curve] + local * step)[:, None] + np.arange(step)
    made[place] = segment(curves, neighbour, np.arange(step) / step)
    last = np.where(curves.cyclic[chosen], curves.offsets[chosen], curves.offsets[chosen + 1] - 1)
    made[offsets[chosen + 1] - 1] = curves.points[last]


def _straight(curves: Curves, neighbour, t):
    return curves.points[neighbour(0)][:, None]


def _catmull_rom(curves: Curves, neighbour, t):
    """A cubic through the middle two of four points, its tangents half their neighbours' distance."""
    s = 1 - t
    basis = np.stack([-t * s**2, 2 + t**2 * (3 * t - 5), 2 + s**2 * (3 * s - 5), -s * t**2], axis=1) / 2
    return basis @ np.stack([curves.points[neighbour(i)] for i in (-1, 0, 1, 2)], axis=1)


def _bezier(curves: Curves, neighbour, t):
    """A cubic by two points and the handles between them; what is carried along changes evenly."""
    s, start, end = 1 - t, neighbour(0), neighbour(1)
    places = (curves.points[start, :3], curves.right[start], curves.left[end], curves.points[end, :3])
    basis = np.stack([s**3, 3 * s**2 * t, 3 * s * t**2, t**3], axis=1)
    carried = np.stack([curves.points[start, 3:], curves.points[end, 3:]], axis=1)
    return np.concatenate([basis @ np.stack(places, axis=1), np.stack([s, t], axis=1) @ carried], axis=2)


def _nurbs(curves: Curves, i: int) -> np.ndarray:
    """One rational B-spline, `resolution` points for each span of its knots that is not empty (de Boor)."""
    points = curves.points[curves.offsets[i] : curves.offsets[i + 1]]
    weights = curves.weights[curves.offsets[i] : curves.offsets[i + 1]]
    order, cyclic, mode = int(curves.order[i]), bool(curves.cyclic[i]), int(curves.knots[i])
    if not _is_spline(len(points), order, cyclic, mode):
        return points
    knots = knot_vector(len(points), order, cyclic, mode)
    degree = order - 1
    if cyclic:
        points, weights = np.concatenate([points, points[:degree]]), np.concatenate([weights, weights[:degree]])
    spans = degree + np.flatnonzero(np.diff(knots[degree : len(points) + 1]) > 0)
    steps = max(int(curves.resolution[i]), 1)
    span = np.append(np.repeat(spans, steps), spans[-1])
    t = np.append(np.tile(np.arange(steps) / steps, len(spans)), 1.0)
    u = knots[span] + t * (knots[span + 1] - knots[span])
    return _de_boor(np.column_stack([points * weights[:, None], weights]), knots, degree, span, u)


def _de_boor(weighted, knots, degree: int, span, u) -> np.ndarray:
    """The points at the parameters `u`, each within its `span`, of a curve with homogeneous control points."""
    d = [weighted[span - degree + j] for j in range(degree + 1)]
    for level in range(1, degree + 1):
        for j in range(degree, level - 1, -1):
            low, high = knots[span - degree + j], knots[span + 1 + j - level]
            share = ((u - low) / (high - low))[:, None]
            d[j] = (1 - share) * d[j - 1] + share * d[j]
    return d[degree][:, :-1] / d[degree][:, -1:]


def _is_spline(count: int, order: int, cyclic: bool, mode: int) -> bool:
    """Whether there are points enough; where not, Blender joins them by straight lines, left open."""
    if count < order or (mode == BEZIER_KNOTS and count <= order):
        return False
    return not (cyclic and mode in (BEZIER_KNOTS, ENDPOINT_BEZIER)) or count % (order - 1) == 0


def knot_vector(count: int, order: int, cyclic: bool, mode: int) -> np.ndarray:
    """The knots of a curve with `count` points: evenly spaced, each as often as `mode` says."""
    bezier, endpoint = mode in (BEZIER_KNOTS, ENDPOINT_BEZIER), mode in (ENDPOINT, ENDPOINT_BEZIER)
    inner = order - 1 if bezier else 1
    head = order - cyclic if endpoint else min(2, inner)
    tail = 2 * order - 1 if cyclic else order * endpoint
    knots = np.empty(count + order + (order - 1) * cyclic)
    first = int(endpoint and cyclic)
    knots[:first] = 0
    body = np.arange(len(knots) - first - tail)
    knots[first : len(knots) - tail] = first + np.where(body < head, 0, 1 + (body - head) // inner)
    end = len(knots) - tail
    following = first + (0 if len(body) < head else 1 + (len(body) - head) // inner)
    for i in range(tail):  # a short curve's tail repeats itself
        knots[end + i] = following + knots[i] - knots[0]
    return knots
