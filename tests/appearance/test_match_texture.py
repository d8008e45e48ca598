"""Texture matching: as near to the picture as the published algorithm, place by place, without a grid to be seen."""

import numpy as np
import pytest
import stillwater
from hypothesis import given, settings
from hypothesis import strategies as st
from pyrtools.pyramids import SteerablePyramidFreq
from scipy.ndimage import gaussian_filter, zoom
from stillwater import _stillwater as engine
from stillwater.appearance import describe_texture

RNG = np.random.default_rng(7)


def colours(plane):
    return np.stack([plane, 0.6 * plane + 0.1, 0.9 - 0.7 * plane], axis=-1).astype(np.float32)


def streaks(height, width, seed=0):
    """Slanted soft streaks with sparse bright ones, which are far from a Gaussian, and a little grain."""
    noise = np.random.default_rng(seed).standard_normal((height, width))
    y, x = np.fft.fftfreq(height)[:, None], np.fft.fftfreq(width)[None]
    along, across = 0.8 * x + 0.6 * y, 0.8 * y - 0.6 * x
    kept = np.exp(-((along / 0.02) ** 2) - ((np.abs(across) - 0.12) / 0.05) ** 2)
    made = np.fft.ifft2(np.fft.fft2(noise) * kept).real
    made /= made.std()
    return 0.3 + 0.08 * made + 0.1 * np.maximum(made - 1, 0) ** 1.5 + 0.02 * noise


def noise_frame(height, width, seed=1):
    return np.random.default_rng(seed).random((height, width, 3)).astype(np.float32)


def ranks_matched(plane, reference):
    matched = np.empty(plane.size)
    matched[np.argsort(plane.ravel(), kind="stable")] = np.sort(reference.ravel())
    return matched.reshape(plane.shape)


def as_published(frame, picture, repetitions):
    """Heeger and Bergen 1995, figure 3, by pyrtools and sorting."""
    wanted = SteerablePyramidFreq(picture, 4, 3).pyr_coeffs
    frame = ranks_matched(frame, picture)
    for _ in range(repetitions):
        pyramid = SteerablePyramidFreq(frame, 4, 3)
        for key, band in pyramid.pyr_coeffs.items():
            pyramid.pyr_coeffs[key] = ranks_matched(band, wanted[key])
        frame = ranks_matched(pyramid.recon_pyr(), picture)
    return frame


