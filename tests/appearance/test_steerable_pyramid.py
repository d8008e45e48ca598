"""The steerable pyramid: leads back for any size, keeps energy, can be steered, and is the one that others publish."""

import numpy as np
import pytest
import stillwater
from pyrtools.pyramids import SteerablePyramidFreq
from stillwater import _stillwater as engine
from stillwater.appearance import Pyramid

SIZES = [(64, 64), (96, 128), (100, 72), (63, 75), (17, 23), (9, 200)]


def noise(shape, seed=0):
    return np.random.default_rng(seed).random(shape).astype(np.float32)


@pytest.mark.parametrize("shape", [*SIZES, (1, 1), (1, 7), (13, 1), (512, 31)])
def test_the_transform_leads_back_times_the_number_of_pixels(shape):
    image = noise(shape)
    np.testing.assert_allclose(engine.fft_there_and_back(image) / image.size, image, atol=1e-6)


@pytest.mark.parametrize("orientations", [1, 2, 4, 5])
@pytest.mark.parametrize("shape", SIZES)
def test_there_and_back(shape, orientations):
    image = noise(shape)
    for scales in (1, 2, 3):
        pyramid = stillwater.steerable_pyramid(image, scales, orientations)
        np.testing.assert_allclose(stillwater.collapse_pyramid(pyramid), image, atol=1e-5)


def test_a_complex_pyramid_leads_back_too():
    image = noise((61, 84))
    pyramid = stillwater.steerable_pyramid(image, 3, 4, complex=True)
    assert pyramid.bands[0][0].dtype == np.complex64
    np.testing.assert_allclose(stillwater.collapse_pyramid(pyramid), image, atol=1e-5)


def test_memory_that_is_not_aligned_serves_as_well():
    whole = noise(64 * 64 + 1)
    shifted = whole[1:].reshape(64, 64)
    given, same = (stillwater.steerable_pyramid(image, 2, 2) for image in (shifted, shifted.copy()))
    np.testing.assert_array_equal(given.bands[1][1], same.bands[1][1])


@pytest.mark.parametrize("order", [0, 1, 2, 3, 5])
@pytest.mark.parametrize("shape", [(64, 64), (96, 128), (100, 72)])
def test_coefficients_are_those_of_pyrtools(shape, order):
    image = noise(shape)
    ours = stillwater.steerable_pyramid(image, 3, order + 1, complex=order > 0)
    theirs = SteerablePyramidFreq(image.astype(float), 3, order, is_complex=order > 0).pyr_coeffs
    np.testing.assert_allclose(ours.highpass, theirs["residual_highpass"], atol=1e-4)
    np.testing.assert_allclose(ours.lowpass, theirs["residual_lowpass"], atol=1e-4)
    for scale in range(3):
        for band in range(order + 1):
            np.testing.assert_allclose(ours.bands[scale][band], theirs[scale, band], atol=1e-4)


@pytest.mark.parametrize("shape", [(64, 96), (128, 80)])
def test_a_tight_frame_keeps_the_energy(shape):
    """Parseval; the square of a coefficient of level s counts a 4^s-th."""
    image = noise(shape).astype(float) - 0.5
    pyramid = stillwater.steerable_pyramid(image, 3, 4)
    parts = [pyramid.highpass, *[band for scale in pyramid.bands for band in scale], pyramid.lowpass]
    energy = sum((part.astype(float) ** 2).sum() * part.size / image.size for part in parts)
    assert energy == pytest.approx((image**2).sum(), rel=1e-5)


def test_two_orientations_steer_to_any_other():
    """First derivatives: a grating across angle a answers as cos(a - angle of the band)."""
    y, x = np.mgrid[:128, :128]
    for kx, ky in [(12, 0), (9, 8), (0, 12), (-8, 9)]:
        grating = np.cos(2 * np.pi * (kx * x + ky * y) / 128)
        across, down = (band.std() for band in stillwater.steerable_pyramid(grating, 3, 2).bands[1])
        angle = np.arctan2(ky, kx)
        assert [across, down] == pytest.approx(np.hypot(across, down) * np.abs([np.cos(angle), np.sin(angle)]), abs=1e-4)


def test_a_complex_band_of_a_grating_has_an_even_magnitude():
    _, x = np.mgrid[:64, :128]
    band = stillwater.steerable_pyramid(np.cos(2 * np.pi * 24 * x / 128), 3, 4, complex=True).bands[0][0]
    assert np.abs(band).std() < 1e-4 * np.abs(band).mean()


def test_threads_do_not_change_a_byte():
    image = noise((90, 77))
    results = []
    for threads in (1, 3):
        engine.set_threads(threads)
        pyramid = stillwater.steerable_pyramid(image, 3, 4)
        results.append((pyramid.bands[0][2].tobytes(), stillwater.collapse_pyramid(pyramid).tobytes()))
    engine.set_threads(0)
    assert results[0] == results[1]


@pytest.mark.parametrize(
    "arguments, sentence",
    [
        ({"scales": 0}, "scales: 0 is not between 1 and 12"),
        ({"scales": 5}, "scales: 5 is not a number of halvings that leaves 2 pixels a side of 40 x 32"),
        ({"orientations": 17}, "orientations: 17 is not between 1 and 16"),
        ({"orientations": 1, "complex": True}, "orientations: 1 is not at least 2, which a complex pyramid needs"),
    ],
)
def test_what_cannot_be_is_refused(arguments, sentence):
    with pytest.raises(stillwater.BadInput, match=sentence):
        stillwater.steerable_pyramid(noise((32, 40)), **arguments)


def test_bands_that_do_not_belong_together_are_refused():
    pyramid = stillwater.steerable_pyramid(noise((32, 40)), 2, 2)
    with pytest.raises(stillwater.BadInput, match="bands: 3 x 3 is not this band's size, 40 x 32"):
        stillwater.collapse_pyramid(Pyramid(pyramid.highpass, [[np.ones((3, 3))] * 2] * 2, pyramid.lowpass))
    with pytest.raises(stillwater.BadInput, match="bands: not the same number of orientations at every scale"):
        stillwater.collapse_pyramid(Pyramid(pyramid.highpass, [pyramid.bands[0], pyramid.bands[1][:1]], pyramid.lowpass))
