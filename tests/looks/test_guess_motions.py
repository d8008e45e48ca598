"""Place and shape of a region tell how it moves."""

import numpy as np
import pytest
from guess_motions import depth, guess_motion, shore

HEIGHT, WIDTH = 200, 300


def region(top, bottom, left, right):
    found = np.zeros((HEIGHT, WIDTH), bool)
    found[top:bottom, left:right] = True
    return found


def leaning():
    """A trunk and its crown, to the right of it."""
    return region(120, 190, 100, 110) | region(60, 120, 120, 160) | region(110, 122, 100, 160)


@pytest.mark.parametrize(
    "shape, motion",
    [
        (region(0, 90, 0, 300), "drift"),
        (region(30, 60, 100, 180), "drift"),
        (region(110, 200, 0, 300), "ripple"),
        (leaning(), "sway"),
        (region(0, 200, 0, 300), "still"),
        (region(0, 160, 0, 300), "still"),
        (region(90, 120, 0, 300), "still"),
        (region(150, 155, 20, 25), "still"),
        (np.tri(HEIGHT, WIDTH, dtype=bool), "still"),
    ],
)
def test_place_and_shape_tell_the_motion(shape, motion):
    assert guess_motion(shape)["type"] == motion


def test_the_armature_leads_from_the_lowest_middle_to_the_highest():
    assert guess_motion(leaning())["armature"] == [[105, 190], [140, 60]]


def test_water_begins_at_its_shore_whatever_falls_into_it():
    waterfall = region(40, 120, 140, 170)
    row, agreeing = shore(region(120, 200, 0, 300) | waterfall)
    assert row == 120 and agreeing == 0.9


def test_the_sky_lies_behind_all_and_what_floats_in_it_before():
    sky, cloud, land = region(0, 90, 0, 300), region(30, 60, 100, 180), region(90, 120, 0, 300)
    order = sorted((land, sky, cloud), key=lambda part: depth(part, guess_motion(part)))
    assert [part is found for part, found in zip((cloud, land, sky), order, strict=True)] == [True] * 3
