"""The figures of films: the same film is no way off, and each sees what it is there for."""

import film_figures as figures
import numpy as np
import pytest
from scipy.ndimage import gaussian_filter, shift

FRAMES, HEIGHT, WIDTH = 24, 64, 80
MASK = np.ones((HEIGHT, WIDTH), bool)


def running(speed, size=1.5, seed=0):
    """Noise that runs to the right, and is another one after some frames."""
    rng = np.random.default_rng(seed)
    noise = gaussian_filter(rng.normal(size=(HEIGHT, WIDTH)), size, mode="wrap")
    film = [shift(noise, (0, speed * t), order=1, mode="grid-wrap") for t in range(FRAMES)]
    return np.array(film, np.float32) / noise.std()


@pytest.mark.parametrize("off", [figures.spectrum_off, figures.speeds_off, figures.bands_off])
def test_a_film_is_like_itself(off):
    assert off(running(1), running(1), MASK) < 1e-6


def test_a_slower_film_has_another_rhythm_and_speed():
    fast, slow = running(2), running(0.5)
    assert figures.spectrum_off(slow, fast, MASK) > 3
    assert figures.speeds_off(slow, fast, MASK) == pytest.approx(1.5, abs=0.3)


def test_a_coarser_film_has_other_bands():
    assert figures.bands_off(running(1, 3), running(1, 1.5), MASK) > 3 * figures.bands_off(running(1, 1.5, 1), running(1, 1.5), MASK)


def test_what_stays_at_its_place_is_stuck():
    still = np.repeat(running(0)[:1], FRAMES, axis=0)
    assert figures.stuck(still, MASK) == pytest.approx(1) and abs(figures.stuck(running(2), MASK)) < 0.2


def test_only_the_masked_pixels_count():
    mask = MASK.copy()
    mask[:, 40:] = False
    other = running(1)
    other[:, :, 44:] = running(2, 3, 5)[:, :, 44:]
    assert figures.spectrum_off(other, running(1), mask) < 1e-6


def of_many_cells():
    """Two by three of them, each another."""
    film = np.tile(running(1), (1, 2, 2))
    return film + np.linspace(0, 1, film.shape[2], dtype=np.float32), np.ones(film.shape[1:], bool)


def test_a_grid_is_told_from_the_picture_s_own_differences():
    film, mask = of_many_cells()
    assert figures.grid(film, film[0], mask) == pytest.approx(1, abs=0.1)
    checks = np.kron([[0, 1, 0], [1, 0, 1]], np.ones((64, 54)))[:, :160]
    assert figures.grid(film + checks, film[0], mask) > 1.5


def test_what_flickers_is_told():
    film, mask = of_many_cells()
    assert figures.flicker(film, film, mask) == pytest.approx(1)
    assert figures.flicker(film + 0.2 * (np.arange(len(film)) % 2)[:, None, None], film, mask) > 2
