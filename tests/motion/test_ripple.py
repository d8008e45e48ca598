"""Water in perspective: raised where the plane says, hidden by crests in front, still on the horizon, calm near it."""

import inspect
import os
import subprocess
import sys

import numpy as np
import pytest
import stillwater
from scipy.ndimage import gaussian_filter, map_coordinates
from stillwater import Wind
from stillwater import _stillwater as engine
from stillwater.recipe.stochastic import Ripple as RecipeRipple

SIZE = (320, 200)
HORIZON = ((0, 60), (320, 60))
CALM = {"amplitude": 0.2}


def displacement(horizon=HORIZON, size=SIZE, frame=1.0, wind=None, loop=None, region=None, fov=50, height=1.7, **given):
    moment = (wind or Wind()).moment(frame, 24, loop)
    ripple, view = engine.Ripple(**given), engine.View(horizon=horizon, fov=fov, height=height)
    return engine.RippleMotion(ripple, view, moment.wind, size, region).at(moment, ripple)


def centres(size=SIZE):
    y, x = np.mgrid[: size[1], : size[0]] + 0.5
    return np.stack([x, y], -1).astype(np.float32)


def sampled(picture, offsets):
    y, x = np.mgrid[: picture.shape[0], : picture.shape[1]]
    return map_coordinates(picture, [y + offsets[..., 1], x + offsets[..., 0]], order=1, mode="nearest")


def test_names_and_defaults_are_the_recipe_s():
    usual = engine.Ripple()
    given = inspect.signature(stillwater.ripple).parameters
    for name, default in zip(RecipeRipple.__struct_fields__, RecipeRipple.__struct_defaults__, strict=True):
        default = 0 if name == "seed" else default
        assert getattr(usual, name) == default == given[name].default == getattr(stillwater.Ripple(), name), name


def test_nothing_moves_on_and_above_the_horizon():
    for forward in (False, True):
        offsets = stillwater.ripple(SIZE, 9, HORIZON, forward=forward)
        assert not offsets[:60].any()
        assert np.abs(offsets[70:]).max() > 1
    tilted = stillwater.ripple(SIZE, 9, ((0, 20), (320, 110)))
    x, y = centres()[..., 0], centres()[..., 1]
    assert not tilted[y <= 20 + x * 90 / 320].any()


@pytest.mark.parametrize("horizon", [((0, 500), (320, 500)), ((-50, 201), (400, 201))])
def test_water_wholly_above_the_picture_s_bottom_edge_stands_still(horizon):
    water = displacement(horizon)
    assert water.at_rest() and water.reach() == 0
    assert not water.displacement_map(SIZE).any()


def test_a_point_goes_to_where_the_plane_says_it_is_seen_when_raised():
    """The height there is the tile's, summed wave by wave; near the eye, where pixels are far smaller than waves."""
    size, horizon, wind = (640, 400), ((0, 90), (640, 130)), Wind(direction=30)
    plane = engine.WaterPlane(engine.View(horizon=horizon), size)
    water = displacement(horizon, size, 5, wind, resolution=512)
    heights = stillwater.wave_heights(4 / 24, resolution=512, wind=wind)
    spectrum = np.fft.fft2(heights) / heights.size
    waves = np.fft.fftfreq(512) * 512 * 2 * np.pi / 60
    missed, gone = [], []
    for point in np.random.default_rng(0).uniform((0, 300), (640, 400), (40, 2)):
        right, away = plane.ground(point)
        height = ((spectrum * np.exp(1j * waves * right)).sum(1) * np.exp(1j * waves * away)).sum().real
        expected = np.array(plane.seen((right, away), height))
        missed.append(water.map(point.astype(np.float32)[None, None])[0, 0] - expected)
        gone.append(expected - point)
    # Waves of two samples of the tile have no certain height between them.
    assert np.linalg.norm(missed) < 0.015 * np.linalg.norm(gone)
    assert np.abs(gone).max() > 10


def test_a_crest_lifts_and_is_sampled_from_below():
    forward, back = (stillwater.ripple(SIZE, 1, HORIZON, forward=f, **CALM)[150] for f in (True, False))
    crest = forward[:, 1].argmin()
    assert forward[crest, 1] < 0 < back[crest, 1]


@pytest.mark.parametrize("horizon", [HORIZON, ((0, 20), (320, 110)), ((0, -300), (320, -320)), ((0, 150), (320, 160))])
@pytest.mark.parametrize("given", [CALM, {"amplitude": 0.3, "mode": "normal"}], ids=["height", "normal"])
def test_there_and_back(horizon, given):
    water = displacement(horizon, frame=7, wind=Wind(direction=70), **given)
    points = centres()
    there = water.map(points)
    assert np.abs(there - points).max() > 0.5
    for back in (water.map(water.unmap(points)), water.unmap(there)):
        missed = np.abs(back - points).max(-1)
        assert np.quantile(missed, 0.95) < 0.01
        assert (missed > 0.05).mean() < 0.01  # behind a crest, or in a pixel in which one ends


