"""What a steady flow carries goes along its streamlines, as exactly as the closed form says."""

import numpy as np
import pytest
import stillwater
from hypothesis import given, settings
from hypothesis import strategies as some
from scipy.integrate import solve_ivp
from scipy.linalg import expm
from scipy.ndimage import map_coordinates
from stillwater import _stillwater as engine

HEIGHT, WIDTH = 80, 100
CENTRE = np.array([49.5, 39.5])
Y, X = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)


def linear(matrix, size=(HEIGHT, WIDTH), centre=CENTRE):
    """The velocity A (p - centre)."""
    y, x = np.mgrid[: size[0], : size[1]]
    return (np.stack([x - centre[0], y - centre[1]], axis=-1) @ np.transpose(matrix)).astype(np.float32)


def gone(matrix, frames):
    """Where that takes a pixel, minus where it was: (e^(A t) - 1)(p - centre)."""
    return linear(expm(np.asarray(matrix) * frames) - np.eye(2))


def stayed_inside(matrix, frames):
    """Pixels whose whole way lies in the picture."""
    inside = np.ones((HEIGHT, WIDTH), bool)
    for share in np.linspace(0, 1, 41):
        way = gone(matrix, frames * share)
        x, y = X + way[..., 0], Y + way[..., 1]
        inside &= (x >= 0) & (x <= WIDTH - 1) & (y >= 0) & (y <= HEIGHT - 1)
    return inside


def swirls(seed=3):
    """A smooth velocity of up to some 2 px/frame."""
    phase = np.random.default_rng(seed).uniform(0, 6.28, 4)
    u = 1.2 * np.sin(Y / 11 + phase[0]) + 0.8 * np.cos(X / 17 + phase[1])
    v = 1.1 * np.sin(X / 13 + phase[2]) - 0.7 * np.cos(Y / 19 + phase[3])
    return np.stack([u, v], axis=-1).astype(np.float32)


def after(first, then):
    """Two maps, one after the other."""
    at = [Y + first[..., 1], X + first[..., 0]]
    return first + np.stack([map_coordinates(then[..., k], at, order=3, mode="nearest") for k in (0, 1)], axis=-1)


@pytest.fixture(autouse=True)
def _default_threads():
    yield
    engine.set_threads(0)


@pytest.mark.parametrize("frames", [1, 7.5, 40, -25])
@pytest.mark.parametrize(
    "matrix",
    [[[0, -0.05], [0.05, 0]], [[0.02, 0], [0, -0.02]], [[0, 0.03], [0, 0]], [[-0.02, 0.03], [-0.01, -0.015]]],
    ids=["rotation", "stretch", "shear", "sink"],
)
def test_linear_fields_move_as_the_matrix_exponential_says(matrix, frames):
    inside = stayed_inside(matrix, frames)
    assert inside.mean() > 0.05
    np.testing.assert_allclose(stillwater.flow_map(linear(matrix), frames)[inside], gone(matrix, frames)[inside], atol=2e-3)


def test_a_swirling_flow_moves_as_another_solver_says():
    velocity = swirls()

    def read(_, place):
        return [map_coordinates(velocity[..., k], [[place[1]], [place[0]]], order=1, mode="nearest")[0] for k in (0, 1)]

    moved = stillwater.flow_map(velocity, 20)
    for x, y in [(50, 40), (20, 60), (70, 15), (45, 5), (3, 77)]:
        end = solve_ivp(read, (0, 20), [x, y], rtol=1e-8, atol=1e-8, max_step=0.2).y[:, -1]
        np.testing.assert_allclose(moved[y, x] + (x, y), end, atol=0.01)


@settings(max_examples=20, deadline=None)
@given(some.floats(-15, 15), some.floats(-15, 15))
def test_two_times_one_after_the_other_are_their_sum(a, b):
    velocity = swirls()
    both = after(stillwater.flow_map(velocity, a), stillwater.flow_map(velocity, b))
    inner = (slice(30, -30), slice(30, -30))
    assert np.abs(both - stillwater.flow_map(velocity, a + b))[inner].max() < 0.1
    assert np.abs(both - stillwater.flow_map(velocity, a + b))[inner].mean() < 0.01


