"""A clip taken apart: average, mean flow, residuals; put together again it is the clip."""

import numpy as np
import pytest
import stillwater
from clips import HEIGHT, WIDTH, boiling, carried, halves, turning
from stillwater import _stillwater as engine

INSIDE = (slice(16, -16), slice(16, -16))


def analysed(clip, flow="dense", quality="medium"):
    frames = halves(clip)
    return engine.analyse_clip(frames, flow, quality), frames


def reference_residuals(clip, velocity):
    """r_0 = D_0, r_i = D_i - W(D_{i-1}), by the module's own advection, which is tested by itself."""
    differences = clip - clip.mean(axis=0)
    back = [stillwater.advect(np.clip(d, -1, 1).astype(np.float32), velocity, 1)[..., :3] for d in differences]
    return np.array([differences[0], *(d - b for d, b in zip(differences[1:], back[:-1], strict=True))])


def whole(found, residuals):
    return stillwater.ClipAnalysis(found.average, found.velocity, residuals, found.energy, found.moving, 24, found.reach, found.explained)


def psnr(a, b):
    return -10 * np.log10(np.mean((a - b) ** 2))


def test_average_and_residuals_are_what_the_formulas_say():
    clip = carried((1.5, -0.5), 12)
    found, residuals = analysed(clip)
    np.testing.assert_allclose(found.average, clip.mean(axis=0), atol=3e-4)  # the clip is kept in half floats
    expected = reference_residuals(clip, found.velocity)
    np.testing.assert_allclose(residuals[(slice(None), *INSIDE)], expected[(slice(None), *INSIDE)], atol=1.5e-3)
    # what the flow brings from outside is the side's own pixel again
    differences = clip - clip.mean(axis=0)
    entering = residuals[1:, 40, 0] - (differences[1:, 40, 0] - differences[:-1, 40, 0])
    assert np.abs(entering).mean() < 0.02


@pytest.mark.parametrize(("velocity", "frames"), [((2.0, 0.0), 16), ((-1.2, 2.4), 16), ((0.3, -0.4), 64)])
@pytest.mark.parametrize(("flow", "off"), [("dense", 0.08), ("features", 0.15)])
def test_the_mean_flow_is_the_clip_s(velocity, frames, flow, off):
    """A clip that is so short that it hardly moves shows no flow: its average is the picture itself."""
    found, _ = analysed(carried(velocity, frames), flow)
    np.testing.assert_allclose(found.velocity[INSIDE].mean(axis=(0, 1)), velocity, atol=off)
    assert np.abs(found.velocity[INSIDE] - velocity).mean() < 2 * off


def test_a_turn_is_found_as_one():
    rate = 0.03
    found, _ = analysed(turning(rate, 16))
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    true = rate * np.stack([-(y - HEIGHT / 2), x - WIDTH / 2], axis=-1)
    assert np.abs(found.velocity - true)[INSIDE].mean() < 0.12


def test_what_the_flow_predicts_is_told():
    assert analysed(carried((2, 1), 16))[0].explained > 0.9
    assert analysed(boiling(16))[0].explained < 0.2


@pytest.mark.parametrize("strength", [0.0, 1.0, 2.0])
def test_what_stands_is_told_from_what_moves(strength):
    """Noise that boils over noise that stands, as fine, and `strength` times as strong."""
    boils, stands = boiling(24) - 0.5, boiling(1, seed=7)[0] - 0.5
    found, _ = analysed(0.5 + boils + strength * stands)
    average = 1 / 24  # of what boils, this much stands in a clip of 24 frames
    expected = (1 - average) / (1 + strength**2)
    np.testing.assert_allclose(found.moving.mean(axis=(0, 1)), expected, atol=0.12)


def test_what_stands_is_told_place_by_place():
    """Noise boils everywhere, to the right over noise that stands and is twice as strong."""
    right = np.arange(WIDTH)[:, None] >= WIDTH / 2
    found, _ = analysed(boiling(24) + 2 * right * (boiling(1, seed=7)[0] - 0.5))
    assert found.moving[:, :8].mean() > 0.85 and found.moving[:, -8:].mean() < 0.35


