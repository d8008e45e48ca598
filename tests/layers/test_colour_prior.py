"""What colours alone say of alpha: pairs of samples, and how far they are trusted."""

import numpy as np
import pytest
from stillwater import _stillwater as engine

FRONT, BACK = np.array([0.9, 0.5, 0.2]), np.array([0.1, 0.3, 0.7])


def ramp(height=40, width=60, noise=0.0):
    """Alpha from 1 to 0 between two flat colours, known at both sides."""
    x = np.mgrid[:height, :width][1]
    truth = np.clip((width * 0.65 - x) / (0.3 * width), 0, 1)
    picture = truth[..., None] * FRONT + (1 - truth[..., None]) * BACK
    picture += noise * np.random.default_rng(1).standard_normal(picture.shape)
    trimap = np.where(truth >= 1, 1, np.where(truth <= 0, 0, 0.5)).astype(np.float32)
    return np.dstack([picture, np.ones_like(truth)]).astype(np.float32), truth, trimap


def test_flat_colours_are_found():
    picture, _, trimap = ramp()
    front, back, misfit = engine.sample_colours(picture, trimap)
    unknown = trimap == 0.5
    assert np.allclose(front[unknown][:, :3], FRONT, atol=1e-5) and np.allclose(back[unknown][:, :3], BACK, atol=1e-5)
    assert misfit[unknown].max() < 1e-5
    assert np.all(front[~unknown] == 0) and np.all(front[unknown][:, 3] == 1)


def test_of_several_colours_those_that_explain_a_pixel_are_found():
    picture, truth, trimap = ramp()
    other = np.array([0.2, 0.9, 0.3])
    picture[:20, :, :3] += (truth[:20, :, None] * (other - FRONT)).astype(np.float32)
    front, _, misfit = engine.sample_colours(picture, trimap, iterations=8)
    mixed = (trimap == 0.5) & (truth > 0.2)
    assert np.abs(front[:20][mixed[:20]][:, :3] - other).max(axis=1).mean() < 0.05
    assert np.abs(front[20:][mixed[20:]][:, :3] - FRONT).max(axis=1).mean() < 0.05
    assert misfit[mixed].mean() < 0.01


def test_alpha_is_that_of_the_mix_and_trusted_where_colours_fit():
    picture, truth, trimap = ramp()
    alpha, weight = engine.colour_prior(picture, trimap)
    assert np.abs(alpha - truth).max() < 1e-4
    assert weight[trimap == 0.5].min() > 0.5e-3 and np.all(weight[trimap != 0.5] == 0)


def test_a_colour_that_is_neither_is_not_trusted():
    picture, _, trimap = ramp()
    picture[10:15, 28:32, :3] = [0, 1, 0]
    assert np.all(engine.colour_prior(picture, trimap)[1][11:14, 29:31] == 0)


def test_colours_that_are_alike_are_trusted_less():
    picture, _, trimap = ramp()
    alike = picture.copy()
    alike[..., :3] = 0.5 + 0.1 * (picture[..., :3] - 0.5)
    unknown = trimap == 0.5
    assert engine.colour_prior(alike, trimap)[1][unknown].mean() < 0.3 * engine.colour_prior(picture, trimap)[1][unknown].mean()


def test_an_alpha_that_does_not_follow_the_picture_is_trusted_less():
    """The same grey is a mix at one pixel and a colour of its own at the next: noise decides."""
    noisy, _, trimap = ramp(noise=0.1)
    calm, _, _ = ramp()
    unknown = trimap == 0.5
    assert engine.colour_prior(noisy, trimap)[1][unknown].mean() < 0.5 * engine.colour_prior(calm, trimap)[1][unknown].mean()


def test_thin_scribbles_say_nothing_of_colours_far_away():
    picture, _, trimap = ramp(120, 180)
    scribbles = np.full_like(trimap, 0.5)
    scribbles[40:80, 10], scribbles[40:80, 170] = 1, 0
    assert engine.colour_prior(picture, scribbles)[1].max() == 0
    assert engine.colour_prior(picture, trimap)[1].max() > 0


@pytest.mark.parametrize("threads", [2, 5])
def test_the_same_bytes_for_any_number_of_threads(threads):
    picture, _, trimap = ramp(noise=0.05)
    engine.set_threads(1)
    one = engine.colour_prior(picture, trimap)
    engine.set_threads(threads)
    many = engine.colour_prior(picture, trimap)
    engine.set_threads(0)
    assert np.array_equal(one[0], many[0]) and np.array_equal(one[1], many[1])
