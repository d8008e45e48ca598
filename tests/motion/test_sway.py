"""Sway: the tip obeys its differential equation, the layer turns about its root, both ways, without a fold."""

import os
import subprocess
import sys

import numpy as np
import pytest
import stillwater
from scipy.integrate import solve_ivp
from stillwater import _stillwater as engine
from stillwater.recipe.stochastic import Sway as RecipeSway

SIZE = (320, 240)
ARMATURE = ((150.0, 220.0), (150.0, 40.0))
LENGTH = 180.0


def sway_of(**given):
    return engine.Sway(**{"armature": ARMATURE, **given})


def tips(times, wind=None, loop=None, fps=24, **given):
    wind = wind or stillwater.Wind()
    sway = sway_of(**given)
    motion = engine.SwayMotion(sway, wind.moment(1).wind, SIZE)
    drawn = [motion.tip(wind.moment(1 + t * fps, fps, loop), sway) for t in times]
    return np.array([(tip.across, tip.depth, tip.force) for tip in drawn]).T


def grid(size=SIZE):
    x, y = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    return np.stack([x, y], -1)


def tip_angle(frame, **given):
    """Of the drawn layer, clockwise, from the map of where points go."""
    forward = stillwater.sway(SIZE, frame, ARMATURE, forward=True, **given)
    start = grid()[40, 150] - ARMATURE[0]
    end = start + forward[40, 150]
    return np.arctan2(end[0], -end[1]) - np.arctan2(start[0], -start[1])


def a_windy_frame(**given):
    """The frame, of a hundred, at which the tip is furthest out."""
    drawn = tips(np.arange(100) / 24, **given)
    return 1 + int(np.argmax(np.abs(drawn[0])))


def test_names_and_defaults_are_the_recipe_s():
    ours = sway_of()
    required = len(RecipeSway.__struct_fields__) - len(RecipeSway.__struct_defaults__)
    for name, default in zip(RecipeSway.__struct_fields__[required:], RecipeSway.__struct_defaults__):
        if name != "seed":  # absent in a recipe: the layer's own
            assert getattr(ours, name) == default, name
    assert np.array_equal(ours.armature, ARMATURE)


@pytest.mark.parametrize(
    "given",
    [
        {},
        {"frequency": 1.3, "mass": 2.5, "damping": 0.2},
        {"wind": stillwater.Wind(speed=12, direction=70)},
        {"loop": 100},
    ],
)
def test_the_tip_follows_the_oscillator_s_equation(given):
    """d'' + gamma d' + (2 pi f0)^2 d = w / m (Chuang et al. 2005, eq. 4), stepped under the same force."""
    f0, mass, damping = given.get("frequency", 0.6), given.get("mass", 1), given.get("damping", 0.4)
    fine = np.arange(-1, 10 * 240 + 2) / 240
    across, _, force = tips(fine, **given)
    start = [across[1], (across[2] - across[0]) * 120]

    def law(t, d):
        return [d[1], np.interp(t, fine, force) / mass - damping * d[1] - (2 * np.pi * f0) ** 2 * d[0]]

    times = fine[1 : 10 * 240 : 20]
    stepped = solve_ivp(law, (0, 10), start, t_eval=times, rtol=1e-6, atol=1e-8, max_step=0.02).y[0]
    assert np.abs(stepped - across[1 : 10 * 240 : 20]).max() < 0.01 * np.abs(across).max()


@pytest.mark.parametrize("given", [{}, {"loop": 48, "seed": 3}, {"loop": 30, "seed": 9, "fps": 30}])
def test_amount_1_is_a_twentieth_of_the_armature(given):
    period = given["loop"] / given.get("fps", 24) if "loop" in given else engine.turbulence_period
    times = np.linspace(0, period, 1280 if period > 10 else 48, endpoint=False)
    assert tips(times, **given)[0].std() == pytest.approx(0.05 * LENGTH, rel=2e-3)
    assert tips(times, amount=3, **given)[0].std() == pytest.approx(0.15 * LENGTH, rel=2e-3)