@pytest.mark.parametrize("size", [1.5, 3.0])
def test_residuals_reach_as_far_as_the_noise_does(size):
    """Noise blurred by a Gaussian is alike by exp(-d^2 / 4 size^2)."""
    found, _ = analysed(boiling(24, size))
    assert found.reach == pytest.approx(np.sqrt(2) * size, rel=0.2)


@pytest.mark.parametrize("clip", [carried((1.3, 0.7), 24), turning(0.02, 24)], ids=["carried", "turning"])
def test_put_together_for_its_whole_length_it_is_the_clip(clip):
    """Okabe et al. 2009, 3: D_0 as the first residual, and a life that never ends."""
    found, residuals = analysed(clip)
    analysis = whole(found, residuals)
    for frame in (0, 1, 9, 23):
        assert psnr(stillwater.reconstruct(analysis, frame, life=24), clip[frame]) > 40


def test_between_two_frames_it_is_both_carried_half_way():
    clip = carried((2, 0), 12)
    found, residuals = analysed(clip)
    analysis = whole(found, residuals)
    between = stillwater.reconstruct(analysis, 6.5, life=12)
    true = carried((1, 0), 24)[13]  # half the way, twice the frames
    assert psnr(between[INSIDE], (true * np.cos(0) + 0)[INSIDE]) > 20  # the texture also changes, at another pace
    near = [psnr(between, clip[i]) for i in range(12)]
    assert sorted(np.argsort(near)[-2:]) == [6, 7]


def test_a_short_life_loses_what_is_older():
    clip = carried((2, 0), 24)
    found, residuals = analysed(clip)
    analysis = whole(found, residuals)
    short, long = (psnr(stillwater.reconstruct(analysis, 20, life), clip[20]) for life in (8, 24))
    assert long > short + 10


def test_any_number_of_threads_gives_the_same_bytes():
    results = []
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        found, residuals = analysed(carried((1.5, 1), 20))
        results.append((found.velocity, found.energy, residuals, found.reach, found.explained))
    for other in results[1:]:
        assert all(np.array_equal(a, b) for a, b in zip(results[0], other, strict=True))


def test_it_reports_and_can_be_cancelled():
    told = []
    engine.analyse_clip(halves(carried((1, 0), 12)), "dense", "fast", lambda phase, share: told.append((phase, share)) or True)
    shares = [share for _, share in told]
    assert shares == sorted(shares) and 0.75 < shares[-1] <= 1
    assert {phase for phase, _ in told} == {"averaging the clip", "finding the clip's flow", "finding the clip's residuals"}
    with pytest.raises(engine.Cancelled):
        engine.analyse_clip(halves(carried((1, 0), 12)), "dense", "fast", lambda phase, share: False)


@pytest.mark.parametrize(
    ("frames", "sentence"),
    [
        (np.zeros((3, 40, 40, 3), np.float32), "frames: not an array of half floats"),
        (np.zeros((3, 40, 40), np.float16), "frames: not an array of half floats"),
        (np.zeros((1, 40, 40, 3), np.float16), "one frame is not at least 2"),
        (np.full((3, 40, 40, 3), np.nan, np.float16), "clip: frame 1 is not finite everywhere"),
    ],
)
def test_bad_frames_are_refused(frames, sentence):
    with pytest.raises(ValueError, match=sentence):
        engine.analyse_clip(frames, "dense", "medium")


def test_unknown_ways_are_refused():
    for flow, quality in (("wide", "medium"), ("dense", "great")):
        with pytest.raises(ValueError, match="is not"):
            engine.analyse_clip(halves(carried((1, 0), 4)), flow, quality)


def test_frames_that_may_not_be_written_are_refused():
    frames = halves(carried((1, 0), 4))
    frames.flags.writeable = False
    with pytest.raises(ValueError, match="frames: not an array that may be written"):
        engine.analyse_clip(frames, "dense", "medium")
