"""Label maps from what other tools say: an object index, a Cryptomatte, outlines. Needs numpy, no bpy."""

from dataclasses import dataclass

import numpy as np

MOST = 255  # labels that a map of 8 bits holds


@dataclass(frozen=True)
class LabelMap:
    """`labels`: height x width, top row first, 0 = nothing; `names` of the others by their value."""

    labels: np.ndarray
    names: dict[int, str]


def from_index(plane: np.ndarray) -> LabelMap:
    """An Object Index or Material Index pass: each index that is not 0 is a layer."""
    indices = np.rint(np.nan_to_num(plane)).astype(np.int64)
    return _numbered(indices, {index: str(index) for index in np.unique(indices[indices > 0]).tolist()})


def from_cryptomatte(ranks: list[tuple[np.ndarray, np.ndarray]], manifest: dict[str, str]) -> LabelMap:
    """A Cryptomatte (Friedman and Jones 2015): a pixel is of what covers most of it, or of nothing.

    `ranks`: ids, as floats, and coverage, most first; `manifest`: 8 hexadecimal digits of an id by name.
    """
    covered = np.array([coverage for _, coverage in ranks])
    best = covered.argmax(axis=0)[None]
    ids = np.take_along_axis(np.array([ids.astype(np.float32).view(np.uint32) for ids, _ in ranks]), best, 0)[0]
    most = np.take_along_axis(covered, best, 0)[0]
    ids = np.where(most > np.maximum(0, 1 - covered.sum(axis=0)), ids, 0).astype(np.int64)
    named = {int(digits, 16): name for name, digits in manifest.items()}
    return _numbered(ids, {value: named.get(value, f"{value:08x}") for value in np.unique(ids[ids > 0]).tolist()})


def from_outlines(outlines: dict[str, list[np.ndarray]], size: tuple[int, int]) -> LabelMap:
    """Closed outlines (n, 2), px, of each name; earlier names lie in front. `size`: width and height."""
    labels = np.zeros(size[::-1], np.int64)
    names = dict(enumerate(outlines, 1))
    for value, name in reversed(names.items()):
        for outline in outlines[name]:
            labels[inside(outline, size)] = value
    return LabelMap(labels, names)


def inside(outline: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Which pixels have their centre within a closed outline, by the even-odd rule; height x width."""
    width, height = size
    found = np.zeros((height, width), bool)
    start, end = np.asarray(outline, float), np.roll(outline, -1, axis=0)
    for row in range(max(0, int(start[:, 1].min())), min(height, int(start[:, 1].max()) + 1)):
        y = row + 0.5
        crossing = (start[:, 1] <= y) != (end[:, 1] <= y)
        a, b = start[crossing], end[crossing]
        passed = np.sort(a[:, 0] + (b[:, 0] - a[:, 0]) * (y - a[:, 1]) / (b[:, 1] - a[:, 1]))
        columns = np.clip(np.ceil(passed - 0.5), 0, width).astype(int)
        for first, last in zip(columns[::2], columns[1::2], strict=True):
            found[row, first:last] = True
    return found


def _numbered(values: np.ndarray, names: dict[int, str]) -> LabelMap:
    """Values as labels 1, 2, 3 in their order; 0 where a value has no name."""
    labels = np.zeros(values.shape, np.int64)
    for label, value in enumerate(names, 1):
        labels[values == value] = label
    return LabelMap(labels, dict(enumerate(names.values(), 1)))
