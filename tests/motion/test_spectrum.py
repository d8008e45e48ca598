"""The four wave spectra against their closed formulas, integrated by scipy."""

import numpy as np
import pytest
from scipy.integrate import quad
from stillwater import _stillwater as engine

G = 9.81
FETCH, DEPTH = 100.0, 200.0


def density(spectrum, k, speed=5.0, fetch=FETCH, depth=DEPTH):
    return engine.radial_density(spectrum, speed, fetch, depth, k)


def variance(spectrum, **sea):
    """Integral over all wave numbers, in their logarithm."""
    return quad(lambda u: density(spectrum, np.exp(u), **sea) * np.exp(u), np.log(1e-5), np.log(1e4), limit=500)[0]


def pierson_moskowitz(omega, speed):
    peak = 0.87 * G / speed
    return 0.0081 * G**2 / omega**5 * np.exp(-1.291 * (peak / omega) ** 4)


def jonswap(omega, speed, fetch):
    alpha = 0.076 * (speed**2 / (fetch * 1e3 * G)) ** 0.22
    peak = 22 * (G**2 / (speed * fetch * 1e3)) ** (1 / 3)
    sigma = np.where(omega <= peak, 0.07, 0.09)
    r = np.exp(-((omega - peak) ** 2) / (2 * sigma**2 * peak**2))
    return alpha * G**2 / omega**5 * np.exp(-1.25 * (peak / omega) ** 4) * 3.3**r


@pytest.mark.parametrize("speed", [2.0, 5.0, 12.0])
def test_significant_height_of_a_grown_sea(speed):
    closed = 4 * np.sqrt(0.0081 * G**2 / (4 * 1.291 * (0.87 * G / speed) ** 4))
    if speed == 5:
        assert closed == pytest.approx(0.53, abs=0.005)
    for spectrum in ("phillips", "pierson-moskowitz"):
        assert 4 * np.sqrt(variance(spectrum, speed=speed)) == pytest.approx(closed, rel=1e-4)


@pytest.mark.parametrize("k", [0.05, 0.1, 0.32, 1.0, 10.0])
def test_densities_are_the_published_ones_over_wave_numbers(k):
    omega = np.sqrt(G * k)
    jacobian = G / (2 * omega)
    assert density("pierson-moskowitz", k) == pytest.approx(pierson_moskowitz(omega, 5.0) * jacobian, rel=1e-9)
    assert density("jonswap", k) == pytest.approx(float(jonswap(omega, 5.0, FETCH)) * jacobian, rel=1e-9)
    length = 25 / G  # over the plane exp(-1 / (k L)^2) / k^4
    shape = np.exp(-1 / (k * length) ** 2) / k**3
    assert density("phillips", k) / shape == pytest.approx(density("phillips", 3.0) / (np.exp(-1 / (3 * length) ** 2) / 27))


@pytest.mark.parametrize("depth", [1.0, 4.0, 15.0])
def test_shallow_water_is_jonswap_times_kitaigorodskii_s_factor(depth):
    for k in (0.05, 0.3, 2.0):
        omega = np.sqrt(G * k * np.tanh(k * depth))
        step = 1e-6 * k
        jacobian = (np.sqrt(G * (k + step) * np.tanh((k + step) * depth)) - omega) / step
        w = omega * np.sqrt(depth / G)
        factor = w**2 / 2 if w <= 1 else 1 - (2 - w) ** 2 / 2 if w < 2 else 1
        assert density("tma", k, depth=depth) == pytest.approx(float(jonswap(omega, 5.0, FETCH)) * factor * jacobian, rel=1e-4)


def test_deep_water_makes_tma_jonswap():
    for k in (0.1, 1.0, 5.0):
        assert density("tma", k, depth=5000.0) == pytest.approx(density("jonswap", k), rel=1e-9)


def test_a_longer_fetch_raises_higher_waves():
    heights = [variance("jonswap", fetch=fetch) for fetch in (1.0, 10.0, 100.0)]
    assert heights == sorted(heights)


def test_no_wind_no_waves():
    for spectrum in ("phillips", "pierson-moskowitz", "jonswap", "tma"):
        assert density(spectrum, 1.0, speed=0.0) == 0
        assert density(spectrum, 1e-3, speed=0.01) >= 0


def test_directions_add_up_to_one_and_run_with_the_wind():
    angles = (np.arange(3600) + 0.5) * 2 * np.pi / 3600
    spread = np.array([engine.spreading(np.cos(angle)) for angle in angles])
    assert spread.sum() * 2 * np.pi / 3600 == pytest.approx(1, abs=1e-6)
    assert not spread[np.cos(angles) <= 0].any()
    ahead = np.cos(angles) > 0
    assert np.allclose(spread[ahead] / spread.max(), np.cos(angles[ahead]) ** 2, atol=1e-5)


def test_an_unknown_spectrum_is_refused():
    with pytest.raises(engine.BadInput, match='^spectrum: "beach" is not phillips, pierson-moskowitz, jonswap or tma$'):
        density("beach", 1.0)
