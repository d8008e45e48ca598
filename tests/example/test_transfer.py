"""Where a picture takes a clip's residuals from: like flow from like flow, connected, lively, turned only where it must be."""

import numpy as np
import pytest
from clips import HEIGHT, WIDTH
from scipy.ndimage import gaussian_filter, map_coordinates, zoom
from stillwater import _stillwater as engine

Y, X = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)
EVEN = np.ones((HEIGHT, WIDTH), np.float32)


def whirl(height=HEIGHT, width=WIDTH):
    """A flow that is another one everywhere."""
    y, x = np.mgrid[:height, :width] / [[[height]], [[width]]] * [[[HEIGHT]], [[WIDTH]]]
    return np.stack([1.5 + np.sin(y / 23) + 0.4 * np.sin(x / 17), np.cos(x / 31) + 0.5 * np.sin(y / 19)], axis=-1).astype(np.float32)


def matched(velocity, clip, energy=EVEN, **parameters):
    return engine.match_patches(velocity, clip, energy, engine.TransferParameters(**parameters))


def flow_at(flow, places):
    return np.stack([map_coordinates(flow[..., k], [places[:, 1], places[:, 0]], order=1, mode="nearest") for k in (0, 1)], axis=-1)


def inside(patches, margin=10):
    x, y = patches[:, 0], patches[:, 1]
    return patches[(x > margin) & (y > margin) & (x < WIDTH - margin) & (y < HEIGHT - margin)]


def connected(patches):
    """Share of patches that go on where their neighbour to the left does."""
    there = {(round(x), round(y)): (np.array((sx, sy)), turn) for x, y, sx, sy, turn in patches.tolist()}
    pairs = [(there[x - 8, y], here) for (x, y), here in there.items() if (x - 8, y) in there]
    on = [a + 8 * np.array((np.cos(turn), -np.sin(turn))) for (a, turn), _ in pairs]
    return np.mean([np.hypot(*(going - b)) < 0.3 for going, (_, (b, _)) in zip(on, pairs, strict=True)])


def test_like_flow_comes_from_like_flow():
    flow = whirl()
    patches = inside(matched(flow, flow))
    wanted, has = flow_at(flow, patches[:, :2]), flow_at(flow, patches[:, 2:4])
    turned = np.stack([np.cos(patches[:, 4]) * has[:, 0] - np.sin(patches[:, 4]) * has[:, 1],
                       np.sin(patches[:, 4]) * has[:, 0] + np.cos(patches[:, 4]) * has[:, 1]], axis=-1)  # fmt: skip
    off = np.hypot(*(wanted - turned).T) / np.hypot(*wanted.T)
    assert np.median(off) < 0.1
    assert connected(patches) > 0.8
    assert np.median(np.hypot(*(patches[:, :2] - patches[:, 2:4]).T)) < 2  # the clip on itself lies where it was


def test_all_of_a_layer_is_covered_once_half_a_patch_apart():
    patches = matched(whirl(), whirl(), patch=16)
    places = {(x, y) for x, y in np.round(patches[:, :2]).astype(int).tolist()}
    assert places == {(x, y) for x in range(0, WIDTH + 8, 8) for y in range(0, HEIGHT + 8, 8)}


def test_a_picture_painted_slower_takes_the_same():
    flow = whirl()
    np.testing.assert_allclose(matched(flow / 3, flow), matched(flow, flow), atol=1e-5)


def test_a_picture_larger_than_the_clip_takes_it_larger():
    large = 2 * zoom(whirl(), (2, 2, 1), order=1)
    patches = matched(large, whirl(), patch=32, clip_scale=2.0)
    centre = patches[(np.abs(patches[:, 0] - WIDTH) < 60) & (np.abs(patches[:, 1] - HEIGHT) < 40)]
    wanted, has = flow_at(large, centre[:, :2]) / 2, flow_at(whirl(), centre[:, 2:4])
    assert np.median(np.hypot(*(wanted - has).T) / np.hypot(*wanted.T)) < 0.25


def test_content_is_turned_where_nothing_of_the_clip_runs_that_way():
    down = np.zeros((HEIGHT, WIDTH, 2), np.float32)
    down[..., 1] = 2 + np.sin(X / 9)
    right = np.ascontiguousarray(np.rot90(down, 1)[..., ::-1])  # turned: flows to the right
    patches = matched(right, down)
    assert np.median(np.abs(np.abs(patches[:, 4]) - np.pi / 2)) < 0.05
    assert (np.sign(patches[:, 4]) == -1).mean() > 0.95  # from down to right, x to y counted positive


def test_even_flow_takes_lively_places_not_flat_ones_and_not_always_the_same():
    even = np.full((HEIGHT, WIDTH, 2), (2, 0), np.float32)
    energy = gaussian_filter(np.random.default_rng(1).uniform(size=(HEIGHT, WIDTH)), 6).astype(np.float32)
    energy = (energy - energy.min()) / np.ptp(energy)
    energy[:, : WIDTH // 2] *= 0.02  # half of the clip is flat
    patches = matched(even, even, energy)
    taken = map_coordinates(energy, [patches[:, 3], patches[:, 2]], order=1, mode="nearest")
    assert taken.mean() > 1.5 * energy.mean()
    cells, counts = np.unique((patches[:, 2:4] // 16).astype(int), axis=0, return_counts=True)
    assert len(cells) >= 8 and counts.max() < 0.3 * len(patches)


def test_the_best_lie_on_top_or_at_the_bottom():
    last = matched(whirl(), whirl()[:, ::-1] * 1.5)
    first = matched(whirl(), whirl()[:, ::-1] * 1.5, best_last=False)
    assert {tuple(row) for row in last.tolist()} == {tuple(row) for row in first.tolist()}
    assert not np.array_equal(last, first)


def test_any_number_of_threads_gives_the_same_patches():
    results = []
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        results.append(matched(whirl(), np.roll(whirl(), 40, axis=1)))
    assert np.array_equal(results[0], results[1]) and np.array_equal(results[0], results[2])


def test_flow_that_stands_is_not_turned():
    patches = matched(np.zeros((HEIGHT, WIDTH, 2), np.float32), whirl())
    assert (patches[:, 4] == 0).all()


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"patch": 3}, "patch: 3 is not between 4 and 128"),
        ({"clip_scale": 0.0}, "clip_scale: 0 is not above 0"),
        ({"patch": 128, "clip_scale": 0.5}, "patch: 128 px is not within the clip's 128 x 96 px"),
    ],
)
def test_bad_parameters_are_refused(change, sentence):
    with pytest.raises(ValueError, match=sentence):
        matched(whirl(), whirl(), **change)


