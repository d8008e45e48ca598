"""The tile of waves: its heights, its dispersion, its direction, its loop, for any way of computing it."""

import os
import subprocess
import sys

import numpy as np
import pytest
import stillwater
from stillwater import Wind, wave_heights
from stillwater import _stillwater as engine

G = 9.81
SPECTRA = ["phillips", "pierson-moskowitz", "jonswap", "tma"]


def peak_length(spectrum, speed=5.0):
    k = np.exp(np.linspace(np.log(1e-3), np.log(100), 4000))
    return 2 * np.pi / k[np.argmax([engine.radial_density(spectrum, speed, 100.0, 200.0, q) for q in k])]


@pytest.mark.parametrize("spectrum", SPECTRA)
def test_significant_height_is_the_spectrum_s(spectrum):
    tile = 10 * peak_length(spectrum)
    k = np.exp(np.linspace(np.log(1e-4), np.log(1e3), 20000))
    inside = k < np.pi / tile * 256
    density = np.array([engine.radial_density(spectrum, 5.0, 100.0, 200.0, q) for q in k])
    expected = 4 * np.sqrt(np.sum((density * k)[inside]) * np.log(k[1] / k[0]))
    variances = [np.var(wave_heights(0, tile=tile, spectrum=spectrum, seed=seed)) for seed in range(40)]
    assert 4 * np.sqrt(np.mean(variances)) == pytest.approx(expected, rel=0.03)


@pytest.mark.parametrize("depth", [None, 3.0])
def test_dispersion_is_read_back_from_space_and_time(depth):
    """A 3-D transform over a loop: all energy of a wave number stands at its own frequency, sqrt(g k) within half a step."""
    n, tile, seconds, steps = 16, 40.0, 32.0, 128
    spectrum = "phillips" if depth is None else "tma"
    volume = np.stack(
        [
            wave_heights(i * seconds / steps, tile=tile, resolution=n, spectrum=spectrum, depth=depth or 200.0, loop_seconds=seconds)
            for i in range(steps)
        ]
    )
    power = np.abs(np.fft.fftn(volume)) ** 2
    waves = np.fft.fftfreq(n) * n
    k = 2 * np.pi / tile * np.hypot(*np.meshgrid(waves, waves, indexing="ij"))
    omega = np.sqrt(G * k) if depth is None else np.sqrt(G * k * np.tanh(k * depth))
    step = 2 * np.pi / seconds
    strongest = power.max(0)
    seen = strongest > strongest.max() * 1e-9
    frequency = np.abs(np.fft.fftfreq(steps) * steps)[power.argmax(0)] * step
    assert seen.sum() > 100
    assert np.abs(frequency - omega)[seen].max() <= step / 2 * 1.001
    assert (strongest[seen] / power.sum(0)[seen]).min() > 0.49  # a wave and its mirror image share none of it with others


def test_without_a_loop_frequencies_are_not_rounded():
    """One wave number's phase advances by sqrt(g k) dt exactly, also a day later."""
    for start in (0.0, 86400.0):
        modes = [np.fft.fft2(wave_heights(start + dt, tile=60.0, resolution=32)) for dt in (0.0, 0.1)]
        for ky, kx in ((0, 3), (1, 4), (-2, 5)):
            turned = np.angle(modes[1][ky, kx] / modes[0][ky, kx])
            assert -turned == pytest.approx(0.1 * np.sqrt(G * 2 * np.pi / 60 * np.hypot(kx, ky)), abs=2e-4)


@pytest.mark.parametrize(("direction", "axis", "sign"), [(0, 1, 1), (180, 1, -1), (90, 0, 1), (270, 0, -1)])
def test_waves_run_with_the_wind(direction, axis, sign):
    """Correlation of the water with itself a little later is highest a little downwind."""
    wind = Wind(direction=direction)
    a, b = (wave_heights(t, tile=60.0, resolution=128, wind=wind) for t in (0.0, 0.15))
    shift = [float((np.roll(a, s * sign, axis) * b).mean()) for s in (-2, -1, 0, 1, 2)]
    assert shift.index(max(shift)) >= 3


def test_the_crests_lie_across_the_wind():
    along, across = (np.gradient(wave_heights(0, wind=Wind(direction=90)), axis=axis).var() for axis in (0, 1))
    assert along / across == pytest.approx(3, rel=0.25)  # of cos^2: the mean of cos^4 is 3 times that of cos^2 sin^2


def test_finer_tiles_have_the_same_long_waves():
    coarse, fine = (np.fft.fft2(wave_heights(2.0, resolution=n)) / n**2 for n in (32, 128))
    assert np.allclose(coarse[:12, :12], fine[:12, :12], atol=1e-6)


def test_another_wind_keeps_the_noise():
    weak, strong = (np.fft.fft2(wave_heights(0, wind=Wind(speed=speed)))[0, 3:20] for speed in (5, 5.5))
    assert np.allclose(np.angle(strong / weak), 0, atol=1e-3)
    assert (np.abs(strong) > np.abs(weak)).all()


def test_no_wind_is_flat_water():
    assert not wave_heights(3.0, wind=Wind(speed=0)).any()


def test_a_loop_closes():
    for seconds in (0.0, 1.7):
        first, second = (wave_heights(seconds + turn * 5.0, loop_seconds=5.0) for turn in (0, 1))
        assert np.abs(first - second).max() < 1e-6 * np.abs(first).max() + 1e-6


def test_seeds_give_other_water_and_the_same_seed_the_same_bytes():
    assert wave_heights(1.0, seed=4).tobytes() == wave_heights(1.0, seed=4).tobytes()
    assert abs(np.corrcoef(wave_heights(1.0, seed=4).ravel(), wave_heights(1.0, seed=5).ravel())[0, 1]) < 0.3


def test_threads_do_not_change_a_byte():
    answers = set()
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        answers.add(wave_heights(2.5, resolution=64).tobytes())
    engine.set_threads(0)
    assert len(answers) == 1


def test_the_plain_way_is_the_fast_way_within_a_thousandth():
    script = "import sys, stillwater; sys.stdout.buffer.write(stillwater.wave_heights(7.3).tobytes())"
    plain = subprocess.run(
        [sys.executable, "-c", script], env={**os.environ, "STILLWATER_CPU": "sse4.2"}, capture_output=True, timeout=60, check=True
    )
    fast = stillwater.wave_heights(7.3)
    assert np.abs(np.frombuffer(plain.stdout, np.float32).reshape(fast.shape) - fast).max() < 1e-3 * np.abs(fast).max()


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"tile": 0}, "tile: 0 is not between 0.001 and 2000 (m)"),
        ({"resolution": 100}, "resolution: 100 is not a power of two between 16 and 2048"),
        ({"fetch": 0}, "fetch: 0 is not above 0 (km)"),
        ({"depth": -1}, "depth: -1 is not above 0 (m)"),
        ({"seconds": float("inf")}, "seconds: inf is not a finite number"),
    ],
)
def test_what_is_no_water_is_refused(given, sentence):
    with pytest.raises(engine.BadInput) as refused:
        wave_heights(**{"seconds": 0.0, **given})
    assert str(refused.value) == sentence
