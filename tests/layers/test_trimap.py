"""Trimaps from scribbles and outlines: sub-pixel strokes, live wire, and sentences."""

import numpy as np
import pytest
import stillwater

BLANK = np.zeros((40, 60, 3), np.float32)


def stroke(*points, width=10):
    return {"points": [list(point) for point in points], "width": width}


def scribbled(foreground, background):
    return stillwater.trimap(BLANK, scribbles={"foreground": foreground, "background": background})


def test_scribbles_are_known_and_all_else_is_not():
    trimap = scribbled([stroke((10, 10), (20, 10), width=4)], [stroke((10, 30), width=6)])
    y, x = np.mgrid[:40, :60] + 0.5
    line = np.hypot(np.maximum(0, abs(x - 15) - 5), y - 10) <= 2
    dot = np.hypot(x - 10, y - 30) <= 3
    assert np.array_equal(trimap, np.where(line, 1, np.where(dot, 0, 0.5)))


def test_pressure_scales_the_width():
    trimap = scribbled([stroke((10, 20, 0.5), (50, 20, 1.0), width=12)], [stroke((5, 5), width=2)])
    assert list((trimap == 1).sum(axis=0)[[10, 30, 49]]) == [6, 10, 12]


@pytest.mark.parametrize("width", [1e-3, 0.4, 1])
@pytest.mark.parametrize("end", [(50, 4), (50, 30.5), (14, 38), (8.5, 39)])
def test_a_stroke_as_thin_as_a_pixel_has_no_gaps(width, end):
    start = (5.3, 4)
    drawn = scribbled([stroke(start, end, width=width)], [stroke((55, 35), width=2)]) == 1
    rows, columns = np.nonzero(drawn)
    along, across = (rows, columns) if abs(end[1] - start[1]) > abs(end[0] - start[0]) else (columns, rows)
    assert set(along) == set(range(along.min(), along.max() + 1))
    assert drawn[int(start[1]), int(start[0])] and drawn[int(end[1]), int(end[0])]
    assert np.bincount(along)[along.min() :].max() <= 2


def test_a_dot_on_the_corner_of_four_pixels_counts():
    assert (scribbled([stroke((10, 10), width=0.1)], [stroke((30, 30))]) == 1).sum() == 1


def test_what_lies_outside_of_the_picture_is_left_out():
    trimap = scribbled([stroke((-20, 20), (20, 20), width=2)], [stroke((50, -100), (50, 1e6), width=2)])
    assert (trimap[:, :20] == 1).any() and (trimap[:, 50] == 0).all()


@pytest.mark.parametrize(
    "foreground, background, sentence",
    [
        ([], [stroke((3, 3))], r"scribbles.foreground: no stroke is not one stroke or more"),
        ([stroke((3, 3))], [], r"scribbles.background: no stroke is not one stroke or more"),
        ([stroke((-50, 3))], [stroke((3, 3))], r"scribbles.foreground: no stroke touches the picture"),
        ([stroke((3, 3))], [stroke((3, 300))], r"scribbles.background: no stroke touches the picture"),
        ([stroke((3, 3), width=2), stroke((20, 10), (20, 30), width=2)], [stroke((50, 3)), stroke((10, 20), (30, 20), width=2)],
         r"scribbles: foreground\[1\] and background\[1\] contradict each other at \[19, 19\] \(a pixel is one or the other\)"),
        ([{"points": []}], [stroke((3, 3))], r"scribbles.foreground\[0\].points: none is not one point or more"),
        ([stroke((3, 3), width=0)], [stroke((3, 3))], r"scribbles.foreground\[0\].width: 0 is not above 0 \(px\)"),
        ([stroke((3, 3), width=1e6)], [stroke((3, 3))], r"scribbles.foreground\[0\].width: 1e\+06 is not between 0 and 16384"),
        ([stroke((3, np.nan))], [stroke((3, 3))], r"scribbles.foreground\[0\].points\[0\]: -?nan is not a finite number"),
        ([stroke((3, 3))], [stroke((3, 3, 1.5))], r"scribbles.background\[0\].points\[0\], pressure: 1.5 is not between 0 and 1"),
        ([stroke((3,))], [stroke((3, 3))], r"scribbles.foreground\[0\].points\[0\]: 1 numbers are not x, y or x, y, pressure"),
        ([{"width": 3}], [stroke((3, 3))], r"scribbles.foreground\[0\]: width is not points and width"),
    ],
)  # fmt: skip
def test_bad_scribbles_are_a_sentence(foreground, background, sentence):
    with pytest.raises(ValueError, match=sentence):
        scribbled(foreground, background)


def test_other_kinds_of_scribbles():
    with pytest.raises(ValueError, match="scribbles: middle is not foreground or background"):
        stillwater.trimap(BLANK, scribbles={"middle": []})


@pytest.mark.parametrize("given", [{}, {"scribbles": {}, "lasso": []}])
def test_one_of_the_two_is_given(given):
    with pytest.raises(ValueError, match="trimap: one of scribbles and lasso is given, not both or none"):
        stillwater.trimap(BLANK, **given)


