"""The colours that a picture is mixed from: no old background in the foreground, and the other way round."""

import numpy as np
import pytest
import scipy.ndimage
import stillwater
from stillwater import _stillwater as engine


def smooth(shape, seed):
    noise = np.random.default_rng(seed).random((*shape, 3))
    texture = np.stack([scipy.ndimage.gaussian_filter(noise[..., c], 15) for c in range(3)], axis=2)
    return (texture - texture.min()) / np.ptp(texture)


def composite(height=150, width=200):
    front, back = smooth((height, width), 1), smooth((height, width), 2)
    y, x = np.mgrid[:height, :width]
    wavy = height / 3 + 6 * np.sin(12 * np.arctan2(y - height / 2, x - width / 2))
    alpha = np.clip((wavy - np.hypot(y - height / 2, x - width / 2)) / 10 + 0.5, 0, 1)
    return alpha[..., None] * front + (1 - alpha[..., None]) * back, alpha, front, back


def test_both_are_within_two_percent_of_the_truth():
    picture, alpha, front, back = composite()
    found_front, found_back = stillwater.foreground(picture, alpha)
    assert np.abs(found_front - front)[alpha > 0.1].mean() < 0.02
    assert np.abs(found_back - back)[alpha < 0.9].mean() < 0.02


def test_they_mix_to_the_picture():
    picture, alpha, _, _ = composite()
    front, back = stillwater.foreground(picture, alpha)
    mixed = alpha[..., None] * front + (1 - alpha[..., None]) * back
    assert np.abs(mixed - picture).max() < 0.02


def test_no_halo_of_a_flat_background_travels_along():
    _, alpha, _, _ = composite()
    picture = alpha[..., None] * np.array([0.1, 0.2, 0.1]) + (1 - alpha[..., None]) * np.array([0.9, 0.9, 1.0])
    front, back = stillwater.foreground(picture, alpha)
    assert np.abs(front - [0.1, 0.2, 0.1])[alpha > 0.05].mean() < 0.01
    assert np.abs(back - [0.9, 0.9, 1.0])[alpha < 0.95].mean() < 0.01


@pytest.mark.parametrize("value", [0.0, 1.0])
def test_a_hard_matte_leaves_the_picture(value):
    picture = composite()[0]
    colours = stillwater.foreground(picture, np.full(picture.shape[:2], value))
    assert np.abs(colours[0 if value else 1] - picture).max() < 1e-4


def test_values_above_1_stay():
    picture, alpha, _, _ = composite()
    front, _ = stillwater.foreground(4 * picture, np.ones_like(alpha))
    assert np.allclose(front, 4 * picture, atol=1e-3)


@pytest.mark.parametrize("shape", [(1, 1), (1, 30), (30, 1), (2, 3)])
def test_small_pictures(shape):
    front, back = stillwater.foreground(np.full((*shape, 3), 0.6), np.full(shape, 0.5))
    assert front.shape == back.shape == (*shape, 3)
    assert np.allclose(0.5 * front + 0.5 * back, 0.6, atol=0.02)


def test_the_same_bytes_for_any_number_of_threads():
    picture, alpha, _, _ = composite()
    found = []
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        found.append(np.stack(stillwater.foreground(picture, alpha)))
    engine.set_threads(0)
    assert np.array_equal(found[0], found[1]) and np.array_equal(found[0], found[2])


@pytest.mark.parametrize(
    "picture, alpha, sentence",
    [
        (np.zeros((4, 5, 3)), np.zeros((4, 6)), "alpha: 6 x 4 is not the size of the picture, 5 x 4"),
        (np.zeros((4, 5, 3)), np.full((4, 5), 1.25), r"alpha\[0, 0\]: 1.25 is not between 0 and 1"),
        (np.full((4, 5, 3), np.inf), np.zeros((4, 5)), r"picture\[0, 0\]: inf is not a finite number"),
    ],
)
def test_what_does_not_fit_is_a_sentence(picture, alpha, sentence):
    with pytest.raises(ValueError, match=sentence):
        stillwater.foreground(picture, alpha)


@pytest.mark.parametrize("option", ["regularization", "gradient_weight", "small_iterations", "big_iterations", "small_size"])
def test_options_out_of_range(option):
    options = engine.ForegroundOptions()
    setattr(options, option, 0)
    with pytest.raises(ValueError, match=f"{option}: 0 is not "):
        engine.foreground_and_background(np.zeros((4, 5, 4)), np.zeros((4, 5)), options)


def test_it_can_be_cancelled():
    picture, alpha, _, _ = composite()
    with pytest.raises(stillwater.Cancelled):
        stillwater.foreground(picture, alpha, progress=lambda phase, share: False)
