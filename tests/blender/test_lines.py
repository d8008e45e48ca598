"""What strokes say: ends, a polyline, a straight line, widths."""

import importlib

import numpy as np
import pytest
from pixels import PACKAGE

lines = importlib.import_module(f"{PACKAGE}.strokes.lines")
roles = importlib.import_module(f"{PACKAGE}.strokes.roles")


def stroke(*points, widths=None, frame=1):
    return lines.Stroke(np.array(points, float), np.full(len(points), 8.0) if widths is None else widths, frame)


def test_ends_are_root_and_tip_of_the_last_line_drawn():
    former, last = stroke((0, 0), (9, 9)), stroke((10, 20), (14, 3), (12.3456, -8))
    assert lines.ends([former, last]) == [[10, 20], [12.346, -8]]
    assert lines.polyline([former, last]) == [[10, 20], [14, 3], [12.346, -8]]


@pytest.mark.parametrize("role", [role for role in roles.ROLES if role.one and not role.of], ids=lambda role: role.key)
def test_a_dab_is_not_a_line(role):
    dab = stroke((5, 5)), stroke((5, 5), (5, 5))
    assert role.geometry([]) is None and role.geometry([*dab]) is None
    line = stroke((0, 1), (10, 1))
    assert role.geometry([line, *dab]) == role.geometry([line]) == [[0, 1], [10, 1]]


def test_a_straight_line_is_the_nearest_one():
    """Against numpy's fit through many points at equal steps along the stroke; from left to right."""
    corners = np.array([(900, 410), (600, 395), (400, 404), (20, 380)], float)
    shares = np.linspace(0, 1, 20001)
    at = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1))])
    even = np.stack([np.interp(shares * at[-1], at, corners[:, i]) for i in (0, 1)], axis=1)
    offsets = even - even.mean(axis=0)
    direction = np.linalg.svd(offsets, full_matrices=False)[2][0]
    (x0, y0), (x1, y1) = lines.straight_line([stroke(*corners)])
    across = np.array([-direction[1], direction[0]])
    assert x0 < x1 and abs(across @ (x1 - x0, y1 - y0)) / (x1 - x0) < 1e-5
    assert abs(across @ (even.mean(axis=0) - (x0, y0))) < 2e-3
    assert (x0, x1) == pytest.approx((20, 900), abs=1)


def test_a_straight_line_does_not_feel_where_the_hand_was_slow():
    bend = [(0, 0), (100, 0), (200, 20)]
    slow = [(x, 0) for x in range(101)] + [(200, 20)]
    assert lines.straight_line([stroke(*slow)]) == lines.straight_line([stroke(*bend)])


def test_a_line_that_stands_upright_is_fitted_too():
    assert lines.straight_line([stroke((5, 90), (5, 10))]) in ([[5, 10], [5, 90]], [[5, 90], [5, 10]])


def test_pressure_is_width():
    even = lines.with_pressure(stroke((1, 2), (3, 4)))
    assert even == {"points": [[1, 2], [3, 4]], "width": 8}
    pressed = lines.with_pressure(stroke((1, 2), (3, 4), (5, 6), widths=np.array([4.0, 10.0, 0.0])))
    assert pressed == {"points": [[1, 2, 0.4], [3, 4, 1], [5, 6, 0]], "width": 10}


def test_each_role_is_told_apart():
    assert len({role.key for role in roles.ROLES}) == len({role.number for role in roles.ROLES}) == len(roles.ROLES)
    assert len({role.colour for role in roles.ROLES}) == len({role.name for role in roles.ROLES}) == len(roles.ROLES)
    assert all(0 < role.number < 128 for role in roles.ROLES)  # above it an id of 24 bits, in 31
    assert [role.key for role in roles.of_motion("sway")] == ["sway_line"]
    assert [role.key for role in roles.of_motion("")] == ["horizon"] and roles.of_motion("drift") == []


def test_scribbles_are_all_strokes_and_dabs_count():
    dab, line = stroke((5, 5)), stroke((0, 1), (10, 1), widths=np.array([2.0, 4.0]))
    assert lines.all_strokes([]) is None
    assert lines.all_strokes([dab, line]) == [
        {"points": [[5, 5]], "width": 8}, {"points": [[0, 1, 0.5], [10, 1, 1]], "width": 4},
    ]  # fmt: skip


@pytest.mark.parametrize("width, written", [(0.0, 0.001), (1e-9, 0.001), (1.0, 1), (1e6, 16384)])
def test_a_width_is_one_that_the_recipe_may_have(width, written):
    (said,) = lines.all_strokes([stroke((1, 2), (3, 4), widths=np.full(2, width))])
    assert said == {"points": [[1, 2], [3, 4]], "width": written}


def test_an_outline_is_the_last_line_that_encloses_something():
    ring, line, closed = stroke((0, 0), (9, 0), (9, 9)), stroke((0, 0), (5, 5), (9, 9)), stroke((1, 1), (4, 1), (4, 4), (1, 1))
    assert lines.polygon([]) is None and lines.polygon([line, stroke((3, 3)), stroke((0, 0), (9, 0))]) is None
    assert lines.polygon([closed, ring, line]) == [[0, 0], [9, 0], [9, 9]]
    assert lines.polygon([ring, closed]) == [[1, 1], [4, 1], [4, 4]]


def test_touch_ups_say_what_is_their_own():
    points, widths = np.array([(1, 2), (3, 4)], float), np.full(2, 8.0)
    plain = lines.Stroke(points, widths, 1)
    own, anywhere = lines.Stroke(points, widths, 1, 40.0, 8), lines.Stroke(points, widths, 1, lines.ANYWHERE, 1)
    drawn = {"stroke": {"points": [[1, 2], [3, 4]], "width": 8}}
    assert lines.touch_ups([]) is None
    said = [drawn, {**drawn, "radius": 40, "seed": 7}, {**drawn, "radius": None, "seed": 0}]
    assert lines.touch_ups([plain, own, anywhere]) == said