def test_strength_over_the_wind_is_the_spectrum_s():
    """The mean square is the sum of P_V(f) |H(f)|^2."""
    f = np.arange(1, 1025) / 128
    response = 1 / np.abs((2 * np.pi) ** 2 * (0.36 - f**2) + 2j * np.pi * 0.4 * f) ** 2
    squares = {v: (engine.wind_spectrum(f, v) * response).sum() for v in (5, 10)}
    drawn = tips(np.arange(0, 128, 1 / 10), wind=stillwater.Wind(speed=10))[0].std()
    assert drawn / (0.05 * LENGTH) == pytest.approx(np.sqrt(squares[10] / squares[5]), rel=2e-3)


def test_wind_into_depth_sways_half_as_much_on_noise_of_its_own():
    times = np.arange(0, 128, 1 / 8)
    along, depth = (tips(times, wind=stillwater.Wind(direction=direction)) for direction in (0, 90))
    assert depth[0].std() / along[0].std() == pytest.approx(0.5, rel=0.01)
    assert abs(np.corrcoef(depth[0], along[0])[0, 1]) < 0.35
    assert depth[1].std() / along[1].std() == pytest.approx(2, rel=0.01)


def test_the_other_way_of_the_wind_bends_the_other_way():
    times = np.arange(0, 20, 0.5)
    right, left = (tips(times, wind=stillwater.Wind(direction=direction))[0] for direction in (0, 180))
    assert np.allclose(right, -left, atol=1e-9)


@pytest.mark.parametrize("direction", [0, 180])
def test_a_gust_leans_the_tip_where_it_blows_to(direction):
    wind = stillwater.Wind(gusts=1, direction=direction, seed=5)
    times = np.arange(0, 120, 1 / 8)
    across = np.mean([tips(times, wind=wind, seed=seed, frequency=2)[0] for seed in range(4)], axis=0)
    strength = np.array([wind.gust((150, 130), SIZE, 1 + 24 * t) for t in times])
    to_the_right = 1 if direction == 0 else -1
    assert np.corrcoef(across * to_the_right, strength)[0, 1] > 0.6


def test_positive_is_a_tip_to_the_right():
    for frame in (3, 30, 77):
        across = tips([(frame - 1) / 24])[0][0]
        assert tip_angle(frame) == pytest.approx(across / LENGTH, rel=0.01, abs=1e-3)


def test_a_point_turns_by_the_bend_of_its_radius():
    frame = a_windy_frame(amount=2)
    bend = tips([(frame - 1) / 24], amount=2)[0][0] / LENGTH
    bend /= (1 + bend**4) ** 0.25
    moved = grid() + stillwater.sway(SIZE, frame, ARMATURE, amount=2, forward=True)
    before, after = (points - ARMATURE[0] for points in (grid(), moved))
    radius = np.hypot(*before.transpose(2, 0, 1))
    assert np.allclose(np.hypot(*after.transpose(2, 0, 1)), radius, atol=1e-3)
    cross = before[..., 0] * after[..., 1] - before[..., 1] * after[..., 0]
    turned = np.arctan2(cross, (before * after).sum(-1))
    u = radius / LENGTH
    expected = bend * np.where(u < 1, u**3 / 3 - 4 * u**2 / 3 + 2 * u, 1 / np.maximum(u, 1))
    assert np.abs((turned - expected) * radius).max() < 1e-3


def test_the_root_stands_still():
    moment = stillwater.Wind(direction=40).moment(a_windy_frame())
    sway = sway_of(foreshortening=1, shimmer=1)
    displacement = engine.SwayMotion(sway, moment.wind, SIZE).at(moment, sway)
    root, tip = displacement.map([[ARMATURE[0], ARMATURE[1]]])[0] - ARMATURE
    assert not root.any()
    assert np.hypot(*tip) > 5


ALL_WAYS = [
    {},
    {"amount": 4},
    {"amount": 1000},
    {"foreshortening": 1, "wind": stillwater.Wind(direction=60)},
    {"shimmer": 1},
    {"shimmer": 1, "foreshortening": 0.5, "amount": 2, "wind": stillwater.Wind(speed=20, gusts=1)},
]


