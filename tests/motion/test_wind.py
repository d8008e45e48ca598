"""The wind's turbulence has the spectrum it is made from, depends on its seed alone, and closes in a loop."""

import numpy as np
import pytest
import stillwater
from stillwater import _stillwater as engine
from stillwater.recipe.picture import Wind as RecipeWind

PERIOD = engine.turbulence_period


def test_names_and_defaults_are_the_recipe_s():
    ours, recipe = engine.Wind(), RecipeWind()
    for name in RecipeWind.__struct_fields__:
        if name != "seed":  # absent in a recipe: the recipe's own
            assert getattr(ours, name) == getattr(recipe, name) == getattr(stillwater.Wind(), name), name


@pytest.mark.parametrize("speed", [2, 5, 20])
def test_the_spectrum_integrates_to_the_turbulence_s_square(speed):
    frequencies = np.concatenate([[0.0], np.geomspace(1e-6, 1e5, 200_000)])
    power = engine.wind_spectrum(np.where(frequencies == 0, 1e-12, frequencies), speed)
    integral = np.trapezoid(power, frequencies) if hasattr(np, "trapezoid") else np.trapz(power, frequencies)
    assert integral == pytest.approx((engine.turbulence_intensity * speed) ** 2, rel=2e-3)


def test_the_spectrum_has_kaimal_s_form():
    f, v = np.array([0.01, 0.1, 1.0, 5.0]), 5.0
    shape = v / (1 + 500 * f / v) ** (5 / 3)
    assert np.allclose(engine.wind_spectrum(f, v) / engine.wind_spectrum(1.0, v), shape / shape[2], rtol=1e-12)


def spectra(speed, seeds):
    """Mean one-sided power of whole periods, at k / PERIOD."""
    times = np.arange(0, PERIOD, 1 / 17)  # above twice the cutoff
    wind = stillwater.Wind(speed=speed)
    series = np.array([wind.series(times, seed=seed) for seed in range(seeds)])
    power = 2 * np.abs(np.fft.rfft(series) / len(times)) ** 2 * PERIOD
    return np.arange(power.shape[1]) / PERIOD, power.mean(0), series


def test_variance_and_slope_of_the_series_are_the_spectrum_s():
    frequencies, power, series = spectra(5, seeds=8)
    shown = (frequencies > 0) & (frequencies < 8)
    expected = engine.wind_spectrum(frequencies, 5)
    assert np.mean(series**2) == pytest.approx(expected[shown].sum() / PERIOD, rel=0.12)
    high = (frequencies > 0.5) & (frequencies < 8)
    slope = np.polyfit(np.log(frequencies[high]), np.log(power[high]), 1)[0]
    assert slope == pytest.approx(-5 / 3, abs=0.03)
    ratio = power[shown] / expected[shown]
    assert ratio.mean() == pytest.approx(1, abs=4 / np.sqrt(8 * shown.sum()))


def test_there_is_no_mean_and_nothing_above_the_cutoff():
    frequencies, power, _ = spectra(5, seeds=2)
    assert power[0] < 1e-20
    assert power[frequencies > 8.01].max() < 1e-20


def test_seeds_are_independent():
    times = np.arange(0, PERIOD, 0.1)
    one, two = (stillwater.Wind().series(times, seed=seed) for seed in (1, 2))
    assert abs(np.corrcoef(one, two)[0, 1]) < 0.35
    assert np.array_equal(one, stillwater.Wind().series(times, seed=1))


def test_no_wind_is_exactly_still():
    assert not stillwater.Wind(speed=0).series(np.arange(10.0)).any()


def test_a_series_closes_over_its_loop():
    times = np.arange(0, 4, 0.25)
    wind = stillwater.Wind()
    first, second = (wind.series(times + late, seed=3, loop_seconds=4) for late in (0, 4))
    assert np.array_equal(first, second)
    assert first.std() > 0


@pytest.mark.parametrize("frames", [48, 101, 24 * 300])
def test_a_moment_one_loop_later_has_the_same_bytes(frames):
    noise = engine.TurbulenceNoise(1)
    for frame in (1, 7, 30.5):
        values = {
            engine.turbulence(noise, engine.Moment(frame=frame + turns * frames, loop_frames=frames, first_frame=1))
            for turns in (-1, 0, 1, 5)
        }
        assert len(values) == 1


def test_a_longer_wind_keeps_the_noise():
    """A change of speed changes the strength of each wave, never its phase: so nothing jumps."""
    times = np.linspace(0, 20, 200)
    calm, rough = (stillwater.Wind(speed=speed).series(times, seed=4) for speed in (5, 5.01))
    assert np.abs(calm - rough).max() < 0.005 * np.abs(calm).max()


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"speed": -1}, "wind.speed: -1 is not between 0 and 40 (m/s)"),
        ({"speed": float("nan")}, "wind.speed: nan is not between 0 and 40 (m/s)"),
        ({"direction": 1e6}, r"wind.direction: 1e+06 is not between -36000 and 36000 (degrees)"),
        ({"gusts": 1.5}, "wind.gusts: 1.5 is not between 0 and 1"),
        ({"gust_size": 0}, "wind.gust_size: 0 is not above 0 (of the picture's width)"),
    ],
)
def test_what_no_wind_can_be_is_refused(given, sentence):
    with pytest.raises(stillwater.BadInput) as refused:
        stillwater.Wind(**given)
    assert str(refused.value) == sentence


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"frame": float("inf")}, "frame: inf is not between -1e+09 and 1e+09"),
        ({"fps": 0}, "fps: 0 is not above 0"),
        ({"loop_frames": -1}, "loop_frames: -1 is not between 0 and 1e+09"),
        ({"loop_travel": (float("nan"), 0)}, "loop_travel: nan is not a finite number"),
        ({"wind": engine.Wind(travel=(0, float("inf")))}, "wind.travel: inf is not a finite number"),
    ],
)
def test_what_no_moment_can_be_is_refused(given, sentence):
    with pytest.raises(stillwater.BadInput) as refused:
        engine.check_moment(engine.Moment(**given))
    assert str(refused.value) == sentence
