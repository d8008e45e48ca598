"""Bayesian matting, and the clusters of colours that it stands on."""

import numpy as np
import pytest
import stillwater
from stillwater import _stillwater as engine


def scene(noise, height=40, width=60, seed=3):
    """A ramp of alpha between two colours, known at both sides."""
    rng = np.random.default_rng(seed)
    x = np.mgrid[:height, :width][1]
    alpha = np.clip((width * 0.65 - x) / (0.3 * width), 0, 1)[..., None]
    front = [0.9, 0.5, 0.2] + noise * rng.standard_normal((height, width, 3))
    back = [0.1, 0.3, 0.7] + noise * rng.standard_normal((height, width, 3))
    trimap = np.where(alpha[..., 0] >= 1, 1, np.where(alpha[..., 0] <= 0, 0, 0.5)).astype(np.float32)
    return (alpha * front + (1 - alpha) * back).astype(np.float32), alpha[..., 0], trimap


def test_flat_colours_give_the_truth():
    picture, truth, trimap = scene(0)
    assert np.abs(stillwater.matte(picture, trimap, "bayesian") - truth).max() < 0.01


def test_noisy_colours_give_nearly_the_truth():
    picture, truth, trimap = scene(0.03)
    assert np.abs(stillwater.matte(picture, trimap, "bayesian") - truth).mean() < 0.03


def test_each_pixel_takes_the_pair_of_colours_that_explains_it():
    """Two foreground colours, one above the other: both mix with the background to the right alpha."""
    picture, truth, trimap = scene(0.01)
    other = np.array([0.2, 0.8, 0.3]) - [0.9, 0.5, 0.2]
    picture[:20] += (truth[:20, :, None] * other).astype(np.float32)
    alpha = stillwater.matte(picture, trimap, "bayesian")
    assert np.abs(alpha - truth)[:20].mean() < 0.02 and np.abs(alpha - truth)[20:].mean() < 0.02


def test_what_is_known_stays_and_all_is_within_0_and_1():
    picture, _, trimap = scene(0.1)
    alpha = stillwater.matte(picture, trimap, "bayesian")
    assert np.array_equal(alpha[trimap != 0.5], trimap[trimap != 0.5])
    assert alpha.min() >= 0 and alpha.max() <= 1


def test_neighbourhoods_grow_until_they_hold_both():
    picture, _, trimap = scene(0.02)
    trimap[:] = 0.5
    trimap[0, 0], trimap[-1, -1] = 1, 0
    alpha = stillwater.matte(picture, trimap, "bayesian")
    assert alpha[20, :15].mean() > 0.9 and alpha[20, -15:].mean() < 0.1


def test_the_same_bytes_for_any_number_of_threads():
    picture, _, trimap = scene(0.05)
    alphas = []
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        alphas.append(stillwater.matte(picture, trimap, "bayesian"))
    engine.set_threads(0)
    assert np.array_equal(alphas[0], alphas[1]) and np.array_equal(alphas[0], alphas[2])


def test_it_can_be_cancelled():
    with pytest.raises(stillwater.Cancelled):
        stillwater.matte(*scene(0.05)[::2], "bayesian", progress=lambda phase, share: share == 0)


def clusters(colours, weights=None, **options):
    given = engine.ClusterOptions()
    for name, value in options.items():
        setattr(given, name, value)
    weights = np.ones(len(colours)) if weights is None else weights
    return engine.colour_clusters(np.asarray(colours, np.float32)[:, None], list(weights), given)


def test_colours_in_two_places_are_two_clusters():
    rng = np.random.default_rng(0)
    places = np.array([[0.2, 0.2, 0.8], [0.8, 0.3, 0.1]])
    colours = np.repeat(places, 50, axis=0) + 0.02 * rng.standard_normal((100, 3))
    found = sorted((tuple(mean) for mean, _ in clusters(rng.permutation(colours))), reverse=True)
    assert np.allclose(found, places[::-1], atol=0.02)


def test_one_cluster_is_the_weighted_mean_and_covariance():
    rng = np.random.default_rng(1)
    colours, weights = 0.5 + 0.02 * rng.standard_normal((60, 3)), rng.random(60)
    ((mean, covariance),) = clusters(colours, weights, noise=1e-4)
    assert np.allclose(mean, np.average(colours, axis=0, weights=weights), atol=1e-6)
    assert np.allclose(covariance, np.cov(colours.T, aweights=weights, ddof=0) + 1e-4 * np.eye(3), atol=1e-6)


def test_there_are_never_more_than_asked_for():
    assert len(clusters(np.random.default_rng(2).random((200, 3)), most=3)) == 3


def test_colours_without_weight_are_left_out():
    assert clusters(np.random.default_rng(2).random((5, 3)), np.zeros(5)) == []