@pytest.mark.parametrize("given", ALL_WAYS)
def test_forwards_and_back_is_where_it_was(given):
    frame = a_windy_frame()
    wind = given.get("wind", stillwater.Wind())
    moment = wind.moment(frame)
    numbers = {name: value for name, value in given.items() if name != "wind"}
    displacement = engine.SwayMotion(sway_of(**numbers), moment.wind, SIZE).at(moment, sway_of(**numbers))
    start = grid()
    for there, back in ((displacement.map, displacement.unmap), (displacement.unmap, displacement.map)):
        assert np.abs(back(there(start)) - start).max() < 1e-3


@pytest.mark.parametrize("given", ALL_WAYS)
@pytest.mark.parametrize("forward", [False, True])
def test_nothing_tears_or_folds(given, forward):
    points = grid() + stillwater.sway(SIZE, a_windy_frame(), ARMATURE, forward=forward, **given)
    across, down = np.diff(points, axis=1)[:-1], np.diff(points, axis=0)[:, :-1]
    area = across[..., 0] * down[..., 1] - across[..., 1] * down[..., 0]
    assert area.min() > 0.1 and area.max() < 10


@pytest.mark.parametrize("given", ALL_WAYS)
def test_no_point_goes_further_than_reach(given):
    wind = given.get("wind", stillwater.Wind())
    numbers = {name: value for name, value in given.items() if name != "wind"}
    moment = wind.moment(a_windy_frame())
    displacement = engine.SwayMotion(sway_of(**numbers), moment.wind, SIZE).at(moment, sway_of(**numbers))
    for field in (displacement.displacement_map(SIZE), displacement.forward_map(SIZE)):
        assert np.hypot(*field.transpose(2, 0, 1)).max() <= displacement.reach() + 1e-3


def test_leaning_away_shortens():
    """Scaled along the armature by exp(-foreshortening depth / (2 length))."""
    wind = stillwater.Wind(direction=90)
    for frame in (10, 40):
        depth = tips([(frame - 1) / 24], wind=wind)[1][0] / LENGTH
        forward = stillwater.sway(SIZE, frame, ARMATURE, wind=wind, foreshortening=1, forward=True)
        moved = grid()[130, 150] + forward[130, 150]
        before = np.hypot(*(grid()[130, 150] - ARMATURE[0]))
        assert np.hypot(*(moved - ARMATURE[0])) / before == pytest.approx(np.exp(-depth / 2), rel=1e-4)


@pytest.mark.parametrize("still", [{"wind": stillwater.Wind(speed=0)}, {"amount": 0}])
def test_without_wind_or_strength_it_is_exactly_at_rest(still):
    assert not stillwater.sway(SIZE, 17, ARMATURE, foreshortening=1, **still).any()
    wind = still.get("wind", stillwater.Wind()).moment(17)
    sway = sway_of(amount=still.get("amount", 1))
    assert engine.SwayMotion(sway, wind.wind, SIZE).at(wind, sway).at_rest()


@pytest.mark.parametrize("loop", [24, 100])
def test_a_loop_closes_to_the_byte(loop):
    given = {"loop": loop, "shimmer": 0.5, "foreshortening": 0.3, "wind": stillwater.Wind(gusts=0.6, direction=20)}
    for frame in (1, 13):
        one, two = (stillwater.sway(SIZE, f, ARMATURE, **given) for f in (frame, frame + loop))
        assert np.array_equal(one, two)
    assert not np.array_equal(one, stillwater.sway(SIZE, 14, ARMATURE, **given))


def test_any_frame_alone_and_any_threads_give_the_same_bytes():
    given = {"shimmer": 0.5, "foreshortening": 0.3, "wind": stillwater.Wind(gusts=0.6)}
    drawn = {}
    try:
        for threads in (1, 2, 5):
            engine.set_threads(threads)
            for frame in (40, 2, 17):
                drawn.setdefault(frame, set()).add(stillwater.sway(SIZE, frame, ARMATURE, **given).tobytes())
    finally:
        engine.set_threads(0)
    assert [len(bytes_) for bytes_ in drawn.values()] == [1, 1, 1]