def test_what_is_seen_is_the_nearest_of_the_points_that_come_to_a_place():
    """In a rough sea, against a search of each column in a forward map made 8 times as fine along it."""
    water = displacement(frame=3, wind=Wind(direction=90))
    column, fine = 160.5, np.arange(60, 330, 0.125, dtype=np.float32)
    goes_to = water.map(np.stack([np.full_like(fine, column), fine], -1)[None])[0, :, 1]
    assert (np.diff(goes_to) < 0).any()  # it does fold
    targets = np.arange(61.5, 200, 1.0, dtype=np.float32)
    answers = water.unmap(np.stack([np.full_like(targets, column), targets], -1)[None])[0, :, 1]
    nearest = []
    for target in targets:
        last = np.nonzero((goes_to[:-1] <= target) & (goes_to[1:] > target))[0][-1]
        nearest.append(fine[last] + 0.125 * (target - goes_to[last]) / (goes_to[last + 1] - goes_to[last]))
    wrong = np.abs(answers - nearest) > 0.1
    assert wrong.mean() < 0.05  # the pixels in which a crest ends
    assert np.median(np.abs(answers - nearest)) < 0.01


@pytest.mark.parametrize("given", [{}, {"mode": "normal"}], ids=["height", "normal"])
def test_the_answer_does_not_depend_on_the_region(given):
    whole = displacement(frame=5, **CALM, **given)
    part = displacement(frame=5, region=(100, 90, 64, 40), **CALM, **given)
    none = displacement(frame=5, region=(0, 0, 10, 10), **CALM, **given)
    points = centres()[::7, ::11]
    for way in ("map", "unmap"):
        expected = getattr(whole, way)(points)
        assert np.abs(getattr(part, way)(points) - expected).max() < 0.02
        assert np.abs(getattr(none, way)(points) - expected).max() < 0.02


def test_a_tilted_horizon_is_the_level_case_turned():
    """Pictures are square here, so that both have the same focal length; the turn is about the principal point."""
    size, angle = (240, 240), np.radians(25)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    level_line = np.array([[0, 70], [240, 70]], float)
    turned_line = (level_line - 120) @ turn.T + 120
    level = displacement(level_line.tolist(), size, 4, **CALM)
    turned = displacement(turned_line.tolist(), size, 4, **CALM)
    points = np.stack(np.meshgrid(np.linspace(60, 180, 9), np.linspace(90, 180, 9)), -1).astype(np.float32)
    for way in ("map", "unmap"):
        expected = (getattr(level, way)(points) - 120) @ turn.T + 120
        answer = getattr(turned, way)(((points - 120) @ turn.T + 120).astype(np.float32))
        assert np.abs(answer - expected).max() < 0.02


@pytest.mark.parametrize("horizon", [HORIZON, ((0, 60.3), (320, 60.3)), ((0, 20), (320, 110)), ((320, 60), (0, 60))])
@pytest.mark.parametrize("size", [(320, 200), (321, 199)])
def test_a_row_of_pixels_is_sampled_where_its_points_are(horizon, size):
    for region in (None, (100, 90, 64, 40)):
        water = displacement(horizon, size, 5, region=region, mode="normal", **CALM)
        points = centres(size)
        rows = water.displacement_map(size)
        assert np.abs(rows).max() > 0.5
        np.testing.assert_allclose(rows, water.unmap(points) - points, atol=1e-4)


def test_no_point_goes_further_than_the_reach():
    for given in ({}, {"amplitude": 3.0}, {"mode": "normal"}, {"amplitude": 900.0}):
        for horizon in (HORIZON, ((0, -300), (320, -250))):
            water = displacement(horizon, frame=2, **given)
            moved = np.hypot(*np.moveaxis(water.forward_map(SIZE), -1, 0))
            assert np.isfinite(moved).all()
            assert 0 < moved.max() <= water.reach()


def test_no_wave_rises_above_the_eye():
    offsets = stillwater.ripple(SIZE, 2, HORIZON, amplitude=900.0, forward=True)
    assert (centres()[..., 1] + offsets[..., 1])[61:].min() > 60


def test_amplitude_scales_and_nought_is_rest():
    one, two = (stillwater.ripple(SIZE, 3, HORIZON, amplitude=a, forward=True) for a in (0.1, 0.2))
    assert np.abs(two - 2 * one).max() < 0.01 * np.abs(two).max()
    for still in (displacement(amplitude=0.0), displacement(wind=Wind(speed=0))):
        assert still.at_rest()
        assert not still.displacement_map(SIZE).any()


def test_roughness_repeats_the_tile_more_often_over_the_same_water():
    rough, smooth = (displacement(roughness=r, **CALM).forward_map((640, 400))[300:, :, 1] for r in (4, 1))
    assert np.var(np.diff(rough, axis=1)) > 4 * np.var(np.diff(smooth, axis=1))


def test_a_loop_closes_to_the_byte():
    for mode in ("height", "normal"):
        first, next_one = (stillwater.ripple(SIZE, frame, HORIZON, loop=48, mode=mode) for frame in (13, 61))
        assert first.tobytes() == next_one.tobytes()
        assert first.tobytes() != stillwater.ripple(SIZE, 37, HORIZON, loop=48, mode=mode).tobytes()