def band_distance(made, picture):
    """Mean over all bands of the distance between histograms (mean absolute difference of ranks' values, in sigmas).

    Away from the sides, where the published algorithm begins the picture anew, and ours goes on mirrored.
    """

    def inner(band):
        height, width = (side // 6 for side in band.shape)
        return np.sort(band[height:-height, width:-width].ravel())

    a, b = (SteerablePyramidFreq(np.asarray(plane, float), 4, 3).pyr_coeffs for plane in (made, picture))
    apart = [np.abs(inner(a[k]) - inner(b[k])).mean() / b[k].std() for k in a]
    return np.mean(apart)


@pytest.mark.parametrize("repetitions", [1, 5])
def test_bands_are_as_near_as_the_published_algorithm_s(repetitions):
    ours, published, before = [], [], []
    for seed in range(3):
        picture, frame = streaks(192, 256, seed), noise_frame(192, 256, seed + 9)
        made = stillwater.match_texture(frame, colours(picture), grid=(1, 1), repetitions=repetitions)[..., 0]
        ours.append(band_distance(made, picture))
        published.append(band_distance(as_published(frame[..., 0].astype(float), picture, repetitions), picture))
        before.append(band_distance(frame[..., 0], picture))
    assert np.mean(ours) < 1.1 * np.mean(published) < 0.3 * np.mean(before)


def test_pixels_have_the_picture_s_histogram_and_colours():
    picture = streaks(192, 256)
    made = stillwater.match_texture(noise_frame(192, 256), colours(picture), grid=(1, 1))[..., :3]
    np.testing.assert_allclose(np.sort(made[..., 0].ravel()), np.sort(picture.ravel()), atol=0.03)
    assert np.abs(np.sort(made[..., 0].ravel()) - np.sort(picture.ravel())).mean() < 2e-3
    inside = made[..., 0] > 0  # 0 is also what would be darker
    np.testing.assert_allclose(made[inside], colours(made[..., 0])[inside], atol=5e-3)


def test_a_picture_matched_to_itself_stays():
    picture = np.clip(colours(streaks(120, 150)), 0, 1)
    for matching in ("steerable", "laplacian"):
        made = stillwater.match_texture(picture, picture, repetitions=2, matching=matching)[..., :3]
        assert np.abs(made - picture).max() < 1e-5


@pytest.mark.parametrize("shape", [(128, 128), (121, 151), (200, 170)])
def test_a_picture_matched_to_itself_stays_where_samples_lie_at_the_borders_of_bins(shape):
    picture = np.clip(colours(streaks(*shape)), 0, 1)
    made = stillwater.match_texture(picture, picture, repetitions=2)[..., :3]
    assert np.abs(made - picture).max() < 1e-5


def textured(weight):
    """A texture whose contrast is `weight`, and noise to be matched to it."""
    plane = 0.5 + weight * RNG.standard_normal(weight.shape)
    return colours(gaussian_filter(plane, 1))


@pytest.mark.parametrize("matching", ["steerable", "laplacian"])
def test_each_place_gets_its_own_statistics(matching):
    contrast = zoom(RNG.uniform(0.05, 0.4, (4, 6)), 60, order=1)
    picture = textured(contrast)
    made = stillwater.match_texture(noise_frame(*contrast.shape), picture, grid=(6, 4), matching=matching)[..., 0]

    def spread(plane):
        return plane.reshape(4, 60, 6, 60).std(axis=(1, 3))

    assert np.corrcoef(spread(made).ravel(), spread(picture[..., 0]).ravel())[0, 1] > 0.95
    assert np.abs(spread(made) / spread(picture[..., 0]) - 1).mean() < 0.15


@pytest.mark.parametrize("matching", ["steerable", "laplacian"])
def test_there_is_no_grid_to_be_seen(matching):
    """Neighbouring cells differ no more than the picture's own; steps at their borders are no larger than elsewhere."""
    contrast = zoom(RNG.uniform(0.1, 0.3, (3, 4)), 100, order=1)
    picture = textured(contrast)[..., 0]
    made = stillwater.match_texture(noise_frame(*picture.shape), colours(picture), grid=(8, 6), matching=matching)[..., 0]

    def differences(plane):
        cells = plane.reshape(6, 50, 8, 50)
        for statistic in (cells.mean(axis=(1, 3)), cells.std(axis=(1, 3))):
            yield np.abs(np.diff(statistic, axis=0)).mean() + np.abs(np.diff(statistic, axis=1)).mean()

    for ours, own in zip(differences(made), differences(picture), strict=True):
        assert ours <= 1.1 * own
    steps = np.abs(np.diff(made, axis=1)).mean(axis=0)
    borders = np.arange(49, 399, 50)
    assert steps[borders].mean() < 1.1 * steps.mean()


def test_stylize_blends():
    picture, frame = colours(streaks(64, 80)), noise_frame(64, 80)
    whole = stillwater.match_texture(frame, picture)
    half = stillwater.match_texture(frame, picture, stylize=0.5)
    np.testing.assert_allclose(half[..., :3], (whole[..., :3] + frame) / 2, atol=1e-6)
    np.testing.assert_array_equal(stillwater.match_texture(frame, picture, stylize=0)[..., :3], frame)


def test_alpha_stays():
    frame = np.concatenate([noise_frame(64, 80), RNG.uniform(0.2, 1, (64, 80, 1))], axis=2).astype(np.float32)
    np.testing.assert_array_equal(stillwater.match_texture(frame, colours(streaks(64, 80)))[..., 3], frame[..., 3])


def torn(picture, seed=0):
    """With a matte that covers some three fifths, partly in shreds, soft at its outline."""
    height, width = picture.shape[:2]
    grain = np.random.default_rng(seed).standard_normal((height, width))
    y, x = np.fft.fftfreq(height)[:, None], np.fft.fftfreq(width)[None]
    smooth = np.fft.ifft2(np.fft.fft2(grain) * np.exp(-((x**2 + y**2) * 40**2))).real
    alpha = np.clip(0.5 + 4 * (smooth / smooth.std() + 0.3), 0, 1)
    return np.dstack([picture, alpha]).astype(np.float32)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 2**31), under=st.floats(0, 50), matching=st.sampled_from(["steerable", "laplacian"]))
