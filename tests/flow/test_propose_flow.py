"""A field without strokes: along the picture's streaks, the way that the kind runs; strokes correct it."""

import numpy as np
import pytest
import stillwater
from scipy.ndimage import gaussian_filter
from stillwater.flow_painting import KINDS

SIZE = (240, 160)
WAYS = {"falls": (0, 1), "fire": (0, -1), "smoke": (0, -1), "sky": (1, 0), "water": (0.94, 0.342)}


def brushed(turn, seed=3):
    """Paint brushed along an angle for each pixel (radians, y down): noise averaged along streamlines."""
    rng = np.random.default_rng(seed)
    noise = np.stack([gaussian_filter(rng.standard_normal(turn.shape), 0.8) for _ in range(3)], axis=2)
    y, x = np.mgrid[: turn.shape[0], : turn.shape[1]].astype(float)
    total = noise.copy()
    for way in (1, -1):
        at_x, at_y = x.copy(), y.copy()
        for _ in range(12):
            here = turn[np.clip(np.rint(at_y), 0, turn.shape[0] - 1).astype(int), np.clip(np.rint(at_x), 0, turn.shape[1] - 1).astype(int)]
            at_x += way * np.cos(here)
            at_y += way * np.sin(here)
            total += noise[np.clip(np.rint(at_y), 0, turn.shape[0] - 1).astype(int), np.clip(np.rint(at_x), 0, turn.shape[1] - 1).astype(int)]
    return np.clip(0.5 + 0.15 * total / total.std(), 0, 1)


def streaky(degrees):
    return brushed(np.full((160, 240), np.radians(degrees)))


def between(orientation, degrees):
    """Degrees from a direction to each pixel's."""
    way = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    return np.degrees(np.arccos(np.clip(orientation @ way, -1, 1)))


INSIDE = (slice(20, -20), slice(20, -20))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("off", [-50, -25, 0, 25, 50])
def test_it_runs_along_streaks_the_way_of_its_kind(kind, off):
    usual = np.degrees(np.arctan2(*WAYS[kind][::-1]))
    flow = stillwater.propose_flow(streaky(usual + off + 180), kind)
    assert between(flow.orientation[INSIDE], usual + off).mean() < (12 if off else 4)
    assert np.abs(np.linalg.norm(flow.orientation, axis=2) - 1).max() < 1e-4


@pytest.mark.parametrize("kind", KINDS)
def test_where_nothing_is_seen_it_is_the_kind_s_own_way(kind):
    flow = stillwater.propose_flow(np.full((160, 240, 3), 0.5), kind)
    assert np.abs(flow.orientation - WAYS[kind]).max() < 1e-3
    assert np.ptp(flow.speed) < 1e-3 * flow.speed.max() and flow.speed.min() > 0


def test_speed_goes_with_the_picture_s_size_and_the_kind():
    def speed(kind, size=SIZE):
        return stillwater.propose_flow(np.full((size[1], size[0], 3), 0.5), kind).speed[0, 0]

    assert speed("sky") < speed("water") == speed("smoke") < speed("fire") < speed("falls")
    assert speed("falls", (480, 320)) == pytest.approx(2 * speed("falls"), rel=1e-3)


def test_streaks_that_turn_are_followed_with_one_sign():
    """Round a half circle, from up to down: nowhere against the neighbours."""
    y, x = np.mgrid[:160, :240]
    turn = np.arctan2(y - 150, x - 120) + np.pi / 2
    flow = stillwater.propose_flow(brushed(turn), "sky").orientation[20:130, 20:-20]
    assert ((flow[:, 1:] * flow[:, :-1]).sum(axis=2) > 0).all() and ((flow[1:] * flow[:-1]).sum(axis=2) > 0).all()
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=2)[20:130, 20:-20]
    assert np.degrees(np.arccos(np.clip((flow * circle).sum(axis=2), -1, 1))).mean() < 15


def test_strokes_hold_near_them_and_say_which_way_elsewhere():
    picture = streaky(10)
    flow = stillwater.propose_flow(picture, "sky", [{"points": [[200, 30], [40, 30]], "kind": "orientation"}])
    assert between(flow.orientation[28:33, 60:180], 180).max() < 8
    assert between(flow.orientation[110:140, 40:200], 190).mean() < 8
    free = stillwater.propose_flow(picture, "sky")
    assert between(free.orientation[INSIDE], 10).mean() < 8


def test_painted_speeds_take_the_place_of_the_kind_s():
    flow = stillwater.propose_flow(streaky(10), "sky", [{"points": [[40, 80], [200, 80]], "kind": "speed", "speed": 7}])
    assert np.abs(flow.speed - 7).max() < 0.01
    assert np.array_equal(flow.orientation, stillwater.propose_flow(streaky(10), "sky").orientation)


def test_only_what_lies_within_the_layer_is_looked_at():
    picture, bound = streaky(30), np.zeros((160, 240), np.float32)
    bound[:, 120:] = 1
    picture[:, :112] = streaky(-60)[:, :112]
    bounded, free = (stillwater.propose_flow(picture, "sky", bound=b).orientation for b in (bound, None))
    place = (slice(40, 120), slice(146, 150))
    assert between(bounded[place], 30).mean() < 10
    assert np.abs(bounded[40:120, 120, 0]).max() < 0.1
    assert between(free[40:120, 100:110], 30).mean() > 20


def test_freeze_stops_it():
    frozen = np.zeros((160, 240), np.float32)
    frozen[:80] = 1
    assert stillwater.propose_flow(streaky(0), "sky", freeze=frozen).speed[:80].max() == 0


def test_a_large_picture_is_looked_at_small():
    picture = streaky(20)
    small, large = (
        stillwater.propose_flow(p, "sky").orientation.mean(axis=(0, 1)) for p in (picture, picture.repeat(5, 0).repeat(5, 1))
    )
    assert np.degrees(np.arccos(small @ large / np.linalg.norm(small) / np.linalg.norm(large))) < 6


@pytest.mark.parametrize("size", [(1, 1), (3, 200), (9, 7)])
def test_small_pictures(size):
    flow = stillwater.propose_flow(np.random.default_rng(1).random((size[1], size[0], 3)), "falls")
    assert np.isfinite(flow.orientation).all() and flow.speed.shape == size[::-1]


@pytest.mark.parametrize(
    "given, sentence",
    [
        ({"kind": "lava"}, "kind: lava is not water, falls, fire, smoke or sky"),
        ({"picture": np.full((4, 5, 3), np.nan)}, "picture[0, 0]: nan is not a finite number"),
        ({"bound": np.ones((2, 2))}, "bound: 2 x 2 is not the size of picture, 5 x 4"),
        ({"freeze": np.ones((2, 2))}, "freeze: 2 x 2 is not the size of picture, 5 x 4"),
        ({"strokes": [{"points": [[1, 1]]}]}, "strokes[0].points: a line shorter than 1 px is not a direction"),
    ],
)
def test_bad_input(given, sentence):
    with pytest.raises(stillwater.BadInput) as caught:
        stillwater.propose_flow(**{"picture": np.zeros((4, 5, 3)), "kind": "sky", **given})
    assert str(caught.value) == sentence
