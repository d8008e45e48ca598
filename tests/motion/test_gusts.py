"""Gusts are never negative, 1 on the whole, and travel over the picture with the wind."""

import numpy as np
import pytest
import stillwater
from scipy.integrate import solve_ivp
from stillwater import _stillwater as engine

PICTURE = (800, 400)
METRES = engine.plan_width / PICTURE[0]


def factors(place, frames, **wind):
    blowing = stillwater.Wind(**{"gusts": 1, **wind})
    return np.array([blowing.gust(place, PICTURE, frame) for frame in frames])


def test_strength_is_never_negative_and_one_on_the_whole():
    places = [(x, y) for x in range(0, 800, 80) for y in range(0, 400, 80)]
    drawn = np.array(
        [stillwater.Wind(gusts=1, seed=seed).gust(place, PICTURE, 1) for seed in range(60) for place in places]
    )
    assert drawn.min() >= 0
    assert drawn.mean() == pytest.approx(1, abs=0.1)
    assert drawn.std() == pytest.approx(1, abs=0.15)


def test_their_size_is_the_one_asked_for():
    """Half of the correlation is left over half of gust_size."""
    half = 0.5 * 0.25 * PICTURE[0]
    pairs = np.array(
        [
            [stillwater.Wind(gusts=1, seed=seed).gust((x, 200), PICTURE, 1) for x in (400 - half / 2, 400 + half / 2)]
            for seed in range(3000)
        ]
    )
    assert np.corrcoef(pairs.T)[0, 1] == pytest.approx(0.5, abs=0.07)


def test_a_share_of_the_speed_stays_steady():
    frames = range(1, 200, 7)
    whole, half = factors((300, 200), frames), factors((300, 200), frames, gusts=0.5)
    assert np.allclose(half, 0.5 + 0.5 * whole, rtol=1e-12)
    assert (factors((300, 200), frames, gusts=0) == 1).all()


@pytest.mark.parametrize(("direction", "second"), [(0, (500, 300)), (180, (100, 300)), (90, (300, 100))])
def test_a_gust_s_lag_between_two_places_is_distance_over_speed(direction, second):
    fps, frames = 24, np.arange(1, 1500)
    one = factors((300, 300), frames, direction=direction)
    two = factors(second, frames, direction=direction)
    lags = np.arange(-120, 121)
    inner = slice(120, -120)
    match = [np.corrcoef(one[inner], np.roll(two, -lag)[inner])[0, 1] for lag in lags]
    expected = 200 * METRES / 5 * fps
    assert abs(lags[np.argmax(match)] - expected) <= 1
    assert max(match) > 0.99


def test_in_a_loop_the_gusts_travel_with_the_wind_and_close():
    wind, loop = stillwater.Wind(gusts=1), 240
    frames = range(1, 2 * loop + 1)
    rows = {x: np.array([wind.gust((x, 200), PICTURE, frame, loop=loop) for frame in frames]) for x in (200, 400)}
    for row in rows.values():
        assert np.array_equal(row[:loop], row[loop:])
        assert row.std() > 0.2
    lag = round(200 * METRES / 5 * 24)
    assert np.allclose(rows[400][lag:loop], rows[200][: loop - lag], atol=1e-5)


def test_gusts_move_an_oscillator_as_they_would_in_time():
    """The closed sum against an integration of d'' + gamma d' + omega^2 d = (factor - 1) / m."""
    f0, mass, damping, place = 0.6, 2.0, 0.4, (300, 200)
    wind, fps = stillwater.Wind(gusts=0.7, direction=30, seed=2), 24
    field = engine.GustField(wind.gust_size, wind.seed, PICTURE)

    def response(t):
        return field.response(place, wind.moment(1 + t * fps, fps), f0, mass, damping)

    def force(t):
        return field.factor(place, wind.moment(1 + t * fps, fps)) - 1

    step = 1e-3
    start = [response(0), (response(step) - response(-step)) / (2 * step)]
    times = np.linspace(0, 12, 100)

    def law(t, d):
        return [d[1], force(t) / mass - damping * d[1] - (2 * np.pi * f0) ** 2 * d[0]]

    stepped = solve_ivp(law, (0, 12), start, t_eval=times, rtol=1e-7, atol=1e-9, max_step=0.05).y[0]
    closed = np.array([response(t) for t in times])
    assert np.abs(stepped - closed).max() < 0.01 * np.abs(closed).max()


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ((0, 1, PICTURE), "gust_size: 0 is not above 0 (of the picture's width)"),
        ((0.25, 1, (0, 5)), "picture: 0 x 5 is not between 1 and 16384 pixels a side"),
    ],
)
def test_what_no_field_can_be_is_refused(given, sentence):
    with pytest.raises(stillwater.BadInput) as refused:
        engine.GustField(*given)
    assert str(refused.value) == sentence


@pytest.mark.parametrize("loop", [0, 240])
def test_places_in_a_line_have_the_factors_of_each_alone(loop):
    field = engine.GustField(0.2, 5, PICTURE)
    wind = engine.Wind(gusts=0.7, travel=(13, -4))
    moment = engine.Moment(frame=37, fps=24, loop_frames=loop, wind=wind, loop_travel=(40, 10) if loop else (0, 0))
    (x, y), (right, down), count = (-30, 410), (24, -3.5), 60
    alone = [field.factor((x + i * right, y + i * down), moment) for i in range(count)]
    np.testing.assert_allclose(field.factors((x, y), (right, down), count, moment), alone, rtol=1e-6, atol=1e-7)
    assert np.std(alone) > 0.2
    calm = engine.Moment(frame=37, fps=24, wind=engine.Wind(gusts=0))
    assert field.factors((0, 0), (1, 1), 3, calm) == [1, 1, 1]
