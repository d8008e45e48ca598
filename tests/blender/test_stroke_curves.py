"""Curves between their control points, against Blender's own conversion."""

import importlib

import bpy
import numpy as np
import pytest
from drawings import distance, draw, farthest, lay_out
from pixels import PACKAGE

curves = importlib.import_module(f"{PACKAGE}.strokes.curves")
control_points = importlib.import_module(f"{PACKAGE}.strokes.control_points")
KNOTS = ("normal", "endpoint", "bezier", "endpoint bezier")


@pytest.fixture
def part(scene, picture):
    """A grease-pencil layer, and a modifier on its object that converts its curves to polylines."""
    lay_out(scene, picture)
    holder = picture.strokes
    tree = bpy.data.node_groups.new("Evaluate", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    nodes = [tree.nodes.new(f"{kind}") for kind in (
        "NodeGroupInput", "GeometryNodeGreasePencilToCurves", "GeometryNodeResampleCurve", "NodeGroupOutput"
    )]
    nodes[1].inputs["Layers as Instances"].default_value = False
    if "Mode" in nodes[2].inputs:  # 5.0 and later
        nodes[2].inputs["Mode"].default_value = "Evaluated"
    else:
        nodes[2].mode = "EVALUATED"
    for before, after in zip(nodes, nodes[1:], strict=False):
        tree.links.new(before.outputs[0], after.inputs[0])
    holder.modifiers.new("Evaluate", "NODES").node_group = tree
    return holder.data.layers.new("Layer")


def converted(holder) -> list[np.ndarray]:
    """The polylines that Blender makes, (n, 4): places and radius; a cyclic one closed."""
    holder.data.update_tag()
    geometry = holder.evaluated_get(bpy.context.evaluated_depsgraph_get()).evaluated_geometry()
    made = geometry.curves
    values = {"position": np.empty(len(made.points) * 3, np.float32), "radius": np.empty(len(made.points), np.float32)}
    made.attributes["position"].data.foreach_get("vector", values["position"])
    made.attributes["radius"].data.foreach_get("value", values["radius"])
    points = np.column_stack([values["position"].reshape(-1, 3), values["radius"]])
    cyclic = made.attributes.get("cyclic")
    lines, first = [], 0
    for i, curve in enumerate(made.curves):
        line = points[first : first + curve.points_length]
        lines.append(np.vstack([line, line[:1]]) if cyclic and cyclic.data[i].value else line)
        first += curve.points_length
    return lines


def ours(drawing) -> list[np.ndarray]:
    offsets, points = curves.evaluate(control_points.of(drawing))
    return [points[a:b] for a, b in zip(offsets[:-1], offsets[1:], strict=True)]


def random(seed: int, count: int) -> dict:
    """Control points and all that may belong to them."""
    noise = np.random.default_rng(seed)
    points = noise.uniform(-1, 1, (count, 3))
    return {
        "points": points, "radius": noise.uniform(0.1, 1, count), "nurbs_weight": noise.uniform(0.5, 2, count),
        "handle_left": points + noise.uniform(-0.5, 0.5, (count, 3)),
        "handle_right": points + noise.uniform(-0.5, 0.5, (count, 3)),
        "handle_type_left": np.zeros(count, int), "handle_type_right": np.zeros(count, int),
    }


@pytest.mark.parametrize("cyclic", [False, True], ids=["open", "cyclic"])
@pytest.mark.parametrize("kind", ["POLY", "CATMULL_ROM", "BEZIER"])
def test_a_curve_is_the_one_that_blender_shows(part, picture, kind, cyclic):
    """One to seven points, at a coarse and a fine resolution: the very same points, and their radius."""
    for seed, (count, resolution) in enumerate((n, r) for n in (1, 2, 3, 4, 7) for r in (1, 5, 12)):
        drawing = draw(part, kind=kind, cyclic=cyclic, resolution=resolution, **random(seed, count))
    for line, wanted in zip(ours(drawing), converted(picture.strokes), strict=True):
        assert len(wanted) == len(line) or len(wanted) <= 2
        assert distance(line, wanted) < 1e-5


@pytest.mark.parametrize("cyclic", [False, True], ids=["open", "cyclic"])
@pytest.mark.parametrize("knots", range(4), ids=KNOTS)
def test_a_nurbs_curve_is_the_one_that_blender_shows(part, picture, knots, cyclic):
    """Orders 3 to 5, with as many points as are too few, just enough, and more. 5.2 makes the very same points, 4.5
    others of the same curve, so that it cuts corners between Bezier pieces."""
    for seed, (count, order) in enumerate((n, order) for n in (1, 2, 3, 4, 5, 6, 9) for order in (3, 4, 5)):
        stored = random(seed, count)
        drawing = draw(part, kind="NURBS", cyclic=cyclic, resolution=50, nurbs_order=order, knots_mode=knots, **stored)
    for line, wanted in zip(ours(drawing), converted(picture.strokes), strict=True):
        if len(line) == len(wanted) or len(wanted) == 2:
            assert distance(line, wanted) < 1e-5
        else:
            assert bpy.app.version < (5, 0) and farthest(wanted, line) < 2e-3 and distance(line, wanted) < 3e-2


def test_a_nurbs_curve_of_order_2_joins_its_points(part):
    stored = random(1, 5)
    drawing = draw(part, kind="NURBS", nurbs_order=2, resolution=3, **stored)
    polygon = np.column_stack([stored["points"], stored["radius"]])
    assert distance(ours(drawing)[0], polygon) < 1e-6 and len(ours(drawing)[0]) == 4 * 3 + 1


def test_all_curves_of_a_drawing_are_evaluated_at_once(part, picture):
    """Types, resolutions and lengths mixed: each is what it is alone."""
    alone = []
    for seed, kind in enumerate(["NURBS", "POLY", "BEZIER", "CATMULL_ROM", "POLY", "BEZIER", "NURBS", "CATMULL_ROM"]):
        stored = random(seed, 3 + seed % 4)
        drawing = draw(part, kind=kind, cyclic=seed % 3 == 0, resolution=4 + seed % 2, **stored)
        single = draw(part, frame=100 + seed, kind=kind, cyclic=seed % 3 == 0, resolution=4 + seed % 2, **stored)
        alone.append(ours(single)[0])
    for line, wanted in zip(ours(drawing), alone, strict=True):
        np.testing.assert_array_equal(line, wanted)


def test_what_is_not_stored_is_what_blender_takes(part, picture):
    """No radius, no resolution, no order, no weights: a curve made by a script."""
    key = part.frames.new(1)
    for count, kind in ((4, "CATMULL_ROM"), (5, "NURBS")):
        key.drawing.add_strokes([count])
        key.drawing.set_types(type=kind, indices=[len(key.drawing.curve_offsets) - 2])
    places = np.random.default_rng(3).uniform(-1, 1, 27).astype(np.float32)
    key.drawing.attributes["position"].data.foreach_set("vector", places)
    assert {"radius", "resolution", "nurbs_order"}.isdisjoint(key.drawing.attributes.keys())
    made = ours(key.drawing)
    assert [len(line) for line in made] == [3 * 12 + 1, 2 * 12 + 1]
    key.drawing.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", np.full(9, 0.01, np.float32))
    key.drawing.tag_positions_changed()
    for line, wanted in zip(made, converted(picture.strokes), strict=True):
        assert distance(line, wanted) < 5e-3  # of 4.5's points of a NURBS curve, see above


def test_a_bezier_curve_without_handles_is_straight(part):
    stored = random(5, 4)
    drawing = draw(part, stored["points"], kind="BEZIER")
    assert distance(ours(drawing)[0][:, :3], stored["points"]) < 1e-6


def test_an_empty_drawing_has_no_curves(part):
    assert ours(part.frames.new(1).drawing) == []


def test_knots_of_their_own_are_refused(part):
    drawing = draw(part, kind="NURBS", knots_mode=4, **random(1, 5))
    with pytest.raises(ValueError, match="has knots of its own, which can't be read; set its curve type anew"):
        control_points.of(drawing)
    part.frames.remove(1)  # before Blender 4.5 looks at it: there are no such knots


@pytest.mark.parametrize("kind", ["CATMULL_ROM", "BEZIER"])
def test_fewer_points_keep_within_the_tolerance(part, kind):
    """Of a curve that is smooth and dense, and of one with corners."""
    t = np.linspace(0, 1, 60)
    smooth = np.stack([np.cos(9 * t), np.sin(7 * t), t], axis=1)
    handle = np.gradient(smooth, axis=0) / 3
    draw(part, smooth, kind=kind, resolution=20, handle_left=smooth - handle, handle_right=smooth + handle)
    drawing = draw(part, kind=kind, resolution=20, **random(2, 9))
    control = control_points.of(drawing)
    for tolerance in (1e-3, 1e-4):
        whole, fewer = (curves.evaluate(control, given) for given in (0, tolerance))
        assert len(fewer[1]) < 0.6 * len(whole[1]) and np.array_equal(whole[0] > 0, fewer[0] > 0)
        for i in (0, 1):
            lines = [points[offsets[i] : offsets[i + 1]] for offsets, points in (whole, fewer)]
            assert distance(*lines) < 1.01 * tolerance
            np.testing.assert_array_equal(lines[0][[0, -1]], lines[1][[0, -1]])
