"""The matting Laplacian against its definition, and the solver against a direct one."""

import numpy as np
import pytest
import scipy.sparse
import scipy.sparse.linalg
from stillwater import _stillwater as engine

EPSILON = 1e-7


def noise(height, width, seed=5):
    rgb = np.random.default_rng(seed).random((height, width, 3))
    return np.concatenate([rgb, np.ones((height, width, 1))], axis=2).astype(np.float32)


def mixed(height, width, seed=6):
    """A soft edge between two noisy colours, with a known strip at both sides."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[:height, :width]
    alpha = np.clip((x - width / 2 + 5 * np.sin(y / 4)) / 12 + 0.5, 0, 1)[..., None]
    front = [0.8, 0.5, 0.2] + 0.1 * rng.standard_normal((height, width, 3))
    back = [0.1, 0.3, 0.6] + 0.1 * rng.standard_normal((height, width, 3))
    rgb = np.clip(alpha * front + (1 - alpha) * back, 0, 1)
    trimap = np.full((height, width), 0.5, np.float32)
    trimap[:, :3], trimap[:, -3:] = 0, 1
    return np.concatenate([rgb, np.ones((height, width, 1))], axis=2).astype(np.float32), trimap


def by_definition(image, epsilon):
    """Levin, Lischinski and Weiss 2008, eq. 12, window by window."""
    height, width = image.shape[:2]
    laplacian = np.zeros((height * width, height * width))
    for y in range(1, height - 1):
        for x in range(1, width - 1):
            pixels = [(y + j) * width + x + i for j in (-1, 0, 1) for i in (-1, 0, 1)]
            colours = image.reshape(-1, 4)[pixels, :3].astype(float)
            off = colours - colours.mean(axis=0)
            inverse = np.linalg.inv(off.T @ off / 9 + epsilon / 9 * np.eye(3))
            laplacian[np.ix_(pixels, pixels)] += np.eye(9) - (1 + off @ inverse @ off.T) / 9
    return laplacian


def whole_laplacian(image, epsilon=EPSILON):
    count = image.shape[0] * image.shape[1]
    rows, columns, values, pixels, right = engine.matting_laplacian(image, np.full(image.shape[:2], 0.5), epsilon)
    assert pixels == list(range(count)) and not any(right)
    return scipy.sparse.csr_matrix((values, (rows, columns)), (count, count))


@pytest.mark.parametrize("shape", [(3, 3), (9, 12), (20, 5)])
def test_it_is_what_the_paper_defines(shape):
    image = noise(*shape)
    assert np.abs(whole_laplacian(image, 1e-4).toarray() - by_definition(image, 1e-4)).max() < 1e-9


def test_flat_and_grey_pictures_are_no_exception():
    for image in (np.full((6, 7, 4), 0.5, np.float32), np.repeat(noise(6, 7)[..., :1], 4, axis=2)):
        assert np.abs(whole_laplacian(image, 1e-4).toarray() - by_definition(image, 1e-4)).max() < 1e-6


def test_it_is_symmetric_and_no_alpha_has_negative_energy():
    dense = whole_laplacian(noise(10, 11)).toarray()
    assert np.abs(dense - dense.T).max() < 1e-12
    assert np.linalg.eigvalsh(dense).min() > -1e-10


def test_constants_and_affine_functions_of_colour_cost_nothing():
    image = noise(10, 11)
    laplacian = whole_laplacian(image)
    assert np.abs(laplacian @ np.ones(110)).max() < 1e-10
    affine = image.reshape(-1, 4)[:, :3].astype(float) @ [0.3, -0.7, 0.2] + 0.4
    assert affine @ (laplacian @ affine) < 1e-5


def test_what_is_known_goes_to_the_right():
    image, trimap = mixed(14, 17)
    rows, columns, values, pixels, right = engine.matting_laplacian(image, trimap, EPSILON)
    dense, unknown = by_definition(image, EPSILON), trimap.ravel() == 0.5
    assert np.array_equal(np.flatnonzero(unknown), pixels)
    ours = scipy.sparse.csr_matrix((values, (rows, columns)), dense.shape).toarray()
    assert np.abs(ours[np.ix_(unknown, unknown)] - dense[np.ix_(unknown, unknown)]).max() < 1e-8
    assert np.all(ours[:, ~unknown] == 0)
    assert np.abs(right + dense[np.ix_(unknown, ~unknown)] @ trimap.ravel()[~unknown]).max() < 1e-8


def direct(image, trimap, weight=None, pull=None):
    """The same system, solved by SuperLU."""
    rows, columns, values, pixels, right = engine.matting_laplacian(image, trimap, EPSILON)
    number = np.full(trimap.size, -1)
    number[pixels] = np.arange(len(pixels))
    matrix = scipy.sparse.csc_matrix((values, (number[rows], number[columns])))
    right = np.array(right)
    if weight is not None:
        matrix = matrix + scipy.sparse.diags(weight.ravel()[pixels].astype(float))
        right += (weight * pull).ravel()[pixels].astype(float)
    alpha = trimap.ravel().astype(float)
    alpha[pixels] = scipy.sparse.linalg.spsolve(matrix.tocsc(), right)
    return alpha.reshape(trimap.shape)


@pytest.mark.parametrize("shape", [(40, 60), (150, 190), (3, 40), (40, 9)])
def test_the_solution_is_that_of_a_direct_solver(shape):
    image, trimap = mixed(*shape)
    alpha, iterations = engine.closed_form_matte(image, trimap, tolerance=1e-6)
    expected = direct(image, trimap)
    assert np.abs(alpha - expected).max() < 1e-4
    assert iterations < 100


@pytest.mark.parametrize("spacing", [2, 4, 6, 9])
def test_every_spacing_of_the_coarse_grid_gives_it(spacing):
    image, trimap = mixed(40, 60)
    alpha, _ = engine.closed_form_matte(image, trimap, tolerance=1e-6, spacing=spacing)
    assert np.abs(alpha - direct(image, trimap)).max() < 1e-4


def test_thin_scribbles_decide_large_areas():
    image, trimap = mixed(150, 190)
    trimap[:], trimap[70:75, 20], trimap[80:85, 170] = 0.5, 0, 1
    alpha, iterations = engine.closed_form_matte(image, trimap, tolerance=1e-6)
    assert np.abs(alpha - direct(image, trimap)).max() < 1e-4
    assert iterations < 150


def test_flat_colours_are_solved_too():
    image = np.full((50, 60, 4), 0.25, np.float32)
    image[:, 30:, :3] = 0.75
    trimap = np.full((50, 60), 0.5, np.float32)
    trimap[:, 0], trimap[:, -1] = 0, 1
    alpha, iterations = engine.closed_form_matte(image, trimap, tolerance=1e-6)
    assert np.abs(alpha - direct(image, trimap)).max() < 1e-4
    assert iterations < 60


def test_a_prior_pulls():
    image, trimap = mixed(40, 60)
    pull = np.random.default_rng(1).random(trimap.shape).astype(np.float32)
    weight = np.random.default_rng(2).random(trimap.shape).astype(np.float32)
    alpha, _ = engine.closed_form_matte(image, trimap, tolerance=1e-6, prior_alpha=pull, prior_weight=weight)
    assert np.abs(alpha - direct(image, trimap, weight, pull)).max() < 1e-4


def test_the_same_bytes_for_any_number_of_threads():
    image, trimap = mixed(90, 110)
    alphas = []
    for threads in (1, 2, 5):
        engine.set_threads(threads)
        alphas.append(engine.closed_form_matte(image, trimap)[0])
    engine.set_threads(0)
    assert np.array_equal(alphas[0], alphas[1]) and np.array_equal(alphas[0], alphas[2])
