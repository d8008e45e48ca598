"""Boats: at rest on a flat sea, in closed form on one plane wave, lifted by a crest."""

import inspect

import numpy as np
import pytest
import stillwater
from stillwater import Wind
from stillwater import _stillwater as engine
from stillwater.recipe.stochastic import Bob as RecipeBob

SIZE = (640, 400)
HORIZON = ((0, 120), (640, 120))
WATERLINE = [(200, 300), (240, 308), (320, 310), (380, 302)]


def moved(waterline, heights, amount=1.0):
    """The motion on a water that lifts the point at x by heights(x) pixels."""
    bob = engine.Bob(waterline=waterline, amount=amount)
    points = [(x, y - heights(x)) for x, y in engine.waterline_samples(bob)]
    return engine.fitted_motion(bob, points, SIZE)


def corners(motion):
    points = np.array([[(100, 100), (500, 100), (100, 380), (500, 380)]], np.float32)
    return points[0].astype(float), motion.map(points)[0].astype(float)


def heave_and_roll(motion, middle):
    """What a rigid motion does at `middle`, and its angle, from where it takes two points."""
    points = np.array([[middle, (middle[0] + 100, middle[1])]], np.float32)
    a, b = motion.map(points)[0].astype(float)
    return a - middle, np.arctan2(b[1] - a[1], b[0] - a[0])


def test_names_and_defaults_are_the_recipe_s():
    assert RecipeBob.__struct_fields__ == ("waterline", "water", "amount")
    assert engine.Bob(waterline=WATERLINE).amount == RecipeBob.__struct_defaults__[-1]
    assert inspect.signature(stillwater.bob).parameters["amount"].default == RecipeBob.__struct_defaults__[-1]


def test_a_flat_sea_moves_no_boat():
    offsets = stillwater.bob(SIZE, 9, WATERLINE, HORIZON, wind=Wind(speed=0))
    assert not offsets.any()
    assert moved(WATERLINE, lambda x: 0).at_rest()


def test_an_even_lift_is_heave_without_roll():
    before, after = corners(moved(WATERLINE, lambda x: 4.5))
    assert np.allclose(after - before, [0, -4.5], atol=1e-4)


def test_one_plane_wave_in_closed_form():
    """Waterline from -a to a about x0, lift A sin(k (x - x0) + phi): the mean is A sin(phi) sinc(ka), the regression's slope
    3 A cos(phi) (sin(ka) / (ka)^2 - cos(ka) / (ka)) / a."""
    x0, a, height = 320.0, 90.0, 6.0
    line = [(x0 - a, 300), (x0 + a, 300)]
    for k, phi in ((0.004, 0.3), (0.02, 1.0), (0.05, -0.7)):
        ka = k * a
        motion = moved(line, lambda x, k=k, phi=phi: height * np.sin(k * (x - x0) + phi))
        heave, roll = heave_and_roll(motion, (x0, 300.0))
        assert heave == pytest.approx([0, -height * np.sin(phi) * np.sin(ka) / ka], abs=0.005)
        slope = 3 * height * np.cos(phi) * (np.sin(ka) / ka**2 - np.cos(ka) / ka) / a
        assert roll == pytest.approx(-np.arctan(slope), abs=2e-4)


def test_a_wave_that_rises_to_the_right_rolls_the_boat_against_the_clock():
    before, after = corners(moved(WATERLINE, lambda x: (x - 290) / 10))
    assert after[1, 1] < before[1, 1] and after[0, 1] > before[0, 1]


def test_the_motion_is_rigid():
    before, after = corners(moved(WATERLINE, lambda x: 9 * np.sin(x / 30)))
    for i in range(4):
        for j in range(i):
            assert np.hypot(*(after[i] - after[j])) == pytest.approx(np.hypot(*(before[i] - before[j])), abs=1e-3)


