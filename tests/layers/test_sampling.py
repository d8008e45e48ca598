"""Catmull-Rom sampling: exact weights, sides that go on mirrored, coverage within 0 .. 1, the same on every CPU."""

import os
import subprocess
import sys

import numpy as np
import pytest
import stillwater
from stillwater import _stillwater as engine

RNG = np.random.default_rng(11)
OPAQUE = np.concatenate([RNG.random((37, 53, 3), np.float32), np.ones((37, 53, 1), np.float32)], axis=2)


def constant_map(dx, dy, shape=(37, 53)):
    return np.broadcast_to(np.float32([dx, dy]), (*shape, 2)).copy()


def catmull_rom(image, dx, dy):
    """The same by the definition, in double, mirrored at the sides."""
    def along(values, at, axis):
        size = values.shape[axis]
        base = np.floor(at).astype(int)
        t = at - base
        weights = [-0.5 * t**3 + t**2 - 0.5 * t, 1.5 * t**3 - 2.5 * t**2 + 1, -1.5 * t**3 + 2 * t**2 + 0.5 * t,
                   0.5 * t**3 - 0.5 * t**2]
        shape = [-1 if i == axis else 1 for i in range(3)]
        mirrored = np.concatenate([np.arange(size), np.arange(size)[::-1]])
        return sum(w.reshape(shape) * np.take(values, mirrored[(base + k - 1) % (2 * size)], axis) for k, w in enumerate(weights))

    rows, columns = np.arange(image.shape[0]) + dy, np.arange(image.shape[1]) + dx
    return along(along(image.astype(float), rows, 0), columns, 1)


@pytest.mark.parametrize("dx, dy", [(0, 0), (3, -2), (-7, 5)])
def test_a_shift_by_whole_pixels_is_exact(dx, dy):
    moved = engine.displace(OPAQUE, constant_map(dx, dy))
    inside = (slice(max(0, -dy), 37 - max(0, dy)), slice(max(0, -dx), 53 - max(0, dx)))
    assert np.array_equal(moved[inside], np.roll(OPAQUE, (-dy, -dx), (0, 1))[inside])


@pytest.mark.parametrize("dx, dy", [(0.25, 0.0), (0.013, -0.5), (-3.777, 2.3), (0.5, 0.5)])
def test_weights_are_those_of_the_place(dx, dy):
    assert np.allclose(engine.displace(OPAQUE, constant_map(dx, dy)), catmull_rom(OPAQUE, dx, dy), atol=2e-6)


@pytest.mark.parametrize("dx, dy", [(-20, 0), (31.4, 0), (0, -18.25), (0, 30), (-12.5, 17.1)])
def test_beyond_its_sides_the_image_is_mirrored(dx, dy):
    assert np.allclose(engine.displace(OPAQUE, constant_map(dx, dy)), catmull_rom(OPAQUE, dx, dy), atol=3e-6)


def test_far_beyond_its_sides_it_is_some_colour_of_the_image():
    far = engine.displace(OPAQUE, constant_map(-5000, 7000))
    assert np.allclose(far[..., 3], 1, atol=1e-6) and far.min() >= 0


def test_an_endless_image_wraps():
    whole_turn = engine.displace(OPAQUE, constant_map(53 * 3, -37 * 2), wraps_x=True, wraps_y=True)
    assert np.array_equal(whole_turn, OPAQUE)
    part = engine.displace(OPAQUE, constant_map(60, 0), wraps_x=True)
    assert np.array_equal(part, np.roll(OPAQUE, -7, 1))


def test_coverage_stays_within_0_and_1_and_straight_colour_is_kept():
    image = np.zeros((40, 40, 4), np.float32)
    image[10:30, 10:30] = (0.2, 0.4, 0.6, 1)
    moved = engine.displace(image, constant_map(0.4, 0.3, (40, 40)))
    alpha = moved[..., 3]
    assert alpha.min() == 0 and alpha.max() <= 1.000001
    covered = alpha > 1e-3
    assert np.allclose(moved[covered][:, :3] / alpha[covered][:, None], (0.2, 0.4, 0.6), atol=1e-4)


def test_what_is_opaque_stays_so_to_the_bit():
    map = RNG.normal(0, 3, (37, 53, 2)).astype(np.float32)
    assert (engine.displace(OPAQUE, map)[..., 3] == 1).all()


