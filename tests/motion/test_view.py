"""The water plane under the picture's camera: metric, for any tilt, and the same camera back again."""

import numpy as np
import pytest
from stillwater import _stillwater as engine
from stillwater.recipe import View as RecipeView

SIZE = (640, 360)
CENTRE = np.array(SIZE) / 2
HORIZONS = {
    "level": ((0, 120), (640, 120)),
    "tilted": ((0, 60), (640, 200)),
    "steep": ((300, 0), (420, 360)),
    "above the picture": ((0, -400), (640, -380)),
    "drawn from right to left": ((640, 120), (0, 100)),
}


def below(horizon, distance):
    """Points `distance` px below the middle of the horizon, and beside."""
    a, b = (np.array(end, float) for end in horizon)
    along = (b - a) / np.hypot(*(b - a))
    along *= np.sign(along[0])
    down = np.array([-along[1], along[0]])
    middle = a + along * np.dot(CENTRE - a, along)
    return [tuple(middle + down * distance + along * beside) for beside in (-250, 0, 170)]


def test_names_and_defaults_are_the_recipe_s():
    usual = engine.View()
    for name, default in zip(RecipeView.__struct_fields__, RecipeView.__struct_defaults__, strict=True):
        assert getattr(usual, name) == default, name


@pytest.mark.parametrize("horizon", HORIZONS.values(), ids=HORIZONS)
@pytest.mark.parametrize("distance", [0.5, 10, 150, 600])
def test_picture_to_plane_and_back(horizon, distance):
    plane = engine.WaterPlane(engine.View(horizon=horizon), SIZE)
    for point in below(horizon, distance):
        assert plane.seen(plane.ground(point)) == pytest.approx(point, abs=1e-6)


@pytest.mark.parametrize("horizon", HORIZONS.values(), ids=HORIZONS)
def test_the_plane_is_metric(horizon):
    """Three points of the ground, seen by a camera that is built here from scratch, are the points of the picture."""
    fov, height = 70.0, 3.0
    plane = engine.WaterPlane(engine.View(horizon=horizon, fov=fov, height=height), SIZE)
    focal = SIZE[0] / 2 / np.tan(np.radians(fov / 2))
    (x0, y0), (x1, y1) = horizon
    rays = [np.array([x - CENTRE[0], y - CENTRE[1], focal]) for x, y in ((x0, y0), (x1, y1))]
    up = np.cross(*rays)
    up *= -np.sign(up[1]) / np.linalg.norm(up)
    away = np.array([0, 0, 1.0]) - up[2] * up
    away /= np.linalg.norm(away)
    right = np.cross(away, up)
    for point in below(horizon, 150):
        ground = plane.ground(point)
        for rise in (0.0, 0.4):
            seen = ground[0] * right + ground[1] * away + (rise - height) * up
            expected = CENTRE + focal * seen[:2] / seen[2]
            assert plane.seen(ground, rise) == pytest.approx(expected, abs=1e-6)


def test_what_is_raised_to_the_eye_is_seen_on_the_horizon():
    plane = engine.WaterPlane(engine.View(horizon=HORIZONS["level"], height=1.7), SIZE)
    for ground in ((0, 5), (-3, 20)):
        assert plane.seen(ground, 1.7)[1] == pytest.approx(120)
        assert plane.seen(ground, 0.5)[1] < plane.seen(ground)[1]


def test_a_box_holds_water_where_part_of_it_lies_below_the_horizon():
    view = engine.View(horizon=HORIZONS["tilted"])
    assert view.any_water((0, 0, 640, 360))
    assert view.any_water((0, 60, 10, 10))
    assert not view.any_water((0, 0, 10, 60))
    assert not view.any_water((600, 0, 40, 190))
    assert not engine.View(horizon=((0, 400), (640, 400))).any_water((0, 0, 640, 360))
    assert engine.View(horizon=((0, -400), (640, -400))).any_water((0, 0, 640, 360))


def test_an_upright_horizon_has_its_water_at_the_right():
    for horizon in (((100, 0), (100, 300)), ((100, 300), (100, 0))):
        view = engine.View(horizon=horizon)
        assert view.any_water((101, 0, 10, 10)) and not view.any_water((0, 0, 100, 10))


@pytest.mark.parametrize(
    ("view", "sentence"),
    [
        ({}, "view.horizon: none is not a line, which water needs"),
        (
            {"horizon": ((3, 4), (3, 4))},
            "view.horizon: a line from a point to itself is not a line with two different ends",
        ),
        ({"horizon": ((0, 0), (float("nan"), 1))}, "view.horizon: nan is not a finite number"),
        ({"horizon": ((0, 0), (9, 1)), "fov": 4}, "view.fov: 4 is not between 5 and 150 (degrees)"),
        ({"horizon": ((0, 0), (9, 1)), "height": 0}, "view.height: 0 is not above 0 (m)"),
    ],
)
def test_what_is_no_view_is_refused(view, sentence):
    with pytest.raises(engine.BadInput) as refused:
        engine.WaterPlane(engine.View(**view), SIZE)
    assert str(refused.value) == sentence


def test_places_that_have_no_answer_are_refused():
    plane = engine.WaterPlane(engine.View(horizon=HORIZONS["level"]), SIZE)
    with pytest.raises(engine.BadInput, match="^point: a place on or above the horizon is not on the water$"):
        plane.ground((320, 120))
    with pytest.raises(engine.BadInput, match="^ground: a place behind the camera is not seen$"):
        plane.seen((0, -5))
