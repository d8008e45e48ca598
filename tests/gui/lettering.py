"""Finds words in a picture of Blender's window, as a reader does: by their shapes, whatever their colour.

Words are drawn with Blender's own font at the size of its buttons and looked for by normalised cross-correlation
(Lewis, Fast Normalized Cross-Correlation, 1995), so no test has to know where a panel puts its buttons.
"""

from functools import cache

import blf
import bpy
import gpu
import numpy as np
from mathutils import Matrix

LIKENESS = 0.9  # correlation from which a place is looked at closer: the word itself gives 0.99
DIFFERENT = 0.5  # of the ink: a place where one pixel differs by more holds another word, "Picture" for "Picture:"
# px that are empty above and below, left and right of a word: no more than between an icon and a word, no less than
# between two words, so that "Tree" is found neither in "Still Tree" nor in "Tree in a Storm".
BLANK = ((1, 1), (4, 6))
FAINTEST = 4.0  # levels of 255: a flatter patch holds no word


@cache
def drawn(text: str) -> np.ndarray:
    """`text` as Blender writes it on a button: H x W, 0..1, rows top to bottom, blank around it."""
    preferences = bpy.context.preferences
    size = preferences.ui_styles[0].widget.points * preferences.system.ui_scale
    blf.size(0, size)
    width, height = int(blf.dimensions(0, text)[0]) + 20, int(2 * size) + 10
    canvas = gpu.types.GPUOffScreen(width, height)
    with canvas.bind(), gpu.matrix.push_pop():
        gpu.state.active_framebuffer_get().clear(color=(0, 0, 0, 1))
        gpu.matrix.load_matrix(Matrix.Translation((-1, -1, 0)) @ Matrix.Diagonal((2 / width, 2 / height, 1, 1)))
        gpu.matrix.load_projection_matrix(Matrix.Identity(4))
        blf.position(0, 10, height // 3, 0)
        blf.color(0, 1, 1, 1, 1)
        blf.draw(0, text)
        buffer = gpu.state.active_framebuffer_get().read_color(0, 0, width, height, 4, 0, "UBYTE")
    canvas.free()
    buffer.dimensions = width * height * 4
    ink = np.array(buffer, np.uint8).reshape(height, width, 4)[::-1, :, 0] / 255
    rows, columns = np.flatnonzero(ink.max(1) > 0.2), np.flatnonzero(ink.max(0) > 0.2)
    return np.pad(ink[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1], BLANK)


def places(picture: np.ndarray, word: np.ndarray) -> list[tuple[int, int]]:
    """Where `word` (from drawn()) stands in `picture` (H x W, 0..255): middles as (x, y), best first."""
    if any(have < need for have, need in zip(picture.shape, word.shape)):
        return []
    likeness = np.abs(correlation(picture, word))
    height, width = word.shape
    found = []
    while likeness.max() >= LIKENESS:
        y, x = np.unravel_index(likeness.argmax(), likeness.shape)
        if _is(picture[y : y + height, x : x + width], word):
            found.append((int(x) + width // 2, int(y) + height // 2))
        likeness[max(0, y - height) : y + height, max(0, x - width) : x + width] = 0
    return found


def _is(patch: np.ndarray, word: np.ndarray) -> bool:
    """Whether `patch` is `word` in some colour on some ground, pixel by pixel."""
    ink, ground = np.polyfit(word.ravel(), patch.ravel(), 1)
    return bool(np.abs(patch - ground - ink * word).max() < DIFFERENT * abs(ink))


def correlation(picture: np.ndarray, word: np.ndarray) -> np.ndarray:
    """Correlation coefficient of `word` with each patch of `picture` of its size; 0 where a patch is flat."""
    word = word - word.mean()
    height, width = word.shape
    size = [-(-(have + need - 1) // 64) * 64 for have, need in zip(picture.shape, word.shape)]  # quick to transform
    product = np.fft.irfft2(np.fft.rfft2(picture, size) * np.fft.rfft2(word[::-1, ::-1], size), size)
    product = product[height - 1 : picture.shape[0], width - 1 : picture.shape[1]]

    def sums(values):
        total = np.pad(values.cumsum(0).cumsum(1), ((1, 0), (1, 0)))
        return total[height:, width:] - total[:-height, width:] - total[height:, :-width] + total[:-height, :-width]

    spread = sums(picture**2) - sums(picture) ** 2 / word.size
    faintest = FAINTEST**2 * word.size
    return np.where(spread > faintest, product / np.sqrt(np.maximum(spread, faintest) * (word**2).sum()), 0)
