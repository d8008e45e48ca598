"""PatchMatch: near to what looking at every patch finds, never worse than where it began, the same on every machine."""

import os
import subprocess
import sys

import numpy as np
import pytest
from stillwater import _stillwater as engine

RNG = np.random.default_rng(3)
PATCH, HALF = 5, 2


def texture(height, width, seed):
    """Soft blobs of three colours: neighbours in it are alike, as in pictures."""
    noise = np.random.default_rng(seed).random((height, width, 4))
    for axis in (0, 1):
        noise = sum(np.roll(noise, k, axis) for k in range(-2, 3)) / 5
    noise = np.clip((noise - 0.5) * 4 + 0.5, 0, 1)
    noise[..., 3] = 1
    return noise.astype(np.float32)


def as_bytes(image):
    return np.floor(np.clip(image, 0, 1) * np.float32(255) + np.float32(0.5)).astype(np.int64)


def distance(target, source, at, there):
    a = as_bytes(target)[at[0] - HALF : at[0] + HALF + 1, at[1] - HALF : at[1] + HALF + 1]
    b = as_bytes(source)[there[0] - HALF : there[0] + HALF + 1, there[1] - HALF : there[1] + HALF + 1]
    return ((a - b) ** 2).sum()


def by_looking_everywhere(target, source):
    """The least distance of each patch, by its definition."""
    windows = np.lib.stride_tricks.sliding_window_view(as_bytes(source), (PATCH, PATCH), (0, 1)).reshape(
        -1, 4 * PATCH * PATCH
    )
    wanted = np.lib.stride_tricks.sliding_window_view(as_bytes(target), (PATCH, PATCH), (0, 1))
    shape = wanted.shape[:2]
    wanted = wanted.reshape(-1, 4 * PATCH * PATCH)
    apart = (
        (wanted**2).sum(1)[:, None] + (windows**2).sum(1)[None] - 2 * (wanted.astype(float) @ windows.T.astype(float))
    )
    return apart.min(axis=1).round().astype(np.int64).reshape(shape)


def match(target, source, offsets=None, centres=None, **how):
    offsets = np.zeros((*target.shape[:2], 2), np.int16) if offsets is None else offsets
    centres = np.ones(source.shape[:2], np.float32) if centres is None else centres
    return engine.patch_match(target, source, centres, offsets, **{"patch": PATCH, "rounds": 6, **how})


TARGET, SOURCE = texture(40, 70, 1), texture(50, 60, 2)


def test_distances_are_those_of_the_offsets():
    offset, apart = match(TARGET, SOURCE)
    for y, x in [(0, 0), (5, 9), (35, 65), (17, 40)]:
        at = (y + HALF, x + HALF)
        assert apart[y, x] == distance(TARGET, SOURCE, at, (at[0] + offset[y, x, 1], at[1] + offset[y, x, 0]))


def test_it_finds_nearly_what_looking_everywhere_finds():
    best = by_looking_everywhere(TARGET, SOURCE)
    _, apart = match(TARGET, SOURCE, rounds=8)
    assert np.all(apart >= best)
    assert apart.mean() < 1.15 * best.mean()


def test_a_moved_copy_is_found():
    _, apart = match(np.ascontiguousarray(SOURCE[7:40, 11:50]), SOURCE, rounds=8)
    assert (apart == 0).mean() > 0.99


def test_it_is_never_worse_than_its_start():
    start = RNG.integers(-20, 20, (*TARGET.shape[:2], 2)).astype(np.int16)
    _, before = match(TARGET, SOURCE, start, rounds=0)
    _, once = match(TARGET, SOURCE, start, rounds=1)
    _, twice = match(TARGET, SOURCE, start, rounds=2)
    assert np.all(once <= before) and np.all(twice <= once) and (twice < before).mean() > 0.5


NOWHERE = np.full((*TARGET.shape[:2], 2), 3000, np.int16)
UNMATCHED = np.iinfo(np.int32).max


def test_what_begins_nowhere_begins_by_chance():
    offset, apart = match(TARGET, SOURCE, NOWHERE, rounds=0)
    assert np.all(apart < UNMATCHED)
    assert len(np.unique(offset.reshape(-1, 2), axis=0)) > 500