SQUARE = [[10, 8], [50, 8], [50, 32], [10, 32]]


def test_a_lasso_is_foreground_inside_and_unknown_within_the_feather():
    trimap = stillwater.trimap(BLANK, lasso=SQUARE, feather=3)
    y, x = np.mgrid[:40, :60] + 0.5
    outside = np.hypot(np.maximum(0, abs(x - 30) - 20), np.maximum(0, abs(y - 20) - 12))
    inside = np.minimum(20 - abs(x - 30), 12 - abs(y - 20))
    known = (outside > 3) | (inside > 3)
    assert np.array_equal(trimap, np.where(known, inside > 3, 0.5))


def test_without_a_feather_nothing_is_unknown():
    trimap = stillwater.trimap(BLANK, lasso=SQUARE, feather=0)
    assert trimap.sum() == 40 * 24 and set(np.unique(trimap)) == {0, 1}
    assert np.array_equal(trimap, stillwater.trimap(BLANK, lasso=SQUARE[::-1], feather=0))


def test_an_outline_that_crosses_itself_goes_round_all_of_it():
    """Twice around the same square, as a hand that passes its beginning does."""
    assert np.array_equal(
        stillwater.trimap(BLANK, lasso=SQUARE + SQUARE, feather=2), stillwater.trimap(BLANK, lasso=SQUARE, feather=2)
    )


def test_an_outline_may_leave_the_picture():
    trimap = stillwater.trimap(BLANK, lasso=[[-50, 20], [200, 20], [200, 500], [-50, 500]], feather=0)
    assert np.all(trimap[:20] == 0) and np.all(trimap[20:] == 1)


def disc(height=120, width=160):
    y, x = np.mgrid[:height, :width] + 0.5
    inside = np.hypot(y - height / 2, x - width / 2) < 40
    picture = np.where(inside[..., None], [0.8, 0.5, 0.3], [0.2, 0.3, 0.4])
    return picture + np.random.default_rng(2).normal(0, 0.02, picture.shape), inside


def around(radius, wobble, height=120, width=160):
    turns = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    radii = radius + wobble * np.sin(5 * turns)
    return np.stack([width / 2 + radii * np.cos(turns), height / 2 + radii * np.sin(turns)], axis=1).tolist()


def test_snap_pulls_the_outline_to_the_edge():
    picture, inside = disc()
    drawn = stillwater.trimap(picture, lasso=around(41, 4), feather=0)
    snapped = stillwater.trimap(picture, lasso=around(41, 4), feather=0, snap=8)
    length = 2 * np.pi * 40
    assert (drawn != inside).sum() > 1.5 * length
    assert (snapped != inside).sum() < 0.75 * length  # less than a pixel along the outline


def test_snap_stays_within_reach():
    picture, _ = disc()
    outline = around(55, 0)
    snapped = stillwater.trimap(picture, lasso=outline, feather=0, snap=4)
    y, x = np.mgrid[:120, :160] + 0.5
    radius = np.hypot(y - 60, x - 80)
    assert np.all(snapped[radius < 49] == 1) and np.all(snapped[radius > 61] == 0)


def test_snap_on_a_flat_picture_keeps_about_what_was_drawn():
    flat = np.full((120, 160, 3), 0.5)
    snapped = stillwater.trimap(flat, lasso=around(40, 0), feather=0, snap=3)
    drawn = stillwater.trimap(flat, lasso=around(40, 0), feather=0)
    assert (snapped != drawn).sum() < 4 * 2 * np.pi * 40


def test_snap_where_the_outline_leaves_the_picture():
    picture, inside = disc()
    outline = [[80, -30], [300, -30], [300, 200], [80, 200]]
    snapped = stillwater.trimap(picture, lasso=outline, feather=0, snap=5)
    assert np.all(snapped[:, 90:] == 1) and np.all(snapped[:, :70] == 0)


@pytest.mark.parametrize(
    "given, sentence",
    [
        ({"lasso": SQUARE[:2]}, "lasso: 2 points are not three or more"),
        ({"lasso": [*SQUARE[:2], [3, np.inf]]}, r"lasso\[2\]: inf is not a finite number"),
        ({"lasso": [*SQUARE[:2], [3]]}, r"lasso\[2\]: 1 numbers are not x, y"),
        ({"lasso": SQUARE, "feather": -1}, r"feather: -1 is not between 0 and 1000 \(px\)"),
        ({"lasso": SQUARE, "snap": 1001}, r"snap: 1001 is not between 0 and 1000 \(px\)"),
        ({"lasso": SQUARE, "feather": 30}, "lasso: no pixel of the picture is inside further than the feather from the outline"),
        ({"lasso": [[100, 100], [120, 100], [110, 120]], "feather": 0}, "lasso: no pixel of the picture is inside$"),
        ({"lasso": [[-9, -9], [99, -9], [99, 99], [-9, 99]], "feather": 2}, "lasso: no pixel of the picture is outside"),
    ],
)
def test_bad_outlines_are_a_sentence(given, sentence):
    with pytest.raises(ValueError, match=sentence):
        stillwater.trimap(BLANK, **given)
