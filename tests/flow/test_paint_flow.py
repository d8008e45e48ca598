"""Strokes become a field: what they say, where they cross, contradict, end outside, say nothing."""

import numpy as np
import pytest
import stillwater
from scipy.interpolate import RBFInterpolator
from stillwater import _stillwater as engine
from stillwater.flow_painting import _flow_strokes
from stillwater.recipe.strokes import FlowStroke as RecipeStroke

SIZE = (240, 160)


def stroke(*points, **fields):
    return {"points": [list(point) for point in points], **fields}


def right(y=80, **fields):
    return stroke((40, y), (200, y), **fields)


def left(y=80, **fields):
    return stroke((200, y), (40, y), **fields)


def down(x=120, **fields):
    return stroke((x, 20), (x, 140), **fields)


def painted(*strokes, size=SIZE, **more):
    return stillwater.paint_flow(strokes, size, **more)


def angle(flow, x, y):
    """Degrees, clockwise from the right as y runs down."""
    return np.degrees(np.arctan2(flow.orientation[y, x, 1], flow.orientation[y, x, 0]))


def arc(centre, radius, start, end, **fields):
    turns = np.radians(np.linspace(start, end, 40))
    return stroke(*(np.stack([np.cos(turns), np.sin(turns)], 1) * radius + centre).tolist(), **fields)


def test_names_and_defaults_are_the_recipe_s():
    ours, theirs = engine.FlowStroke(points=[[0, 0, 1]]), RecipeStroke(points=[[0, 0]])
    for name in ("width", "speed", "local", "alpha"):
        assert getattr(ours, name) == getattr(theirs, name)
    assert ours.kind.name == theirs.kind


def test_parallel_strokes_give_a_constant_field():
    flow = painted(stroke((20, 30), (200, 75), speed=3), stroke((30, 90), (210, 135), speed=3))
    along = np.array([4, 1]) / np.sqrt(17)
    assert np.abs(flow.orientation - along).max() < 1e-5
    assert np.abs(flow.speed - 3).max() < 1e-5


def test_orientation_is_unit_everywhere_and_speed_not_negative():
    flow = painted(right(30, speed=0), down(200, speed=9), left(140, speed=4), arc((90, 80), 25, 0, 300, speed=1))
    assert np.abs(np.linalg.norm(flow.orientation, axis=2) - 1).max() < 1e-5
    assert flow.speed.min() >= 0 and 8.5 < flow.speed.max() <= 9


def test_it_is_scipy_s_interpolation_of_the_strokes_pixels():
    strokes = [arc((80, 80), 60, 180, 260, speed=1), arc((200, 120), 60, 200, 290, speed=4), down(30, speed=2)]
    given, flow = _flow_strokes(strokes), painted(*strokes)
    places, values = map(np.array, engine.stroke_pixels(given, SIZE, True))
    at = np.array([(x, y) for x in range(3, 240, 11) for y in range(2, 160, 9)])
    exact = RBFInterpolator(places, values, kernel="linear")(at + 0.5)
    exact /= np.linalg.norm(exact, axis=1, keepdims=True)
    turned = np.degrees(np.arccos(np.clip((flow.orientation[at[:, 1], at[:, 0]] * exact).sum(axis=1), -1, 1)))
    assert turned.max() < 4 and turned.mean() < 1
    places, values = map(np.array, engine.stroke_pixels(given, SIZE, False))
    exact = RBFInterpolator(places, values[:, 0], kernel="linear")(at + 0.5).clip(1, 4)
    apart = np.abs(flow.speed[at[:, 1], at[:, 0]] - exact)
    assert apart.max() < 0.05 * 4 and apart.mean() < 0.01 * 4


def test_a_stroke_s_pixels_lie_under_it_and_carry_its_tangent():
    places, values = map(np.array, engine.stroke_pixels(_flow_strokes([arc((120, 80), 50, 0, 270, width=12)]), SIZE, True))
    out = places - (120, 80)
    radius = np.linalg.norm(out, axis=1)
    assert np.abs(radius - 50).max() <= 6.8 and radius.max() > 54 and radius.min() < 46
    tangents = np.stack([-out[:, 1], out[:, 0]], axis=1) / radius[:, None]
    assert ((values * tangents).sum(axis=1)[10:-10] > np.cos(np.radians(6))).all()
    assert len(np.unique(places, axis=0)) == len(places)


def test_a_trembling_pen_turns_nothing():
    rng = np.random.default_rng(1)
    flow = painted(stroke(*[(x, 80 + rng.normal(0, 0.4)) for x in range(20, 220, 2)], width=16))
    assert max(abs(angle(flow, x, 80)) for x in range(25, 215)) < 6


def test_pressure_scales_the_width():
    def rows(pressure):
        places, _ = engine.stroke_pixels(_flow_strokes([stroke((40, 80, pressure), (200, 80, pressure), width=20)]), SIZE, True)
        return np.ptp(np.array(places)[:, 1])

    assert rows(1) == pytest.approx(19, abs=1) and rows(0.5) == pytest.approx(9, abs=1) and rows(0) == 0


