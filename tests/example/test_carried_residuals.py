"""Residuals carried along a flow: any moment alone, endless, in loops; and the contrast that a picture asks for."""

import numpy as np
import pytest
from clips import HEIGHT, WIDTH
from scipy.ndimage import gaussian_filter
from stillwater import _stillwater as engine

FRAMES = 24
RIGHT = np.full((HEIGHT, WIDTH, 2), (2, 0), np.float32)


def noise(frames=FRAMES, size=1.5, seed=1):
    """Residuals; the first is 0, as where a clip begins at its average."""
    rng = np.random.default_rng(seed)
    grey = np.array([gaussian_filter(rng.normal(size=(HEIGHT, WIDTH)), size) for _ in range(frames)])
    grey[0] = 0
    return np.repeat(grey[..., None] / grey[1:].std(), 3, axis=3).astype(np.float16)


def carried(residuals=None, velocity=RIGHT, **how):
    own = engine.identical_map((WIDTH, HEIGHT))
    return engine.CarriedResiduals(noise() if residuals is None else residuals, own, velocity, **how)


def test_one_residual_is_carried_and_gone_after_its_life():
    residuals = np.zeros_like(noise())
    residuals[5] = noise()[1]
    film = carried(residuals, life=8, fade=0, endless=False)
    for age in (0, 3, 7):
        got = film.at(5.0 + age)[:, 2 * age + 4 : -4, 0]
        np.testing.assert_allclose(got, residuals[5, :, 4 : WIDTH - 2 * age - 4, 0], atol=0.01)
    assert np.abs(film.at(13.0)).max() == 0 and np.abs(film.at(4.0)).max() == 0
    half = film.at(4.5)[4:-4, 4:-4]  # half of it has come, carried half a step back
    assert half.std() == pytest.approx(0.5 * film.at(5.0)[4:-4, 4:-4].std(), rel=0.05)
    np.testing.assert_allclose(half[:, 20:80, 0], 0.5 * film.at(5.0)[4:-4, 25:85, 0], atol=0.05)


def test_faded_it_goes_slowly():
    residuals = np.zeros_like(noise())
    residuals[5] = noise()[1]
    film = carried(residuals, life=16, fade=0.5, endless=False)
    strength = [np.std(film.at(5.0 + age)[:, 44:-4]) for age in range(17)]
    np.testing.assert_allclose(strength[:9], strength[0], rtol=0.03)
    assert all(a > b for a, b in zip(strength[8:], strength[9:], strict=False)) and strength[16] == 0


def test_any_moment_stands_alone():
    film = carried()
    moments = [3.0, 17.25, 40.0, 3.5, 100.0]
    alone = [carried().at(moment) for moment in moments]
    assert all(np.array_equal(film.at(m), one) for m, one in zip(reversed(moments), reversed(alone), strict=True))


def test_it_is_endless_with_the_clip_s_own_period():
    film = carried()
    assert np.array_equal(film.at(20.25), film.at(20.25 + FRAMES - 1))
    assert np.abs(film.at(500.0)).std() > 0.1
    ending = carried(endless=False)
    assert np.abs(ending.at(500.0)).max() == 0


@pytest.mark.parametrize("period", [5, 23, 40, 100])
def test_a_loop_has_its_own_period(period):
    film = carried(period=period)
    for moment in (0.0, 7.5, 31.0):
        assert np.array_equal(film.at(moment), film.at(moment + period))
        assert np.array_equal(film.at(moment), film.at(moment - period))
    assert not np.array_equal(film.at(2.0), film.at(3.0))


def test_a_loop_longer_than_the_clip_is_not_the_clip_twice():
    film = carried(period=46)
    assert not np.allclose(film.at(30.0), film.at(30.0 + 23), atol=0.1)


@pytest.mark.parametrize("fade", [0, 0.5])
def test_its_strength_is_steady_over_the_joint(fade):
    film = carried(fade=fade)
    strength = [film.at(float(moment)).std() for moment in range(16, 64)]
    assert np.std(strength) < 0.05 * np.mean(strength)


def test_moments_between_steps_run_smoothly():
    film = carried(life=12)
    steps = [np.abs(film.at(20 + k / 8 + 1 / 8) - film.at(20 + k / 8)).mean() for k in range(16)]
    assert max(steps) < 2 * min(steps)


