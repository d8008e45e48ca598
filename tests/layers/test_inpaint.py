"""Holes filled by exemplars: what is known stays, all is copied from where it may be, and what is straight goes on."""

import os
import subprocess
import sys
import time

import numpy as np
import pytest
import stillwater
from scipy.ndimage import binary_dilation, gaussian_filter
from stillwater import _stillwater as engine

SIDE = 96
Y, X = np.mgrid[:SIDE, :SIDE] + 0.5
DISC = np.hypot(X - SIDE / 2, Y - SIDE / 2) < 17


def painted(seed=1, shape=(70, 90)):
    """Strokes of many colours, no two pixels alike: where a pixel came from can be told."""
    rng = np.random.default_rng(seed)
    noise = rng.random((*shape, 3))
    picture = np.stack([gaussian_filter(noise[..., c], 2) for c in range(3)], axis=2)
    picture = (picture - picture.min()) / np.ptp(picture)
    return (0.9 * picture + 0.1 * rng.random((*shape, 3))).astype(np.float32)


def opaque(picture):
    return np.ascontiguousarray(np.concatenate([picture, np.ones_like(picture[..., :1])], axis=2))


def disc(shape, y, x, radius):
    rows, columns = np.mgrid[: shape[0], : shape[1]]
    return np.hypot(rows - y, columns - x) < radius


PICTURE, HOLE = painted(), disc((70, 90), 33, 48, 13)


def copied_from(filled, picture, hole):
    """The places that the hole's pixels are copies of."""
    place = {
        pixel.tobytes(): at for at, pixel in np.ndenumerate(np.ascontiguousarray(picture[..., :3]).view("V12")[..., 0])
    }
    pixels = np.ascontiguousarray(filled[..., :3]).view("V12")[..., 0][hole]
    return np.array([place[pixel.tobytes()] for pixel in pixels])


def test_known_pixels_stay_bit_by_bit():
    filled = stillwater.inpaint(PICTURE, HOLE)
    assert np.array_equal(filled[~HOLE][:, :3], PICTURE[~HOLE])
    assert not np.allclose(filled[HOLE][:, :3], PICTURE[HOLE], atol=0.01)


def test_so_they_do_where_the_picture_is_transparent():
    picture = opaque(painted(2))
    picture[..., 3] = np.linspace(0, 1, 90)
    filled = stillwater.inpaint(picture, HOLE)
    assert np.array_equal(filled[~HOLE], picture[~HOLE])
    assert np.all((filled[..., 3] >= 0) & (filled[..., 3] <= 1))


def test_what_lies_in_the_hole_is_not_read():
    other = PICTURE.copy()
    other[HOLE] = np.nan
    assert np.array_equal(stillwater.inpaint(other, HOLE), stillwater.inpaint(PICTURE, HOLE))


def test_before_blending_every_pixel_is_a_copy_from_the_source():
    source = np.zeros(HOLE.shape, np.float32)
    source[:, :70] = 1
    filled = engine.inpaint(opaque(PICTURE), HOLE.astype(np.float32), source=source, grow=3, blend=False)
    places = copied_from(filled, PICTURE, HOLE)
    barred = binary_dilation(HOLE, disc((7, 7), 3, 3, 3.01))
    assert np.all(places[:, 1] < 70)
    assert not barred[places[:, 0], places[:, 1]].any()


def test_nothing_comes_from_beyond_the_radius():
    filled = engine.inpaint(opaque(PICTURE), HOLE.astype(np.float32), radius=30, blend=False)
    far = np.hypot(*(copied_from(filled, PICTURE, HOLE) - np.argwhere(HOLE)).T)
    assert far.max() <= 30
    free = engine.inpaint(opaque(PICTURE), HOLE.astype(np.float32), blend=False)
    assert np.hypot(*(copied_from(free, PICTURE, HOLE) - np.argwhere(HOLE)).T).max() > 30


def test_any_number_of_threads_gives_the_same():
    results = []
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        results.append(stillwater.inpaint(PICTURE, HOLE))
    engine.set_threads(0)
    assert np.array_equal(results[0], results[1]) and np.array_equal(results[0], results[2])


def test_a_seed_is_another_filling():
    assert not np.array_equal(stillwater.inpaint(PICTURE, HOLE, seed=1), stillwater.inpaint(PICTURE, HOLE, seed=2))


def test_the_plain_way_copies_the_same(tmp_path):
    np.savez(tmp_path / "in.npz", picture=opaque(PICTURE), hole=HOLE.astype(np.float32))
    program = (f"import numpy as np; from stillwater import _stillwater as e; d = np.load(r'{tmp_path}/in.npz');"
               f"np.save(r'{tmp_path}/out.npy', e.inpaint(d['picture'], d['hole'], blend=False))")  # fmt: skip
    subprocess.run(
        [sys.executable, "-c", program], env={**os.environ, "STILLWATER_CPU": "sse4.2"}, check=True, timeout=60
    )
    assert np.array_equal(
        np.load(tmp_path / "out.npy"), engine.inpaint(opaque(PICTURE), HOLE.astype(np.float32), blend=False)
    )


