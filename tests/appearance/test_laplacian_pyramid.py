"""The Laplacian pyramid: exact, and Burt and Adelson's."""

import numpy as np
import pytest
import stillwater
from scipy.ndimage import convolve
from stillwater import _stillwater as engine

KERNEL = np.outer([1, 4, 6, 4, 1], [1, 4, 6, 4, 1]) / 256


def noise(shape):
    return np.random.default_rng(4).random(shape).astype(np.float32)


@pytest.mark.parametrize("shape", [(64, 64), (63, 75), (17, 23)])
def test_collapse_is_exact(shape):
    image = noise(shape)
    given = image.copy()
    levels = engine.laplacian_pyramid(image, 3)
    np.testing.assert_array_equal(image, given)
    assert [level.shape for level in levels] == [tuple(-(-side // 2**k) for side in shape) for k in range(4)]
    np.testing.assert_allclose(engine.collapse_laplacian(levels), image, atol=2e-7)


def test_levels_are_those_of_the_paper():
    image = noise((40, 56))
    fine, coarse = engine.laplacian_pyramid(image, 1)
    reduced = convolve(image.astype(float), KERNEL, mode="mirror")[::2, ::2]
    spread = np.zeros(image.shape)
    spread[::2, ::2] = reduced
    inner = np.s_[4:-4, 4:-4]
    np.testing.assert_allclose(coarse, reduced, atol=1e-6)
    np.testing.assert_allclose(fine[inner], (image - 4 * convolve(spread, KERNEL))[inner], atol=1e-6)


def test_what_cannot_be_is_refused():
    with pytest.raises(stillwater.BadInput, match="scales: 5 is not a number of halvings that leaves 2 pixels a side of 40 x 32"):
        engine.laplacian_pyramid(noise((32, 40)), 5)
    with pytest.raises(stillwater.BadInput, match="levels: 0 is not at least 1"):
        engine.collapse_laplacian([])
    with pytest.raises(stillwater.BadInput, match="levels: 5 x 5 is not half of 40 x 32"):
        engine.collapse_laplacian([noise((32, 40)), noise((5, 5))])