def test_any_number_of_threads_gives_the_same_bytes():
    results = []
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        results.append(carried().at(21.5))
    assert np.array_equal(results[0], results[1]) and np.array_equal(results[0], results[2])


@pytest.mark.parametrize(
    ("how", "sentence"),
    [
        ({"life": 0}, "life: 0 is not between 1 and 1000"),
        ({"fade": 1.5}, "fade: 1.5 is not between 0 and 1"),
        ({"period": -1}, "period: -1 is not between 0"),
        ({"velocity": RIGHT[:-1]}, "velocity: not of the picture's size"),
    ],
)
def test_bad_parameters_are_refused(how, sentence):
    with pytest.raises(ValueError, match=sentence):
        carried(**how)


def test_moments_that_are_none_are_refused():
    with pytest.raises(ValueError, match="moment"):
        carried().at(float("nan"))


# ---- contrast


def colours(grey):
    return np.stack([grey, 0.5 * grey, -0.25 * grey], axis=-1).astype(np.float32)


def luma(image):
    return image @ np.array([0.2126, 0.7152, 0.0722], np.float32)


def test_differences_get_the_picture_s_strength_place_by_place():
    rng = np.random.default_rng(2)
    strong = np.where(np.arange(WIDTH) < WIDTH // 2, 0.4, 0.1)
    own = colours(rng.normal(size=(HEIGHT, WIDTH)) * strong)
    film = [np.repeat(rng.normal(size=(HEIGHT, WIDTH, 1)), 3, axis=2).astype(np.float32) for _ in range(6)]
    slope, mean, hold = engine.local_contrast(own, film, np.ones((HEIGHT, WIDTH), np.float32), 8.0)
    made = mean + slope * luma(film[0])[..., None]
    deviation = luma(film[0]).std()
    assert hold.mean() == pytest.approx(2.5 * deviation, rel=0.05)
    for part in (slice(10, 40), slice(90, 118)):
        for channel in range(3):
            assert made[:, part, channel].std() == pytest.approx(own[:, part, channel].std(), rel=0.15)


def test_they_get_its_colours():
    rng = np.random.default_rng(2)
    own = colours(0.2 * rng.normal(size=(HEIGHT, WIDTH)))
    film = [rng.normal(size=(HEIGHT, WIDTH, 3)).astype(np.float32)]
    slope, _, _ = engine.local_contrast(own, film, np.ones((HEIGHT, WIDTH), np.float32), 10.0)
    np.testing.assert_allclose(slope[..., 1] / slope[..., 0], 0.5, atol=1e-3)
    np.testing.assert_allclose(slope[..., 2] / slope[..., 0], -0.25, atol=1e-3)


def test_what_is_not_weighed_does_not_count():
    rng = np.random.default_rng(2)
    own, film = colours(0.2 * rng.normal(size=(HEIGHT, WIDTH))), [rng.normal(size=(HEIGHT, WIDTH, 3)).astype(np.float32)]
    weight = np.ones((HEIGHT, WIDTH), np.float32)
    weight[:, 64:] = 0
    other = own.copy()
    other[:, 64:] = 9
    slopes = [engine.local_contrast(each, film, weight, 6.0)[0][:, :40] for each in (own, other)]
    np.testing.assert_allclose(*slopes, rtol=0.1, atol=1e-3)


def test_a_film_without_differences_gets_none():
    own = colours(np.ones((HEIGHT, WIDTH)))
    slope, mean, _ = engine.local_contrast(own, [np.zeros_like(own)], np.ones((HEIGHT, WIDTH), np.float32), 6.0)
    assert (slope == 0).all()
    np.testing.assert_allclose(mean, own, atol=1e-5)


def test_bad_contrast_is_refused():
    own, weight = colours(np.ones((HEIGHT, WIDTH))), np.ones((HEIGHT, WIDTH), np.float32)
    for arguments, sentence in [
        ((own, [], weight, 6.0), "moments: none is not at least one"),
        ((own, [own], weight, 0.0), "around: 0 is not above 0"),
        ((own, [own[:-1]], weight, 6.0), "moments"),
        ((own, [own], weight[:-1], 6.0), "weight"),
    ]:
        with pytest.raises(ValueError, match=sentence):
            engine.local_contrast(*arguments)