def smooth(shade):
    """`shade(x, y)` averaged over each pixel."""
    parts = (np.arange(4) + 0.5) / 4 - 0.5
    return np.mean([shade(X + i, Y + j) for i in parts for j in parts], axis=0)


def across(degrees):
    """Signed distance from a line through the middle."""
    angle = np.deg2rad(degrees)
    return lambda x, y: np.cos(angle) * (y - SIDE / 2 - 3) - np.sin(angle) * (x - SIDE / 2)


def edge(degrees):
    return smooth(lambda x, y: 0.15 + 0.7 * (across(degrees)(x, y) > 0))


def bar(degrees):
    return smooth(lambda x, y: 0.15 + 0.7 * (abs(across(degrees)(x, y)) < 4))


def grating(period, degrees):
    return 0.5 + 0.35 * np.sin(2 * np.pi * across(degrees)(X, Y) / period)


def checker(period):
    return 0.15 + 0.7 * ((X // period + Y // period) % 2)


STRAIGHT = {
    **{f"edge {degrees}": (edge(degrees), 0.04) for degrees in (0, 7, 18, 30, 45, 63, 90)},
    **{f"bar {degrees}": (bar(degrees), 0.06) for degrees in (0, 22, 45)},
    **{
        f"grating {period} {degrees}": (grating(period, degrees), 0.03)
        for period, degrees in [(8, 0), (12, 90), (10, 45), (9, 27)]
    },
    **{f"checker {period}": (checker(period), 0.001) for period in (6, 8, 13)},
}


@pytest.mark.parametrize("name", STRAIGHT)
def test_what_is_straight_goes_on_through_the_hole(name):
    shade, bound = STRAIGHT[name]
    picture = np.repeat(shade[..., None], 3, axis=2).astype(np.float32)
    filled = stillwater.inpaint(np.where(DISC[..., None], 0, picture), DISC)
    assert np.sqrt(np.mean((filled[..., :3] - picture)[DISC] ** 2)) < bound


def test_a_horizon_between_two_textures_stays_one():
    rng = np.random.default_rng(5)
    sky = 0.75 + 0.02 * gaussian_filter(rng.normal(size=(SIDE, SIDE)), 4) * 12
    sea = 0.35 + 0.08 * gaussian_filter(rng.normal(size=(SIDE, SIDE)), (1, 5)) * 7
    picture = np.repeat(np.where(Y < 52, sky, sea)[..., None], 3, axis=2).astype(np.float32)
    filled = stillwater.inpaint(picture, DISC)[..., 0]
    inside = DISC[:, SIDE // 2]
    assert np.all(filled[:52][DISC[:52]] > 0.55) and np.all(filled[52:][DISC[52:]] < 0.65)
    assert inside.sum() > 30


def test_the_filling_is_as_sharp_as_the_picture():
    rng = np.random.default_rng(6)
    noise = gaussian_filter(rng.random((120, 120, 3)), (0.8, 0.8, 0)).astype(np.float32)
    hole = disc((120, 120), 60, 60, 22)
    filled = stillwater.inpaint(noise, hole)[..., :3]
    inner = disc((120, 120), 60, 60, 20)
    assert np.diff(filled, axis=1)[inner[:, 1:]].std() > 0.93 * np.diff(noise, axis=1)[~hole[:, 1:]].std()


def test_a_step_of_tone_is_spread_and_leaves_no_border():
    rng = np.random.default_rng(7)
    picture = np.linspace(0.2, 0.8, 140)[None, :, None] + 0.01 * rng.normal(size=(80, 140, 3))
    hole = disc((80, 140), 40, 70, 20)
    filled = stillwater.inpaint(picture.astype(np.float32), hole)[..., :3]
    smooth_steps = np.abs(np.diff(gaussian_filter(filled, (2, 1, 0)), axis=1))
    assert smooth_steps[hole[:, 1:]].max() < 0.035


@pytest.mark.parametrize("shape", [(1, 60), (60, 1), (2, 40), (5, 33)])
def test_pictures_narrower_than_a_patch_are_filled(shape):
    picture = painted(3, shape)
    hole = np.zeros(shape, bool)
    hole[:, 20:26] = shape[1] > 30
    hole[20:26, :] |= shape[0] > 30
    filled = stillwater.inpaint(picture, hole)
    assert np.array_equal(filled[~hole][:, :3], picture[~hole]) and np.isfinite(filled).all()
    raw = engine.inpaint(opaque(picture), hole.astype(np.float32), blend=False)
    assert not hole[tuple(copied_from(raw, picture, hole).T)].any()


def test_a_hole_at_the_picture_s_corner_is_filled():
    hole = disc(HOLE.shape, 0, 0, 20)
    filled = engine.inpaint(opaque(PICTURE), hole.astype(np.float32), blend=False)
    assert not hole[tuple(copied_from(filled, PICTURE, hole).T)].any()


def test_no_hole_is_the_picture():
    assert np.array_equal(stillwater.inpaint(PICTURE, np.zeros(HOLE.shape))[..., :3], PICTURE)
    assert np.array_equal(stillwater.inpaint(PICTURE[:1, :1], np.zeros((1, 1)))[..., :3], PICTURE[:1, :1])


def test_values_above_white_come_along():
    filled = stillwater.inpaint(4 * PICTURE, HOLE)
    assert filled[HOLE].max() > 1.5


def with_nan(array, y, x):
    array = np.array(array, np.float32)
    array[y, x] = np.nan
    return array


@pytest.mark.parametrize(
    "given, sentence",
    [
        ({"hole": np.ones(HOLE.shape)}, "hole: it covers the whole picture; nothing is left to copy from"),
        ({"hole": np.zeros((4, 5))}, "hole: 5 x 4 is not the size of the picture, 90 x 70"),
        ({"hole": np.zeros((4, 5, 2))}, "hole: an array of 4 x 5 x 2 is not height x width"),
        ({"source": np.zeros((4, 5))}, "source: 5 x 4 is not the size of the picture, 90 x 70"),
        ({"source": HOLE}, "source: there is no patch of 9 x 9 px to copy from, 2 px or more from the hole"),
        (
            {"hole": ~disc(HOLE.shape, 35, 45, 3)},
            "hole: there is no patch of 9 x 9 px to copy from, 2 px or more from the hole",
        ),
        (
            {"radius": 5},
            r"radius: within 5 px of \(\d+, \d+\) there is nothing to copy from; the nearest is \d+ px away",
        ),
        ({"radius": 0}, r"radius: 0 is not above 0 \(px\)"),
        ({"radius": float("nan")}, r"radius: nan is not above 0 \(px\)"),
        ({"patch": 8}, r"patch: 8 is not odd \(px\)"),
        ({"patch": 1}, r"patch: 1 is not between 3 and 63 \(px\)"),
        ({"patch": 65}, r"patch: 65 is not between 3 and 63 \(px\)"),
        ({"seed": -1}, "seed: -1 is not between 0 and 9223372036854775807"),
        ({"grow": -1}, r"grow: -1 is not between 0 and 1000 \(px\)"),
        ({"picture": with_nan(PICTURE, 3, 4)}, r"picture: pixel \(4, 3\) is not a finite number"),
        ({"hole": with_nan(HOLE, 3, 4)}, r"hole: pixel \(4, 3\) is not a finite number"),
        ({"source": with_nan(~HOLE, 3, 4)}, r"source: pixel \(4, 3\) is not a finite number"),
        ({"picture": np.zeros((70, 90))}, "image: an array of 70 x 90 is not height x width x 3 or 4"),
    ],
)
def test_what_can_t_be_filled_is_said(given, sentence):
    with pytest.raises(ValueError, match=sentence):
        stillwater.inpaint(**{"picture": PICTURE, "hole": HOLE, **given})


def test_a_patch_larger_than_the_picture_is_refused():
    hole = np.zeros((5, 7))
    hole[2, 3] = 1
    with pytest.raises(ValueError, match=r"patch: 9 is larger than the picture, 7 x 5 \(px\)"):
        stillwater.inpaint(PICTURE[:5, :7], hole)


def test_progress_rises_and_can_cancel():
    told = []

    def listener(phase, share):
        told.append((phase, share))
        return True

    stillwater.inpaint(PICTURE, HOLE, progress=listener)
    shares = [share for _, share in told]
    assert shares == sorted(shares) and shares[0] == 0 and shares[-1] == 1
    assert {phase for phase, _ in told} == {"filling the hole", "blending the seams"}
    with pytest.raises(engine.Cancelled):
        stillwater.inpaint(PICTURE, HOLE, progress=lambda phase, share: share < 0.3)


def test_it_is_asked_again_and_again_whether_to_go_on():
    """Whoever waits for the next question never waits long."""
    picture = painted(9, (300, 400))
    waits, last = [], time.perf_counter()

    def listener(phase, share):
        nonlocal last
        now = time.perf_counter()
        waits.append(now - last)
        last = now
        return True

    stillwater.inpaint(picture, disc((300, 400), 150, 200, 70), progress=listener)
    assert np.percentile(waits, 90) < 0.3 and len(waits) > 5


def test_noise_is_filled_with_numbers():
    """Most of the hole fits perfectly; nothing fits in a patch of noise: still each pixel is a copy of one of the source."""
    picture = np.full((200, 260, 4), 0.5, np.float32)
    picture[..., 3] = 1
    picture[60:140, 190:250, :3] = np.random.default_rng(5).random((80, 60, 3), np.float32)
    hole = disc((200, 260), 80, 100, 60).astype(np.float32)
    hole[65:135, 218:220] = 1
    copies = engine.inpaint(picture, hole, blend=False)
    known = {pixel.tobytes() for pixel in picture[hole == 0]}
    assert all(pixel.tobytes() in known for pixel in copies[hole == 1])
    assert np.isfinite(engine.inpaint(picture, hole)).all()