def test_a_change_of_frequency_or_speed_does_not_jump():
    sway, moment = sway_of(), stillwater.Wind().moment(500)
    motion = engine.SwayMotion(sway, moment.wind, SIZE)
    before = motion.tip(moment, sway).across
    assert abs(motion.tip(moment, sway_of(frequency=0.6001)).across - before) < 0.05
    assert abs(motion.tip(stillwater.Wind(speed=5.01).moment(500), sway).across - before) < 0.05


def test_layers_do_not_sway_in_step():
    times = np.arange(0, 128, 1 / 8)
    assert abs(np.corrcoef(tips(times, seed=1)[0], tips(times, seed=2)[0])[0, 1]) < 0.35


def test_two_trees_answer_one_gust_after_its_way():
    """The lag between two trees is their distance over the gust's speed, within a frame. What leans a tree is what the
    gusts add to a calm day's turbulence, whose strength is the local factor."""
    gusty, calm, fps, size = stillwater.Wind(gusts=1, seed=3), stillwater.Wind(), 24, (800, 400)
    times = np.arange(0, 60, 1 / fps)
    leans = []
    for x in (200.0, 400.0):
        tree = engine.Sway(armature=((x, 380), (x, 200)), seed=int(x))
        motion = engine.SwayMotion(tree, gusty.moment(1).wind, size)
        frames = 1 + times * fps
        windy, still = ([motion.tip(wind.moment(f), tree).across for f in frames] for wind in (gusty, calm))
        leans.append(windy - np.array([gusty.gust((x, 290), size, f) for f in frames]) * still)
    lags = np.arange(20, 100)
    inner = len(times) - 100
    match = [np.corrcoef(leans[0][:inner], leans[1][lag : lag + inner])[0, 1] for lag in lags]
    assert abs(lags[np.argmax(match)] - 200 * engine.plan_width / 800 / 5 * fps) <= 1
    assert max(match) > 0.999


def test_the_plain_way_is_the_fast_way():
    script = (
        "import sys, stillwater; from stillwater import _stillwater as engine; assert not engine.has_avx2();"
        f"drawn = stillwater.sway({SIZE}, 33, {ARMATURE}, amount=3, shimmer=1, foreshortening=1);"
        "sys.stdout.buffer.write(drawn.tobytes())"
    )
    plain = subprocess.run(
        [sys.executable, "-c", script],
        env={**os.environ, "STILLWATER_CPU": "sse4.2"},
        capture_output=True,
        timeout=60,
        check=True,
    ).stdout
    here = stillwater.sway(SIZE, 33, ARMATURE, amount=3, shimmer=1, foreshortening=1)
    assert np.abs(np.frombuffer(plain, np.float32).reshape(here.shape) - here).max() < 1e-3


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        (
            {"armature": ((5, 5), (5, 5))},
            "armature: a line from a point to itself is not a line with two different ends",
        ),
        ({"armature": ((5, 5), (5, 2e6))}, "armature: 2e+06 is not between -1e+06 and 1e+06 (px)"),
        ({"frequency": 0}, "frequency: 0 is not above 0 (Hz)"),
        ({"mass": -1}, "mass: -1 is not above 0"),
        ({"damping": 0}, "damping: 0 is not above 0 (1/s)"),
        ({"amount": -0.5}, "amount: -0.5 is not between 0 and 1000"),
        ({"foreshortening": 2}, "foreshortening: 2 is not between 0 and 1"),
        ({"shimmer": float("nan")}, "shimmer: nan is not between 0 and 1"),
    ],
)
def test_what_no_sway_can_be_is_refused(given, sentence):
    given = {"armature": ARMATURE, **given}
    with pytest.raises(stillwater.BadInput) as refused:
        stillwater.sway(SIZE, 1, given.pop("armature"), **given)
    assert str(refused.value) == sentence


def test_numbers_of_a_later_moment_are_checked_too():
    moment = stillwater.Wind().moment(1)
    motion = engine.SwayMotion(sway_of(), moment.wind, SIZE)
    for wrong, sentence in ((sway_of(frequency=-1), "frequency: -1"), (sway_of(amount=-1), "amount: -1")):
        with pytest.raises(stillwater.BadInput, match=sentence):
            motion.at(moment, wrong)