def test_a_wind_that_changes_does_not_make_the_water_jump():
    winds = ((5, 0), (5.01, 0), (5, 0.1))
    frames = [stillwater.ripple(SIZE, 500, HORIZON, wind=Wind(speed=s, direction=d), **CALM) for s, d in winds]
    for other in frames[1:]:
        assert 0 < np.abs(other - frames[0]).max() < 0.05 * np.abs(frames[0]).max()


def test_gusts_raise_the_water_where_they_blow():
    still, gusty = Wind(), Wind(gusts=0.6)
    even, uneven = (stillwater.ripple(SIZE, 1, HORIZON, wind=w, forward=True, **CALM)[..., 1] for w in (still, gusty))
    for x, y in ((48, 150), (160, 180), (272, 120)):
        expected = gusty.gust((x + 0.5, y + 0.5), SIZE, 1)
        assert uneven[y, x] / even[y, x] == pytest.approx(expected, rel=0.12)


def energy(scale, frames, **given):
    """Variance over time, by rows, of a noise picture under the water, at `scale` x `scale` samples a pixel."""
    width, height, horizon = 200, 120, 40
    noise = np.random.default_rng(1).standard_normal((height * 4, width * 4))
    fine = gaussian_filter(noise, 4).astype(np.float32)
    to = 4 // scale
    picture = fine.reshape(height * scale, to, width * scale, to).mean((1, 3))
    shown = []
    for frame in frames:
        line = ((0, horizon * scale), (width * scale, horizon * scale))
        image = sampled(picture, stillwater.ripple((width * scale, height * scale), frame, line, **given))
        shown.append(image.reshape(height, scale, width, scale).mean((1, 3)))
    return np.var(shown, axis=0).mean(1)[horizon:]


@pytest.mark.parametrize(
    "given", [{}, {"wind": Wind(direction=90)}, {"amplitude": 0.3}, {"resolution": 512, "tile": 10.0}]
)
def test_near_the_horizon_the_water_is_no_busier_than_16_samples_a_pixel(given):
    frames = range(1, 400, 33)
    ours, truth = (energy(scale, frames, **given) for scale in (1, 4))
    assert ours[:20].mean() <= 1.2 * truth[:20].mean()
    for first, last in ((0, 20), (20, 40), (40, 79)):  # and does not die earlier than it should
        assert ours[first:last].mean() >= 0.5 * truth[first:last].mean()


def test_the_next_moment_is_the_same_whether_kept_or_made_anew():
    ripple, wind = engine.Ripple(), Wind()
    view = engine.View(horizon=HORIZON)
    motion = engine.RippleMotion(ripple, view, wind.moment(1).wind, SIZE)
    one = motion.at(wind.moment(3), ripple)
    for frame in (4, 5, 6, 3):
        again = motion.at(wind.moment(frame), ripple)
    fresh = engine.RippleMotion(ripple, view, wind.moment(1).wind, SIZE).at(wind.moment(3), ripple)
    maps = {displacement.displacement_map(SIZE).tobytes() for displacement in (one, again, fresh)}
    assert len(maps) == 1


def test_threads_do_not_change_a_byte():
    answers = set()
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        answers.add(stillwater.ripple(SIZE, 2, HORIZON).tobytes())
    engine.set_threads(0)
    assert len(answers) == 1


def test_the_plain_way_is_the_fast_way_within_a_thousandth():
    call = "stillwater.ripple((320, 200), 7, ((0, 60), (320, 60)), amplitude=0.2)"
    command = [sys.executable, "-c", f"import sys, stillwater; sys.stdout.buffer.write({call}.tobytes())"]
    plainly = {**os.environ, "STILLWATER_CPU": "sse4.2"}
    plain = subprocess.run(command, env=plainly, capture_output=True, timeout=60, check=True)
    fast = stillwater.ripple(SIZE, 7, HORIZON, **CALM)
    assert np.abs(np.frombuffer(plain.stdout, np.float32).reshape(fast.shape) - fast).max() < 1e-3 * np.abs(fast).max()


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"tile": 5.0}, "tile: 5 is not between 10 and 2000 (m)"),
        ({"roughness": 0.0}, "roughness: 0 is not between 0.0001 and 10000"),
        ({"amplitude": -1.0}, "amplitude: -1 is not between 0 and 1000"),
        ({"mode": "foam"}, 'mode: "foam" is not height or normal'),
        ({"resolution": 300}, "resolution: 300 is not a power of two between 16 and 2048"),
        ({"spectrum": "foam"}, 'spectrum: "foam" is not phillips, pierson-moskowitz, jonswap or tma'),
    ],
)
def test_what_is_no_water_is_refused(given, sentence):
    with pytest.raises(engine.BadInput) as refused:
        stillwater.ripple(SIZE, 1, HORIZON, **given)
    assert str(refused.value) == sentence


def test_what_is_no_tile_is_refused_before_the_first_frame():
    with pytest.raises(engine.BadInput, match="^fetch: 0 is not above 0"):
        engine.RippleMotion(engine.Ripple(fetch=0.0), engine.View(horizon=HORIZON), engine.Wind(), SIZE)
