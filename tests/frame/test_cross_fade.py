"""Two copies of a layer, cross-faded: neither contrast nor colour pumps as the loop goes round."""

import numpy as np
import pytest
from stage import MATTES, Stage, matte, picture, smooth_picture
from stillwater import _stillwater as engine


def clouds(image, mattes=(MATTES[3], None)):
    return Stage(image=image, mattes=list(mattes), motions=[engine.Drift(), None], ties=[{"endless": (True, False)}, {}], loop=32,
                 velocity=(0.9, 0.0), speed=0.0)


@pytest.mark.parametrize("image", [picture(), smooth_picture()], ids=["noise", "smooth"])
def test_contrast_is_kept_all_along_the_loop(image):
    stage = clouds(image)
    contrast = [stage.frame(t).combined[2:18, :, :3].std(axis=(0, 1)).mean() for t in (1, 5, 9, 13, 17, 25)]
    assert min(contrast) > 0.8 * contrast[0] and max(contrast) < 1.2 * contrast[0]


def test_contrast_is_kept_in_a_picture_so_large_that_its_mean_is_coarse():
    image = smooth_picture(512, 96)
    stage = clouds(image, (matte(0, 40, 0, 512, 512, 96), None))
    contrast = [stage.frame(t).combined[4:36, :, :3].std(axis=(0, 1)).mean() for t in (1, 5, 9, 13, 17, 25)]
    assert min(contrast) > 0.9 * contrast[0] and max(contrast) < 1.1 * contrast[0]


def test_brightness_that_changes_slowly_is_not_mistaken_for_contrast():
    """A sky that is darker to one side: the mean follows it, so half way through it is as bright as both copies."""
    x = np.mgrid[:96, :512][1] / 512
    ramp = 0.5 + 0.3 * np.sin(2 * np.pi * x)
    image = np.dstack([ramp, ramp, ramp, np.ones_like(ramp)]).astype(np.float32)
    stage = clouds(image, (matte(0, 40, 0, 512, 512, 96), None))
    middle = (slice(4, 36), slice(60, 450), slice(0, 3))
    for t in (9, 17, 25):
        assert np.abs(stage.frame(t).combined[middle] - image[middle]).max() < 0.12


def test_a_frame_is_the_same_whichever_came_before():
    """What is measured once a loop is measured the same by any frame."""
    forwards = clouds(picture())
    kept = {t: forwards.frame(t).combined for t in (5, 9, 17, 25)}
    for t in reversed(kept):
        assert np.array_equal(clouds(picture()).frame(t).combined, kept[t])


def test_one_colour_stays_that_colour_also_at_the_outline():
    """A white cloud before a blue sky: what is seen lies between white and blue, never beyond."""
    sky, white = np.float32([0.2, 0.4, 0.8, 1]), np.float32([0.9, 0.9, 0.9, 1])
    outline = np.zeros_like(MATTES[3])
    outline[4:14, 20:60] = 1
    image = np.where(outline[..., None] > 0, white, sky).astype(np.float32)
    stage = clouds(image, (outline, None))
    for t in (5, 17, 25):
        seen = stage.frame(t).combined[..., :3]
        assert seen.max() < 0.9 + 0.02 and seen[..., 0].min() > 0.2 - 0.02
