"""The outline of a matte, by marching squares (Lorensen and Cline 1987, in the plane). Knows nothing of Blender."""

import numpy as np

# Sides of a cell, by number: top, right, bottom, left. Which of them a case's lines join; a case is the sum of 1, 2, 4, 8
# for the corners (upper left, upper right, lower right, lower left) that lie inside.
TOP, RIGHT, BOTTOM, LEFT = range(4)
JOINED = {
    1: [(LEFT, TOP)], 2: [(TOP, RIGHT)], 3: [(LEFT, RIGHT)], 4: [(RIGHT, BOTTOM)], 5: [(LEFT, TOP), (RIGHT, BOTTOM)],
    6: [(TOP, BOTTOM)], 7: [(LEFT, BOTTOM)], 8: [(BOTTOM, LEFT)], 9: [(BOTTOM, TOP)], 10: [(TOP, RIGHT), (BOTTOM, LEFT)],
    11: [(BOTTOM, RIGHT)], 12: [(RIGHT, LEFT)], 13: [(RIGHT, TOP)], 14: [(TOP, LEFT)],
}  # fmt: skip


SPECK = 1e-4  # of the picture's area: an outline round less is left out ...
PART = 0.01  # ... where it goes round less than this of what the largest outline goes round


def outline(coverage: np.ndarray, level: float = 0.5) -> np.ndarray:
    """Lines x 2 ends x 2 (x, y): where a matte of height x width passes `level`, pixel centres at halves.

    Beyond its borders the matte is 0, so that an outline is closed. Round single leaves, and holes as small, there is
    none.
    """
    field = np.pad(np.asarray(coverage, np.float32), 1)
    inside = field >= level
    case = inside[:-1, :-1] + 2 * inside[:-1, 1:] + 4 * inside[1:, 1:] + 8 * inside[1:, :-1]
    lines, sides = [np.empty((0, 2, 2), np.float32)], [np.empty((0, 2), np.int64)]
    for number, joined in JOINED.items():
        rows, columns = np.nonzero(case == number)
        for ends in joined:
            lines.append(np.stack([_crossing(field, rows, columns, side, level) for side in ends], axis=1))
            sides.append(np.stack([_number(case.shape, rows, columns, side) for side in ends], axis=1))
    lines = np.concatenate(lines) - 0.5  # of the padding's pixel, to places
    return lines[_is_large(lines, np.concatenate(sides), SPECK * coverage.size)]


def _is_large(lines: np.ndarray, sides: np.ndarray, speck: float) -> np.ndarray:
    """Which lines belong to an outline that is no speck. `sides`: of cells, where each line begins and ends."""
    if not len(lines):
        return np.zeros(0, bool)
    loops = _loops(np.unique(sides, return_inverse=True)[1].reshape(sides.shape))
    (ax, ay), (bx, by) = np.moveaxis(lines.astype(np.float64), 0, 2)
    areas = np.abs(np.bincount(loops, (ax * by - bx * ay) / 2))  # of each loop, by Gauss's formula
    return (areas >= min(speck, PART * areas.max()))[loops]


def _loops(ends: np.ndarray) -> np.ndarray:
    """The number of the closed outline that each line is part of, from the numbers of its two ends."""
    least = np.arange(ends.max() + 1)  # of the ends that are known to hang together
    while True:
        joined = least[ends].min(axis=1)
        before = least.copy()
        for end in ends.T:
            np.minimum.at(least, end, joined)
        while (least[least] != least).any():
            least = least[least]
        if (least == before).all():
            return least[ends[:, 0]]


def _number(shape: tuple[int, int], rows, columns, side: int) -> np.ndarray:
    """A number for one side of cells, the same for the cell on its other side."""
    down, across = rows + (side == BOTTOM), columns + (side == RIGHT)
    along_x = side in (TOP, BOTTOM)
    return 2 * (down * (shape[1] + 1) + across) + along_x


def _crossing(field: np.ndarray, rows, columns, side: int, level: float) -> np.ndarray:
    """Where the level is passed on one side of cells."""
    down, across = {TOP: (0, 0), RIGHT: (0, 1), BOTTOM: (1, 0), LEFT: (0, 0)}[side]
    y, x = rows + down, columns + across
    along_x = side in (TOP, BOTTOM)
    first, second = field[y, x], field[y + (not along_x), x + along_x]
    share = (level - first) / (second - first)
    return np.stack([x + share * along_x, y + share * (not along_x)], axis=1).astype(np.float32)