def test_beyond_the_strokes_no_speed_runs_on():
    flow = painted(right(100, speed=2), right(120, speed=4), right(140, speed=6))
    assert flow.speed.min() == 2 and flow.speed.max() == 6 and np.abs(flow.speed[5] - 2).max() < 0.3


def test_kinds_say_only_what_they_say():
    flow = painted(down(60, kind="orientation", speed=50), right(140, kind="speed", speed=7), left(20, kind="speed", speed=1))
    assert abs(angle(flow, 200, 80) - 90) < 0.01 and abs(angle(flow, 10, 140) - 90) < 0.01
    assert flow.speed[140, 100] == pytest.approx(7, abs=0.15) and flow.speed[20, 100] == pytest.approx(1, abs=0.15)


def test_orientation_alone_flows_at_the_usual_speed():
    assert (painted(right(kind="orientation", speed=50)).speed == RecipeStroke(points=[[0, 0]]).speed).all()


def test_crossing_strokes_the_later_lies_on_top():
    over, under = painted(right(), down()), painted(down(), right())
    assert abs(angle(over, 120, 80) - 90) < 3 and abs(angle(under, 120, 80)) < 3
    for flow in (over, under):
        assert abs(angle(flow, 60, 80)) < 4 and abs(angle(flow, 120, 130) - 90) < 4


def test_an_opposite_stroke_on_the_same_place_replaces_what_was_there():
    flow = painted(right(), left())
    assert abs(abs(angle(flow, 120, 80)) - 180) < 3 and abs(abs(angle(flow, 120, 20)) - 180) < 20


def test_opposite_strokes_side_by_side_both_hold():
    flow = painted(right(60, width=8), left(100, width=8))
    assert abs(angle(flow, 120, 60)) < 3 and abs(abs(angle(flow, 120, 100)) - 180) < 3
    assert np.isfinite(flow.orientation).all()


def test_strokes_that_cancel_each_other_leave_the_others_to_speak():
    flow = painted(down(30), right(alpha=1), left(alpha=0.5))
    assert np.isfinite(flow.orientation).all() and abs(angle(flow, 30, 80) - 90) < 3


def test_alpha_takes_the_field_part_of_the_way():
    def turned(alpha):
        return angle(painted(right(30), right(130), stroke((120, 60), (120, 100), alpha=alpha)), 120, 80)

    turns = [turned(alpha) for alpha in (0, 0.25, 0.5, 0.75, 1)]
    assert turns[0] == pytest.approx(0, abs=0.01) and turns[4] == pytest.approx(90, abs=3)
    assert turns[2] == pytest.approx(45, abs=4) and turns == sorted(turns)


def test_alpha_of_speeds_is_a_share():
    flow = painted(right(30, speed=2), right(130, speed=2), right(80, speed=6, alpha=0.25))
    assert flow.speed[80, 120] == pytest.approx(3, abs=0.15)


def test_alpha_counts_against_the_largest():
    assert np.array_equal(painted(right(alpha=0.3), down(30, alpha=0.3)).orientation, painted(right(), down(30)).orientation)


def test_a_local_stroke_changes_its_neighbourhood_only():
    without = painted(right(20), right(140))
    flow = painted(right(20), right(140), down(width=20, local=True, speed=9))
    assert abs(angle(flow, 120, 80) - 90) < 0.1 and flow.speed[80, 120] == pytest.approx(9)
    assert 5 < angle(flow, 134, 80) < 85
    far = np.abs(np.arange(240) + 0.5 - 120) > 20
    assert np.array_equal(flow.orientation[:, far], without.orientation[:, far])
    assert np.array_equal(flow.speed[:, far], without.speed[:, far])


def test_alpha_of_a_local_stroke_is_its_matte_s():
    flow = painted(right(20, speed=2), right(140, speed=2), right(width=20, local=True, speed=6, alpha=0.25))
    assert flow.speed[80, 120] == pytest.approx(3, abs=0.01)


def test_local_speed_leaves_directions_alone():
    without, flow = painted(right(20), down(200)), painted(right(20), down(200), left(local=True, kind="speed", speed=8))
    assert np.array_equal(flow.orientation, without.orientation) and flow.speed[80, 120] == pytest.approx(8)


def test_where_all_strokes_are_local_nothing_else_moves():
    flow = painted(right(width=12, local=True, speed=3))
    assert flow.speed[80, 120] == pytest.approx(3) and flow.speed[20].max() == 0
    assert np.abs(flow.orientation - (1, 0)).max() < 1e-5


def test_what_lies_outside_is_left_out():
    flow = painted(stroke((-500, 40), (800, 40), speed=5), stroke((120, 400), (120, 900), speed=80))
    assert np.abs(flow.orientation - (1, 0)).max() < 1e-5 and np.abs(flow.speed - 5).max() < 0.01


