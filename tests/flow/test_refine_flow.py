"""A painted flow turns along the picture's streaks: stripes of known angles, flat pictures, widths, amounts."""

import numpy as np
import pytest
import stillwater
from scipy.ndimage import gaussian_filter
from stillwater import _stillwater as engine
from stillwater.recipe.strokes import Refine

SIZE = (240, 160)
X, Y = np.meshgrid(np.arange(240.0), np.arange(160.0))


def stripes(degrees, wave=12):
    """Streaks along an angle (clockwise, y down), and that direction."""
    along = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    across = X * -along[1] + Y * along[0]
    return np.repeat((0.5 + 0.3 * np.sin(2 * np.pi * across / wave))[..., None], 3, axis=2), along


def painted(direction=(1, 0), speed=3.0):
    orientation = np.zeros((160, 240, 2), np.float32)
    orientation[:] = np.array(direction) / np.hypot(*direction)
    return orientation, np.full((160, 240), speed, np.float32)


INSIDE = (slice(30, -30), slice(30, -30))


@pytest.mark.parametrize("degrees", [-80, -60, -35, -10, 0, 20, 45, 70, 85])
def test_it_runs_along_stripes_the_painted_way_as_fast_as_they_agree(degrees):
    picture, along = stripes(degrees)
    flow = stillwater.refine_flow(painted(), picture)[INSIDE]
    speed = np.linalg.norm(flow, axis=2)
    expected = 3 * np.cos(np.radians(degrees))
    assert (flow @ along > 0).all()
    assert np.degrees(np.arccos(np.clip((flow @ along) / speed, -1, 1))).max() < 4
    assert np.abs(speed - expected).max() < 0.2


def test_the_painted_way_gives_the_sign():
    picture, along = stripes(20)
    forth, back = (stillwater.refine_flow(painted((way, 0)), picture)[INSIDE] for way in (1, -1))
    assert np.abs(forth + back).max() < 1e-5


def test_a_flat_picture_leaves_it_as_painted():
    flow = stillwater.refine_flow(painted((3, 4), 2), np.full((160, 240, 3), 0.4))
    assert np.abs(flow - (1.2, 1.6)).max() < 1e-5


def test_what_is_flat_listens_to_the_streaks_around_only_within_the_blur():
    picture, along = stripes(45)
    picture[:, 120:] = 0.5
    flow = stillwater.refine_flow(painted(), picture, width=6)
    assert np.abs(flow[:, 180:] - (3, 0)).max() < 0.02
    assert np.degrees(np.arctan2(*flow[80, 60, ::-1])) == pytest.approx(45, abs=3)


def test_amount_blends():
    picture, _ = stripes(40)
    none, half, all_of_it = (stillwater.refine_flow(painted(), picture, amount=amount) for amount in (0, 0.5, 1))
    assert np.abs(none - (3, 0)).max() < 1e-6
    assert np.abs(half - (none + all_of_it) / 2).max() < 1e-5


def by_the_formula(orientation, speed, picture, width):
    """METHODS.md 2 step by step, in whole pixels."""
    grey = picture @ [0.2126, 0.7152, 0.0722]
    kernel = np.array([1, 4, 6, 4, 1]) / 16
    grey = np.pad(grey, 3, mode="reflect")
    for axis in (0, 1):
        grey = np.apply_along_axis(np.convolve, axis, grey, kernel, "same")
    smooth, difference = np.array([1, 2, 1]) / 4, np.array([1, 0, -1]) / 2

    def sobel(axis):
        turned = np.apply_along_axis(np.convolve, axis, grey, difference, "same")
        return np.apply_along_axis(np.convolve, 1 - axis, turned, smooth, "same")[3:-3, 3:-3]

    edge = np.stack([-sobel(0), sobel(1)], axis=2)
    edge *= np.sign((edge * orientation).sum(axis=2))[..., None]
    blurred = np.stack([gaussian_filter(edge[..., c], width, truncate=5) for c in (0, 1)], axis=2) + 0.004 * orientation
    psi = blurred / np.linalg.norm(blurred, axis=2, keepdims=True)
    return psi * (np.maximum(0, (psi * orientation).sum(axis=2)) * speed)[..., None]


@pytest.mark.parametrize("width", [2, 5, 7, 12, 30])
def test_it_is_the_method_s_formula(width):
    rng = np.random.default_rng(5)
    noise = np.stack([gaussian_filter(rng.standard_normal((160, 240)), (2, 7)) for _ in range(3)], axis=2)
    picture = np.clip(0.5 + 0.2 * noise / noise.std(), 0, 1)
    turn = gaussian_filter(rng.standard_normal((160, 240)), 30)
    turn *= 0.5 / turn.std()
    orientation = np.stack([np.cos(turn), np.sin(turn)], axis=2).astype(np.float32)
    speed = (3 + turn).astype(np.float32)
    margin = (slice(8, -8), slice(8, -8))
    ours = stillwater.refine_flow((orientation, speed), picture, width=width)[margin]
    theirs = by_the_formula(orientation, speed, picture, width)[margin]
    apart = np.linalg.norm(ours - theirs, axis=2) / 3
    assert np.percentile(apart, 99) < 0.03 and apart.mean() < 0.006


def test_defaults_are_the_recipe_s():
    picture, _ = stripes(30)
    usual = Refine()
    assert np.array_equal(
        stillwater.refine_flow(painted(), picture),
        stillwater.refine_flow(painted(), picture, width=usual.width, amount=usual.amount),
    )


@pytest.mark.parametrize("size", [(1, 1), (3, 200), (9, 7)])
def test_small_pictures(size):
    orientation = np.zeros((size[1], size[0], 2), np.float32)
    orientation[..., 0] = 1
    flow = stillwater.refine_flow((orientation, np.ones(size[::-1], np.float32)), np.random.default_rng(1).random((*size[::-1], 3)))
    assert flow.shape == (*size[::-1], 2) and np.isfinite(flow).all() and np.linalg.norm(flow, axis=2).max() <= 1 + 1e-5


def test_the_same_bytes_from_any_number_of_threads():
    picture, _ = stripes(30)
    flows = set()
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        flows.add(stillwater.refine_flow(painted(), picture).tobytes())
    engine.set_threads(0)
    assert len(flows) == 1


@pytest.mark.parametrize(
    "change, sentence",
    [
        ({"picture": np.zeros((5, 6, 3))}, "picture: 6 x 5 is not the size of orientation, 240 x 160"),
        ({"painted": (painted()[0], np.zeros((2, 2)))}, "speed: 2 x 2 is not the size of orientation, 240 x 160"),
        ({"picture": np.full((160, 240, 3), np.nan)}, "picture[0, 0]: nan is not a finite number"),
        ({"width": -1}, "width: -1 is not between 0 and 1000 (px)"),
        ({"amount": 1.5}, "amount: 1.5 is not between 0 and 1"),
    ],
)
def test_bad_input(change, sentence):
    with pytest.raises(stillwater.BadInput) as caught:
        stillwater.refine_flow(**{"painted": painted(), "picture": stripes(0)[0], **change})
    assert str(caught.value) == sentence
