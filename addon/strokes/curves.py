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


def evaluate(curves: Curves, tolerance: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """The polylines' offsets (n + 1,) and points (q, c). A cyclic curve ends at its first point again.

    Each segment gets the points that Blender shows, or as few as keep within `tolerance` of the curve; NURBS curves get
    all of them.
    """
    sizes = np.diff(curves.offsets)
    splines = {i: _nurbs(curves, i) for i in np.flatnonzero(curves.types == NURBS)}
    segments = np.maximum(np.where(curves.cyclic & (sizes > 1), sizes, sizes - 1), 0)
    segments[list(splines)] = 0
    curve = np.repeat(np.arange(len(sizes)), segments)
    local = np.arange(len(curve)) - np.repeat(np.cumsum(segments) - segments, segments)
    bent = np.flatnonzero(curves.types[curve] != POLY)
    cubics = _cubics(curves, curve[bent], local[bent])
    steps = np.ones(len(curve), int)
    steps[bent] = _steps(np.maximum(curves.resolution, 1)[curve[bent]], cubics, tolerance)

    before = np.concatenate([[0], np.cumsum(steps)])  # each segment; the last point of each curve comes besides
    first = before[np.cumsum(segments) - segments]
    counts = before[np.cumsum(segments)] - first + (sizes > 0)
    counts[list(splines)] = [len(points) for points in splines.values()]
    offsets = np.concatenate([[0], np.cumsum(counts)])
    made = np.empty((offsets[-1], curves.points.shape[1]))
    place = before[:-1] - first[curve] + offsets[curve]
    made[place] = curves.points[curves.offsets[curve] + local]
    for step in np.unique(steps[bent][steps[bent] > 1]):
        group = np.flatnonzero(steps[bent] == step)
        points = _bernstein(np.arange(1, step) / step) @ cubics[:, group].reshape(4, -1)
        made[place[bent[group]] + np.arange(1, step)[:, None]] = points.reshape(step - 1, len(group), -1)
    there = np.flatnonzero(sizes > 0)
    last = np.where(curves.cyclic, curves.offsets[:-1], curves.offsets[1:] - 1)
    made[offsets[there + 1] - 1] = curves.points[last[there]]
    for i, points in splines.items():
        made[offsets[i] : offsets[i + 1]] = points
    return offsets, made


def _cubics(curves: Curves, curve, local) -> np.ndarray:
    """Segments (the `local`-th of its `curve`) as Bezier cubics, (4, m, c): their ends and two points between."""
    first, size = curves.offsets[curve], np.diff(curves.offsets)[curve]

    def neighbour(distance: int) -> np.ndarray:
        index = local + distance
        return first + np.where(curves.cyclic[curve], index % size, np.clip(index, 0, size - 1))

    before, start, end, after = (neighbour(distance) for distance in (-1, 0, 1, 2))
    places = curves.points
    made = np.stack([places[start], places[start], places[end], places[end]])
    handled = curves.types[curve] == BEZIER
    smooth = ~handled
    made[1, smooth] += (places[end] - places[before])[smooth] / 6  # tangents: half the distance of the neighbours
    made[2, smooth] -= (places[after] - places[start])[smooth] / 6
    third = (made[3] - made[0])[handled] / 3  # what is carried along changes evenly
    made[1, handled] += third
    made[2, handled] -= third
    made[1, handled, :3], made[2, handled, :3] = curves.right[start[handled]], curves.left[end[handled]]
    return made


def _steps(usual, cubics, tolerance: float) -> np.ndarray:
    """How many points each segment gets. A chord over 1/k of a curve leaves it by at most max |f''| / (8 k^2)."""
    if tolerance <= 0:
        return usual
    bends = 6 * (cubics[:2] - 2 * cubics[1:3] + cubics[2:])  # f'' at both ends, straight between them
    bend = np.sqrt((bends**2).sum(axis=2).max(axis=0))
    return np.clip(np.ceil(np.sqrt(bend / (8 * tolerance))), 1, usual).astype(int)


def _bernstein(t: np.ndarray) -> np.ndarray:
    s = 1 - t
    return np.stack([s**3, 3 * s**2 * t, 3 * s * t**2, t**3], axis=1)


def _nurbs(curves: Curves, i: int) -> np.ndarray:
    """One rational B-spline, `resolution` points for each span of its knots that is not empty (de Boor)."""
    points = curves.points[curves.offsets[i] : curves.offsets[i + 1]]
    weights = curves.weights[curves.offsets[i] : curves.offsets[i + 1]]
    order, cyclic, mode = int(curves.order[i]), bool(curves.cyclic[i]), int(curves.knots[i])
    if not _is_spline(len(points), order, cyclic, mode):
        return np.concatenate([points, points[:1]]) if cyclic and len(points) > 1 else points
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
    """Whether there are points enough; where not, Blender joins them by straight lines."""
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