def test_a_local_stroke_outside_changes_nothing():
    flow = painted(right(), stroke((400, 40), (500, 40), local=True, speed=9))
    assert np.array_equal(flow.speed, painted(right()).speed)


def test_a_dot_says_a_speed():
    flow = painted(right(20, speed=1), stroke((120, 120), kind="speed", speed=6, width=20))
    assert flow.speed[120, 120] == pytest.approx(6, abs=0.1)


def test_a_stroke_that_goes_back_over_itself_is_finite():
    flow = painted(stroke((40, 80), (200, 80), (40, 80)))
    assert np.isfinite(flow.orientation).all() and np.abs(np.linalg.norm(flow.orientation, axis=2) - 1).max() < 1e-5


def test_points_on_one_place_are_one():
    assert np.array_equal(painted(stroke((40, 80), (40, 80), (200, 80), (200, 80))).orientation, painted(right()).orientation)


@pytest.mark.parametrize("size", [(1, 1), (7, 1), (1, 9), (8, 8), (9, 17)])
def test_small_pictures(size):
    flow = painted(stroke((0, 0.5), (size[0] + 1, 0.5), width=2), size=size)
    assert flow.orientation.shape == (size[1], size[0], 2) and np.abs(flow.orientation - (1, 0)).max() < 1e-4


def test_the_same_bytes_from_any_number_of_threads():
    strokes = [right(30, speed=1), down(200, speed=9), left(140), arc((90, 80), 25, 0, 300, local=True)]
    flows = []
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        flow = painted(*strokes)
        flows.append(flow.orientation.tobytes() + flow.speed.tobytes())
    engine.set_threads(0)
    assert len(set(flows)) == 1


@pytest.mark.parametrize(
    "strokes, sentence",
    [
        ([], "strokes: none is not one stroke or more"),
        ([right(kind="speed")], "strokes: none that touches the picture is of kind orientation or both, with an alpha above 0"),
        ([right(alpha=0)], "strokes: none that touches the picture is of kind orientation or both, with an alpha above 0"),
        ([stroke((300, 10), (400, 10))], "strokes: none that touches the picture is of kind orientation or both, with an alpha above 0"),
        ([right(kind="orientation"), right(-50, kind="speed")], "strokes: none of those that say a speed touches the picture"),
        ([right(), stroke((50, 50))], "strokes[1].points: a line shorter than 1 px is not a direction"),
        ([stroke((50, 50), (50.3, 50.2), kind="orientation")], "strokes[0].points: a line shorter than 1 px is not a direction"),
        ([stroke()], "strokes[0].points: none is not one point or more"),
        ([right(width=0)], "strokes[0].width: 0 is not above 0 (px)"),
        ([right(width=20000)], "strokes[0].width: 20000 is not between 0 and 16384 (px)"),
        ([right(speed=-1)], "strokes[0].speed: -1 is not between 0 and 1000 (px/frame)"),
        ([right(alpha=1.5)], "strokes[0].alpha: 1.5 is not between 0 and 1"),
        ([stroke((0, 0), (float("nan"), 5))], "strokes[0].points[1]: nan is not between -1e+06 and 1e+06 (px)"),
        ([stroke((0, 0), (9, 1e7))], "strokes[0].points[1]: 1e+07 is not between -1e+06 and 1e+06 (px)"),
        ([stroke((0, 0), (9, 5, 2))], "strokes[0].points[1], pressure: 2 is not between 0 and 1"),
        ([stroke((0, 0), (9,))], "strokes[0].points[1]: 1 numbers are not x, y or x, y, pressure"),
        ([{"width": 5}], "strokes[0]: a stroke without points is not a line"),
        ([right(frame=3)], "strokes[0]: frame is not one of points, width, kind, speed, local, alpha"),
        ([right(kind="fast")], "strokes[0].kind: 'fast' is not one of orientation, speed, both"),
    ],
)
def test_bad_strokes(strokes, sentence):
    with pytest.raises(stillwater.BadInput) as caught:
        stillwater.paint_flow(strokes, SIZE)
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    "more, sentence",
    [
        ({"size": (0, 5)}, "picture: 0 x 5 is not between 1 and 16384 pixels a side"),
        ({"bound": np.ones((3, 4))}, "bound: 4 x 3 is not the size of picture, 240 x 160"),
        ({"freeze": np.ones((3, 4))}, "freeze: 4 x 3 is not the size of picture, 240 x 160"),
        ({"bound": np.zeros((160, 240))}, "bound: a matte that is nowhere 0.1 or more is not a layer"),
        ({"bound": np.full((160, 240), 2)}, "bound[0, 0]: 2 is not between 0 and 1"),
        ({"freeze": np.full((160, 240), -1)}, "freeze[0, 0]: -1 is not between 0 and 1"),
    ],
)
def test_bad_pictures(more, sentence):
    with pytest.raises(stillwater.BadInput) as caught:
        painted(right(), **more)
    assert str(caught.value) == sentence