def test_amount_scales_heave_and_roll():
    one, three = (heave_and_roll(moved(WATERLINE, lambda x: 3 + x / 50, amount), (290.0, 306.0)) for amount in (1, 3))
    assert three[1] == pytest.approx(3 * one[1], abs=1e-5)
    before, after = corners(moved(WATERLINE, lambda x: 3 + x / 50, 0.0))
    assert np.array_equal(before, after)


def test_points_weigh_by_length_not_by_number():
    crowded = [(200, 300), *[(200 + i / 10, 300) for i in range(1, 50)], (400, 300)]
    plain = heave_and_roll(moved([(200, 300), (400, 300)], lambda x: (x - 200) / 20), (300.0, 300.0))
    heave, roll = heave_and_roll(moved(crowded, lambda x: (x - 200) / 20), (300.0, 300.0))
    assert heave == pytest.approx(plain[0], abs=1e-3) and roll == pytest.approx(plain[1], abs=1e-6)


def test_a_crest_lifts_the_waterline():
    """A long hull's middle follows the mean of the water under it, up where the water is up."""
    given, wind = engine.Ripple(amplitude=0.4), Wind()
    water = engine.RippleMotion(given, engine.View(horizon=HORIZON), wind.moment(1).wind, SIZE)
    bob = engine.Bob(waterline=WATERLINE)
    rest = np.array(engine.waterline_samples(bob), np.float32)
    lifts = []
    for frame in range(1, 120, 7):
        surface = water.at(wind.moment(frame), given)
        lift = (surface.map(rest[None])[0] - rest).mean(0)
        heave, _ = heave_and_roll(engine.bob(bob, surface, SIZE), tuple(rest.mean(0).astype(float)))
        assert heave == pytest.approx(lift, abs=0.02)
        lifts.append(lift[1])
    assert min(lifts) < -1 < 1 < max(lifts)


def test_the_map_is_the_engine_s():
    offsets = stillwater.bob(SIZE, 20, WATERLINE, HORIZON, water=stillwater.Ripple(amplitude=0.4, seed=3))
    assert offsets.shape == (400, 640, 2) and offsets.dtype == np.float32
    forward = stillwater.bob(SIZE, 20, WATERLINE, HORIZON, water=stillwater.Ripple(amplitude=0.4, seed=3), forward=True)
    assert 0.3 < np.abs(offsets).max() < 60
    assert np.abs(offsets[200, 300] + forward[200, 300]).max() < 1


def test_the_line_at_rest_is_fitted_by_least_squares():
    (x0, y0), (x1, y1) = engine.fitted_waterline(engine.Bob(waterline=[(10, 100), (30, 110)]))
    assert (x0, y0, x1, y1) == pytest.approx((10, 100, 30, 110), abs=1e-9)
    sampled = np.array(engine.waterline_samples(engine.Bob(waterline=WATERLINE)))
    middle = sampled.mean(0)
    along = np.linalg.svd(sampled - middle)[2][0]
    (x0, y0), (x1, y1) = engine.fitted_waterline(engine.Bob(waterline=WATERLINE))
    for x, y in ((x0, y0), (x1, y1)):
        assert abs(np.cross(np.array([x, y]) - middle, along)) < 1e-9
    assert x0 == pytest.approx(200, abs=2) and x1 == pytest.approx(380, abs=2)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"waterline": [(3, 4)]}, "waterline: 1 point is not two points or more"),
        ({"waterline": [(3, 4), (3, 4)]}, "waterline: one place is not a line with two different ends"),
        ({"waterline": [(3, 4), (float("inf"), 4)]}, "waterline: inf is not a finite number"),
        ({"waterline": WATERLINE, "amount": -1}, "amount: -1 is not between 0 and 1000"),
    ],
)
def test_what_is_no_boat_is_refused(given, sentence):
    with pytest.raises(engine.BadInput) as refused:
        engine.fitted_waterline(engine.Bob(**given))
    assert str(refused.value) == sentence


def test_other_points_than_the_samples_are_refused():
    with pytest.raises(engine.BadInput, match="^moved: 2 points is not 64$"):
        engine.fitted_motion(engine.Bob(waterline=WATERLINE), [(0, 0), (1, 1)], SIZE)