@pytest.mark.parametrize("dx, dy", [(0.3, 0.6), (-9.4, 2.5)])
def test_a_few_islands_are_sampled_like_anything_else(dx, dy):
    """Where a run of places holds nothing, nothing is sampled."""
    islands = np.zeros((40, 200, 4), np.float32)
    for y, x in ((3, 5), (17, 90), (21, 91), (38, 198)):
        islands[y : y + 2, x : x + 3] = RNG.random((2, 3, 4))[: 40 - y, : 200 - x]
    islands[..., :3] *= islands[..., 3:]
    alpha = catmull_rom(islands, dx, dy)[..., 3]
    sampled = engine.displace(islands, constant_map(dx, dy, (40, 200)))
    assert 10 < (alpha > 1e-3).sum() < 300
    np.testing.assert_allclose(sampled[..., 3], np.clip(alpha, 0, 1), atol=2e-5)  # places are float32


def test_places_that_are_no_numbers_sample_inside():
    for bad in (np.nan, np.inf, -np.inf):
        map = RNG.normal(0, 2, (37, 53, 2)).astype(np.float32)
        map[5, 7, 0] = map[20, 40, 1] = map[36, 52] = bad
        assert np.isfinite(engine.displace(OPAQUE, map)).all()
        assert np.isfinite(engine.displace(OPAQUE, map, wraps_x=True, wraps_y=True)).all()
    assert np.isfinite(engine.displace(OPAQUE, constant_map(np.nan, np.inf))).all()


@pytest.mark.parametrize("width", range(1, 10))
def test_runs_of_any_length(width):
    """Also with one place that is no number or lies far outside, wherever it is in the run."""
    for odd in range(width):
        for far in (np.nan, 1e4, -1e4):
            map = RNG.normal(0, 2, (1, width, 2)).astype(np.float32)
            map[0, odd, 0] = far
            wide = np.concatenate([map, RNG.normal(0, 2, (1, 60, 2)).astype(np.float32)], axis=1)
            assert np.array_equal(engine.displace(OPAQUE, map), engine.displace(OPAQUE, wide)[:, :width])


def test_the_plain_way_gives_the_same(tmp_path):
    rng = np.random.default_rng(2)
    image = rng.random((50, 70, 4), np.float32)
    map = rng.normal(0, 9, (50, 70, 2)).astype(np.float32)
    np.savez(tmp_path / "in.npz", image=image, map=map)
    program = (f"import numpy as np; from stillwater import _stillwater as e; d = np.load(r'{tmp_path}/in.npz');"
               f"np.save(r'{tmp_path}/out.npy', e.displace(d['image'], d['map']))")
    subprocess.run([sys.executable, "-c", program], env={**os.environ, "STILLWATER_CPU": "sse4.2"}, check=True, timeout=60)
    assert np.allclose(np.load(tmp_path / "out.npy"), engine.displace(image, map), atol=1e-5)


def test_straight_alpha_at_the_python_border():
    image = np.zeros((8, 8, 4), np.float32)
    image[..., :3] = (1, 0, 0)
    image[2:6, 2:6] = (0, 0.5, 0, 1)
    moved = stillwater.displace(image, constant_map(0.5, 0, (8, 8)))
    seen = moved[moved[..., 3] > 0.01]
    assert np.allclose(seen[:, :3], (0, 0.5, 0), atol=1e-5)
    assert np.array_equal(stillwater.displace(image[..., :3], constant_map(0, 0, (8, 8)))[..., 3], np.ones((8, 8)))


@pytest.mark.parametrize("image", [np.zeros((4, 4)), np.zeros((4, 4, 2)), np.zeros((0, 4, 4))])
def test_a_shape_that_is_no_image_is_refused(image):
    with pytest.raises(ValueError, match="image: .* is not"):
        stillwater.displace(image, np.zeros((4, 4, 2)))


def test_over_is_porter_and_duffs():
    front, back = RNG.random((2, 9, 7, 4)).astype(np.float32)
    whole = stillwater.over(front, back)
    alpha = front[..., 3:] + (1 - front[..., 3:]) * back[..., 3:]
    colour = (front[..., :3] * front[..., 3:] + (1 - front[..., 3:]) * back[..., 3:] * back[..., :3]) / alpha
    assert np.allclose(whole, np.concatenate([colour, alpha], 2), atol=1e-5)


def test_over_wants_one_size():
    with pytest.raises(ValueError, match=r"back: 7 x 9 is not the size of front, 5 x 9"):
        stillwater.over(np.zeros((9, 5, 4)), np.zeros((9, 7, 4)))


def test_displace_over_is_displace_then_over():
    image, back = RNG.random((2, 30, 40, 4)).astype(np.float32)
    map = RNG.normal(0, 3, (30, 40, 2)).astype(np.float32)
    expected = engine.over(engine.displace(image, map), back)
    engine.displace_over(engine.Source(image), map, back)
    assert np.allclose(back, expected, atol=1e-6)
