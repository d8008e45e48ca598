"""A colour label map, as it is or as JPEG left it, into whole regions of one label each."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

STEP = 32  # colours this near are one label: more than JPEG's noise, less than the distance of two labels
SMALLEST_COLOUR = 0.004  # share of the map; fewer pixels are an edge's mixture
SMALLEST_REGION = 0.004
SPECKLE = 5  # pixels; the window of the majority that removes single wrong pixels at edges


def real_colours(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
    """The few colours a map was drawn with: N x 3, the most frequent first.

    Cells of a coarse cube that hold enough pixels; cells that touch are one colour.
    """
    flat = pixels.reshape(-1, 3)
    sides = 256 // STEP + 1
    cells = (flat.astype(int) + STEP // 2) // STEP
    counts = np.bincount(np.ravel_multi_index(cells.T, (sides,) * 3), minlength=sides**3)
    often = counts.reshape((sides,) * 3) > SMALLEST_COLOUR * len(flat)
    groups, number = ndimage.label(often, ndimage.generate_binary_structure(3, 3))
    group = groups[tuple(cells.T)]
    means = [(np.sum(group == g), flat[group == g].mean(axis=0)) for g in range(1, number + 1)]
    return np.array([mean for _, mean in sorted(means, key=lambda m: -m[0])])


def label_map(pixels: NDArray[np.uint8]) -> NDArray[np.int64]:
    """Of each pixel the index of the nearest of real_colours(), mixtures at edges given to one side."""
    colours = real_colours(pixels)
    distance = ((pixels[..., None, :].astype(float) - colours) ** 2).sum(axis=-1)
    nearest = distance.argmin(axis=-1)
    votes = [ndimage.uniform_filter((nearest == label).astype(np.float32), SPECKLE) for label in range(len(colours))]
    return np.argmax(votes, axis=0)


def regions(labels: NDArray[np.int64]) -> list[NDArray[np.bool_]]:
    """The connected parts of each label that are large enough to be something, from large to small."""
    found = []
    for label in range(labels.max() + 1):
        parts, number = ndimage.label(labels == label)
        sizes = ndimage.sum_labels(parts > 0, parts, np.arange(1, number + 1))
        found += [(size, parts == part + 1) for part, size in enumerate(sizes) if size > SMALLEST_REGION * labels.size]
    return [region for _, region in sorted(found, key=lambda entry: -entry[0])]