def test_colours_that_are_not_seen_change_nothing(seed, under, matching):
    """Neither the picture's nor the frame's, premultiplied or not."""
    rng = np.random.default_rng(seed)
    frame, picture = torn(noise_frame(64, 80, seed), seed), torn(np.clip(colours(streaks(72, 64, seed)), 0, 1), seed + 1)

    def painted_under(image):
        hidden = image[..., 3] == 0
        image = image.copy()
        image[hidden, :3] = under * rng.random((np.count_nonzero(hidden), 3))
        return image

    def matched(change):
        seen_frame, seen_picture = (np.dstack([image[..., :3] * image[..., 3:], image[..., 3]]) for image in (frame, picture))
        target = engine.TextureTarget(change(seen_picture), (2, 1), 0, 4, matching)
        return engine.match_texture(change(seen_frame), target, 1, 1.0)

    np.testing.assert_array_equal(matched(painted_under), matched(np.copy))
    np.testing.assert_array_equal(
        stillwater.match_texture(painted_under(frame), painted_under(picture), repetitions=1, matching=matching),
        stillwater.match_texture(frame, picture, repetitions=1, matching=matching),
    )


@pytest.mark.parametrize("matching", ["steerable", "laplacian"])
def test_what_is_seen_has_the_histogram_of_what_is_seen(matching):
    """Holes in the frame, in the picture, in both: as if there were none. Counted as black they would darken all of it."""
    picture = np.clip(colours(streaks(192, 192, seed=3)), 0, 1)
    frame = noise_frame(192, 192)
    ranks = np.linspace(0.02, 0.98, 25)
    for change_frame, change_picture in [(torn, np.asarray), (np.asarray, torn), (torn, torn)]:
        wanted, given = change_picture(picture), change_frame(frame)
        made = stillwater.match_texture(given, wanted, grid=(1, 1), matching=matching)
        solid = [image[image[..., -1] == 1] if image.shape[2] == 4 else image.reshape(-1, 3) for image in (made, wanted)]
        ours, theirs = (np.quantile(pixels[:, :3], ranks, axis=0) for pixels in solid)
        np.testing.assert_allclose(ours, theirs, atol=0.02)


@pytest.mark.parametrize("matching", ["steerable", "laplacian"])
def test_a_picture_with_holes_matched_to_itself_stays(matching):
    picture = torn(np.clip(colours(streaks(120, 150)), 0, 1))
    made = stillwater.match_texture(picture, picture, repetitions=2, matching=matching)
    seen = picture[..., 3] > 0.01
    assert np.abs(made - picture)[seen].max() < 1e-4


def test_cells_in_which_nothing_is_seen_take_the_whole_picture_s_values():
    picture = torn(np.clip(colours(streaks(120, 150)), 0, 1))
    picture[:, :75, 3] = 0
    picture[:, 75:, 3] = 1
    made = stillwater.match_texture(noise_frame(120, 150), picture, grid=(3, 2))
    left, right = made[:, :50, :3], picture[:, 75:, :3]
    assert np.abs(np.median(left, axis=(0, 1)) - np.median(right, axis=(0, 1))).max() < 0.03
    assert left.std() == pytest.approx(right.std(), rel=0.2)


def test_a_picture_that_is_not_seen_is_refused_and_such_a_frame_stays():
    nothing = np.zeros((64, 64, 4), np.float32)
    with pytest.raises(stillwater.BadInput, match="picture: one of which nothing is seen, alpha 0 everywhere, is not a texture"):
        describe_texture(nothing)
    made = stillwater.match_texture(nothing, colours(streaks(64, 64)), repetitions=1)
    np.testing.assert_array_equal(made, nothing)


def test_a_described_picture_serves_frames_of_other_sizes():
    picture, target = colours(streaks(128, 160)), describe_texture(colours(streaks(128, 160)), grid=(2, 2))
    assert (target.grid, target.scales) == ([2, 2], 4)
    frame = noise_frame(128, 160)
    np.testing.assert_array_equal(
        stillwater.match_texture(frame, target), stillwater.match_texture(frame, picture, grid=(2, 2))
    )
    made = stillwater.match_texture(noise_frame(201, 307), target)[..., 0]
    assert made.std() == pytest.approx(picture[..., 0].std(), rel=0.1)