def test_the_only_place_is_found_however_small():
    centres = np.zeros(SOURCE.shape[:2], np.float32)
    centres[30, 50] = 1
    offset, apart = match(TARGET, SOURCE, NOWHERE, centres, rounds=0)
    y, x = np.mgrid[HALF : 40 - HALF, HALF : 70 - HALF]
    assert np.all(x + offset[..., 0] == 50) and np.all(y + offset[..., 1] == 30) and np.all(apart < UNMATCHED)
    near = np.hypot(x - 50, y - 30) <= 12
    assert np.array_equal(match(TARGET, SOURCE, NOWHERE, centres, rounds=2, radius=12)[1] < UNMATCHED, near)


def test_without_a_place_all_stay_unmatched():
    assert np.all(match(TARGET, SOURCE, centres=np.zeros(SOURCE.shape[:2], np.float32))[1] == UNMATCHED)


def test_it_looks_only_where_it_may():
    centres = np.zeros(SOURCE.shape[:2], np.float32)
    centres[10:30, 20:40] = 1
    offset, apart = match(TARGET, SOURCE, centres=centres, radius=25)
    y, x = np.mgrid[HALF : 40 - HALF, HALF : 70 - HALF]
    there = apart < UNMATCHED
    assert there.mean() > 0.3
    assert np.all(centres[(y + offset[..., 1])[there], (x + offset[..., 0])[there]] == 1)
    assert np.all(np.hypot(offset[..., 0], offset[..., 1])[there] <= 25)


def test_any_number_of_threads_gives_the_same():
    wide = texture(90, 110, 5)
    results = []
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        results.append(match(wide, SOURCE))
    engine.set_threads(0)
    for offset, apart in results[1:]:
        assert np.array_equal(offset, results[0][0]) and np.array_equal(apart, results[0][1])


def test_seeds_differ():
    assert not np.array_equal(match(TARGET, SOURCE, seed=1, rounds=1)[0], match(TARGET, SOURCE, seed=2, rounds=1)[0])


@pytest.mark.parametrize("patch", [3, 5, 7, 9, 11, 17])
def test_the_plain_way_gives_the_same_bytes(tmp_path, patch):
    np.savez(tmp_path / "in.npz", target=TARGET, source=SOURCE)
    program = (f"import numpy as np; from stillwater import _stillwater as e; d = np.load(r'{tmp_path}/in.npz');"
               f"o, a = e.patch_match(d['target'], d['source'], np.ones((50, 60), np.float32),"
               f" np.zeros((40, 70, 2), np.int16),"
               f" patch={patch}, rounds=3); np.savez(r'{tmp_path}/out.npz', o=o, a=a)")  # fmt: skip
    subprocess.run(
        [sys.executable, "-c", program], env={**os.environ, "STILLWATER_CPU": "sse4.2"}, check=True, timeout=60
    )
    out = np.load(tmp_path / "out.npz")
    offset, apart = match(TARGET, SOURCE, patch=patch, rounds=3)
    assert np.array_equal(out["o"], offset) and np.array_equal(out["a"], apart)


def test_a_vote_is_the_weighted_mean_of_what_patches_say():
    offsets = np.zeros((*TARGET.shape[:2], 2), np.int16)
    offsets[..., 0] = np.where(np.arange(70) % 2, -12, -10)
    offsets[HALF : 40 - HALF, HALF:14] = 0
    weight = RNG.random(TARGET.shape[:2]).astype(np.float32)
    voted = engine.vote(np.zeros_like(TARGET), SOURCE, offsets, weight, patch=PATCH)
    y, x, total, over = 20, 33, np.zeros(4), 0
    for j in range(-HALF, HALF + 1):
        for i in range(-HALF, HALF + 1):
            share = weight[y + j, x + i]
            total += share * SOURCE[y + offsets[y + j, x + i, 1], x + offsets[y + j, x + i, 0]]
            over += share
    assert np.allclose(voted[y, x], total / over, atol=1e-5)
