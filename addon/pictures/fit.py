"""How a viewport looks through a picture's camera, so that the picture is seen whole beside what lies over its edges.

Blender's own Center Camera fits it to all of the viewport, the part below the sidebar as well. Knows nothing of Blender.
"""

from dataclasses import dataclass
from math import sqrt

MARGIN = 8  # px left free around the picture
ZOOMS = (-30.0, 600.0)  # Blender's


@dataclass(frozen=True)
class Box:
    """A rectangle of the screen, px."""

    x: float
    y: float
    width: float
    height: float

    @property
    def middle(self) -> tuple[float, float]:
        return self.x + self.width / 2, self.y + self.height / 2


def free(viewport: Box, over: list[tuple[str, Box]]) -> Box:
    """What of a viewport nothing lies over: `over` are boxes that lie along an edge, LEFT, RIGHT, TOP or BOTTOM."""
    left, bottom = viewport.x, viewport.y
    right, top = left + viewport.width, bottom + viewport.height
    for edge, box in over:
        match edge:
            case "LEFT":
                left = max(left, box.x + box.width)
            case "RIGHT":
                right = min(right, box.x)
            case "BOTTOM":
                bottom = max(bottom, box.y + box.height)
            case "TOP":
                top = min(top, box.y)
    return Box(left, bottom, right - left, top - bottom)


def above(size: tuple[int, int], other: tuple[int, int], gap: float = 0.0) -> tuple[float, float]:
    """The share of width and height that a picture has of itself with another below it, both with equal longer sides.

    `gap`: between them and below them, of that side.
    """
    (width, height), (below_width, below_height) = ([side / max(both) for side in both] for both in (size, other))
    return width / max(width, below_width), height / (height + below_height + 2 * gap)


def upper(box: Box, share: tuple[float, float]) -> Box:
    """That share of a box: of its width in the middle, of its height above."""
    width, height = box.width * share[0], box.height * share[1]
    return Box(box.x + (box.width - width) / 2, box.y + box.height - height, width, height)


def view_of(viewport: Box, within: Box, size: tuple[int, int]) -> tuple[float, tuple[float, float]]:
    """Blender's zoom and offset of a camera's view, where a picture of `size` pixels is to lie in the middle of `within`.

    At zoom z the picture's longer side is f = (sqrt(2) + z / 50)^2 / 4 times as long as the viewport's longer side. An
    offset of (x, y) moves it by 2 f (x, y) times the viewport's width and height, to the left and down.
    """
    longer = max(size)
    room = min(side / (part / longer) for side, part in zip((within.width, within.height), size, strict=True))
    wanted = max(1.0, room - 2 * MARGIN) / max(viewport.width, viewport.height)
    zoom = min(max(50 * (2 * sqrt(wanted) - sqrt(2)), ZOOMS[0]), ZOOMS[1])
    factor = (sqrt(2) + zoom / 50) ** 2 / 4
    sides = zip(viewport.middle, within.middle, (viewport.width, viewport.height), strict=True)
    x, y = ((middle - to) / (2 * factor * side) for middle, to, side in sides)
    return zoom, (x, y)