def test_there_and_back_is_nowhere():
    velocity = swirls()
    assert np.abs(after(stillwater.flow_map(velocity, 12), stillwater.flow_map(velocity, -12)))[30:-30, 30:-30].max() < 0.05


def test_no_time_and_no_velocity_move_nothing():
    assert not stillwater.flow_map(swirls(), 0).any()
    assert not stillwater.flow_map(np.zeros((5, 7, 2)), 100).any()


def test_beyond_the_sides_the_last_velocity_holds():
    even = np.full((6, 8, 2), (2.5, -1.5), np.float32)
    np.testing.assert_allclose(stillwater.flow_map(even, 1000), np.full((6, 8, 2), (2500, -1500)), rtol=1e-5)


def test_each_pixel_may_have_a_time_of_its_own():
    velocity, times = swirls(), np.where(X < 50, 3.0, -8.0)
    moved = stillwater.flow_map(velocity, times)
    np.testing.assert_array_equal(moved[:, :50], stillwater.flow_map(velocity, 3)[:, :50])
    np.testing.assert_array_equal(moved[:, 50:], stillwater.flow_map(velocity, -8)[:, 50:])


def test_one_pixel_has_a_flow():
    np.testing.assert_allclose(stillwater.flow_map(np.full((1, 1, 2), 0.5), 4), np.full((1, 1, 2), 2.0), rtol=1e-6)


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_any_number_of_threads(threads):
    expected = stillwater.flow_map(swirls(), 17)
    engine.set_threads(threads)
    np.testing.assert_array_equal(stillwater.flow_map(swirls(), 17), expected)


def blob(centre):
    """A soft spot with alpha."""
    shape = np.exp(-((X - centre[0]) ** 2 + (Y - centre[1]) ** 2) / (2 * 6**2))
    return np.dstack([shape, 0.5 * shape, 1 - shape, 0.25 + 0.75 * shape]).astype(np.float32)


def test_a_rotation_turns_the_picture():
    quarter = stillwater.advect(blob((69.5, 39.5)), linear([[0, -0.05], [0.05, 0]]), np.pi / 2 / 0.05)
    inner = np.hypot(X - CENTRE[0], Y - CENTRE[1]) < 36
    assert np.abs(quarter - blob((49.5, 59.5)))[inner].max() < 0.01


def test_whole_pixels_are_a_shift():
    image = np.random.default_rng(1).random((HEIGHT, WIDTH, 3), np.float32)
    moved = stillwater.advect(image, np.full((HEIGHT, WIDTH, 2), (1.5, -0.5), np.float32), 4)
    np.testing.assert_allclose(moved[:-2, 6:, :3], image[2:, :-6], atol=1e-5)
    assert (moved[..., 3] == 1).all()


@pytest.mark.parametrize(
    "call, sentence",
    [
        (lambda: stillwater.flow_map(np.zeros((4, 4)), 1), "velocity: an array of 4 x 4 is not height x width x 2"),
        (lambda: stillwater.flow_map(np.full((4, 4, 2), np.nan), 1), "velocity: not finite everywhere"),
        (lambda: stillwater.flow_map(np.zeros((4, 4, 2)), 1e6), "frames: 1e\\+06 is not between -10000 and 10000"),
        (lambda: stillwater.flow_map(np.zeros((4, 4, 2)), np.inf), "frames: inf is not"),
        (lambda: stillwater.flow_map(np.zeros((4, 4, 2)), np.zeros((4, 5))), "frames: "),
        (lambda: stillwater.flow_map(np.zeros((4, 4, 2)), np.full((4, 4), np.nan)), "frames"),
        (lambda: stillwater.advect(np.zeros((4, 4, 3)), np.zeros((4, 5, 2)), 1), "velocity: "),
        (lambda: stillwater.advect(np.zeros((4, 4)), np.zeros((4, 4, 2)), 1), "image: an array of 4 x 4 is not"),
    ],
)
def test_what_is_refused(call, sentence):
    with pytest.raises(ValueError, match=sentence):
        call()