def test_sizes_that_differ_and_numbers_that_are_none_are_refused():
    with pytest.raises(ValueError, match=r"clip\.energy"):
        matched(whirl(), whirl(), EVEN[:-1])
    broken = whirl()
    broken[3, 3] = np.nan
    with pytest.raises(ValueError, match="velocity: not finite everywhere"):
        matched(broken, whirl())


# ---- what lies where


def placed(*rows):
    return np.array(rows, np.float32).reshape(-1, 5)


def noise(size=0.7):
    field = gaussian_filter(np.random.default_rng(3).normal(size=(HEIGHT, WIDTH, 3)), (size, size, 0))
    return (field / field.std()).astype(np.float32)


def test_a_clip_on_its_own_frames_is_itself():
    own = engine.identical_map((WIDTH, HEIGHT)).gather(noise())
    np.testing.assert_allclose(own[..., :3], noise(), atol=1e-5)


def test_a_patch_is_moved_and_turned():
    quarter = np.pi / 2
    source = engine.SourceMap((40, 40), placed([20, 20, 64, 48, quarter]), parameters=engine.TransferParameters(patch=32))
    given = noise()
    got = source.gather(given)[..., :3]
    for dx, dy in ((0, 0), (5, 0), (0, 7), (-4, 3)):  # right on the picture was up in the clip
        np.testing.assert_allclose(got[20 + dy, 20 + dx], given[48 - dx, 64 + dy], atol=1e-4)


def test_a_smaller_clip_lies_larger():
    parameters = engine.TransferParameters(patch=32, clip_scale=2.0)
    got = engine.SourceMap((40, 40), placed([20, 20, 64, 48, 0]), parameters=parameters).gather(noise())[..., :3]
    np.testing.assert_allclose(got[20, 24], noise()[48, 66], atol=1e-4)


@pytest.mark.parametrize("size", [1.5, 3.0])
def test_where_patches_mix_the_variance_stays(size):
    rng = np.random.default_rng(4)
    rows = [(x, y, rng.uniform(20, WIDTH - 20), rng.uniform(20, HEIGHT - 20), 0) for x in range(0, WIDTH, 8) for y in range(0, HEIGHT, 8)]
    source = engine.SourceMap((WIDTH, HEIGHT), placed(*rows), reach=np.sqrt(2) * size)
    variances = []
    for seed in range(12):
        field = gaussian_filter(np.random.default_rng(seed).normal(size=(HEIGHT, WIDTH)), size)
        field = np.repeat((field / field.std())[..., None], 3, axis=2).astype(np.float32)
        variances.append(source.gather(field)[8:-8, 8:-8, 0] ** 2)
    assert np.mean(variances) == pytest.approx(1, abs=0.1)  # bilinear places take a little


def test_a_clone_stroke_brings_what_lies_along_it():
    """A straight stroke to the right, laid downwards: what was above it lies to its right."""
    stroke = engine.CloneStroke([(40.5, 48.5), (80.5, 48.5)], [(30.5, 10.5), (30.5, 50.5)], width=20)
    given = noise()
    got = engine.SourceMap((60, 60), placed(), [stroke]).gather(given)[..., :3]
    for along, beside in ((10, 0), (20, 3), (30, -4)):
        np.testing.assert_allclose(got[10 + along, 30 - beside], given[48 + beside, 40 + along], atol=0.02)
    assert (got[:, 45:] == 0).all()


def test_a_clone_stroke_of_alpha_lies_over_patches():
    stroke = engine.CloneStroke([(40.5, 48.5), (80.5, 48.5)], [(10.5, 30.5), (50.5, 30.5)], width=24, alpha=0.5)
    patches = placed([30, 30, 64, 20, 0])
    both = engine.SourceMap((60, 60), patches, [stroke], engine.TransferParameters(patch=64), reach=0.5)
    given = noise()
    expected = (0.5 * given[48, 60] + 0.5 * given[20, 64]) / np.sqrt(0.5)
    np.testing.assert_allclose(both.gather(given)[30, 30, :3], expected, atol=0.05)


@pytest.mark.parametrize(
    ("stroke", "sentence"),
    [
        (([], [(1, 1)]), "stroke: no points is not at least one"),
        (([(1, 1)], [(1, 1)], 0.0), r"strokes\[0\].width: 0 is not above 0"),
        (([(1, 1)], [(1, 1)], 9.0, 1.5), r"strokes\[0\].alpha: 1.5 is not between 0 and 1"),
    ],
)
def test_bad_clone_strokes_are_refused(stroke, sentence):
    with pytest.raises(ValueError, match=sentence):
        engine.SourceMap((60, 60), placed(), [engine.CloneStroke(*stroke)])


def test_patches_of_another_shape_are_refused():
    with pytest.raises(ValueError, match="patches: not an array of count x 5"):
        engine.SourceMap((60, 60), np.zeros((3, 4), np.float32))
