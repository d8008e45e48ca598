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


def outline(coverage: np.ndarray, level: float = 0.5) -> np.ndarray:
    """Lines x 2 ends x 2 (x, y): where a matte of height x width passes `level`, pixel centres at halves.

    Beyond its borders the matte is 0, so that an outline is closed.
    """
    field = np.pad(np.asarray(coverage, np.float32), 1)
    inside = field >= level
    case = inside[:-1, :-1] + 2 * inside[:-1, 1:] + 4 * inside[1:, 1:] + 8 * inside[1:, :-1]
    lines = [np.empty((0, 2, 2), np.float32)]
    for number, joined in JOINED.items():
        rows, columns = np.nonzero(case == number)
        for start, end in joined:
            lines.append(np.stack([_crossing(field, rows, columns, side, level) for side in (start, end)], axis=1))
    return np.concatenate(lines) - 0.5  # of the padding's pixel, to places


def _crossing(field: np.ndarray, rows, columns, side: int, level: float) -> np.ndarray:
    """Where the level is passed on one side of cells."""
    down, across = {TOP: (0, 0), RIGHT: (0, 1), BOTTOM: (1, 0), LEFT: (0, 0)}[side]
    y, x = rows + down, columns + across
    along_x = side in (TOP, BOTTOM)
    first, second = field[y, x], field[y + (not along_x), x + along_x]
    share = (level - first) / (second - first)
    return np.stack([x + share * along_x, y + share * (not along_x)], axis=1).astype(np.float32)