def premultiplied(frame):
    return np.concatenate([frame, np.ones_like(frame[..., :1])], axis=2)


def test_kept_curves_do_again_what_they_did_and_mix():
    target = describe_texture(colours(streaks(96, 128)), grid=(2, 2))
    a, b = (premultiplied(noise_frame(96, 128, seed)) for seed in (1, 2))
    curves = [engine.texture_curves(frame, target, 2) for frame in (a, b * 0.5)]
    own = engine.match_texture(a, target, 2, 1.0)
    np.testing.assert_array_equal(engine.match_texture_by(a, target, curves[0], 1.0), own)
    np.testing.assert_array_equal(engine.match_texture_by(a, target, curves[0].mix(curves[1], 0.0), 1.0), own)
    far = engine.match_texture_by(a, target, curves[1], 1.0)
    halfway = engine.match_texture_by(a, target, curves[0].mix(curves[1], 0.5), 1.0)
    assert np.abs(halfway - own).mean() < np.abs(far - own).mean()


def test_threads_do_not_change_a_byte():
    picture, frame = colours(streaks(90, 130)), noise_frame(90, 130)
    for matching in ("steerable", "laplacian"):
        made = []
        for threads in (1, 3):
            engine.set_threads(threads)
            made.append(stillwater.match_texture(frame, picture, matching=matching).tobytes())
        engine.set_threads(0)
        assert made[0] == made[1]


def test_small_cells_take_fewer_scales():
    picture = colours(streaks(64, 64))
    assert [describe_texture(picture, grid=(n, n)).scales for n in (1, 2, 4, 8)] == [4, 4, 3, 2]
    stillwater.match_texture(noise_frame(64, 64), picture, grid=(8, 8))


PICTURE = colours(streaks(64, 80))


@pytest.mark.parametrize(
    "change, sentence",
    [
        ({"grid": (12, 2)}, "grid: 12 x 2 is not one whose cells have at least 8 pixels a side in a picture of 80 x 64"),
        ({"grid": (0, 3)}, "grid: 0 x 3 is not at least one cell across and down"),
        ({"grid": (8, 8), "scales": 4}, "scales: 4 is not a number that leaves 2 coefficients a side of cells of 8 pixels"),
        ({"scales": 13}, "scales: 13 is not between 0 and 12"),
        ({"orientations": 0}, "orientations: 0 is not between 1 and 16"),
        ({"repetitions": 0}, "repetitions: 0 is not between 1 and 50"),
        ({"stylize": 1.5}, "stylize: 1.5 is not between 0 and 1"),
        ({"matching": "none"}, 'matching: "none" is not "steerable" or "laplacian"'),
        ({"frame": np.ones((64, 15, 3))}, "frame: 15 x 64 is not at least 16 pixels a side"),
        ({"frame": np.ones((64, 20, 3)), "grid": (4, 4)}, "grid: 4 x 4 is not one whose cells have at least 8 pixels"),
        ({"frame": np.full((64, 80, 3), np.nan)}, "frame"),
    ],
)
def test_what_cannot_be_is_refused(change, sentence):
    with pytest.raises(stillwater.BadInput, match=sentence):
        stillwater.match_texture(**{"frame": noise_frame(64, 80), "picture": PICTURE} | change)


def test_curves_of_another_target_are_refused():
    frame = premultiplied(noise_frame(64, 80))
    one, two = (describe_texture(PICTURE, grid=grid) for grid in ((1, 1), (2, 2)))
    curves = engine.texture_curves(frame, one, 1)
    with pytest.raises(stillwater.BadInput, match="curves: not those of this target"):
        engine.match_texture_by(frame, two, curves, 1.0)
    with pytest.raises(stillwater.BadInput, match="curves: not both of the same target and number of repetitions"):
        curves.mix(engine.texture_curves(frame, two, 1), 0.5)
    with pytest.raises(stillwater.BadInput, match="share: 2 is not between 0 and 1"):
        curves.mix(curves, 2.0)
