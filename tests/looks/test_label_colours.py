"""A label map comes back as it was drawn, whatever JPEG has made of it."""

import io

import numpy as np
import pytest
from label_colours import label_map, real_colours, regions
from PIL import Image

COLOURS = np.array([(0, 0, 0), (255, 255, 255), (0, 255, 0), (255, 0, 0)])


def drawn():
    """A city between sky and water, and a red spot in the sky."""
    labels = np.zeros((120, 160), int)
    labels[50:, :] = 1
    labels[90:, :] = 2
    labels[10:30, 100:130] = 3
    return labels


def through_jpeg(labels, quality):
    file = io.BytesIO()
    Image.fromarray(COLOURS[labels].astype(np.uint8)).save(file, "JPEG", quality=quality)
    return np.asarray(Image.open(file).convert("RGB"))


@pytest.mark.parametrize("quality", [95, 60])
def test_jpeg_leaves_as_many_colours_as_were_drawn(quality):
    found = real_colours(through_jpeg(drawn(), quality))
    assert len(found) == len(COLOURS)
    assert all(abs(COLOURS - colour).max(axis=1).min() < 12 for colour in found)


def test_all_but_edges_gets_its_label_back():
    labels = drawn()
    found = label_map(through_jpeg(labels, 60))
    pairs = {(a, b) for a, b in zip(labels[::7, ::7].ravel(), found[::7, ::7].ravel(), strict=True)}
    assert len(pairs) == len(COLOURS)


def test_parts_of_one_label_are_apart_and_crumbs_are_none():
    labels = np.zeros((100, 100), int)
    labels[10:40, 10:30] = labels[10:40, 60:80] = 1
    labels[70:73, 70:73] = 1
    assert sorted(int(region.sum()) for region in regions(labels)) == [600, 600, 100 * 100 - 1200 - 9]
