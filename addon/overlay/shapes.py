"""The lines that are drawn over a picture, in its pixels, from its recipe: what the engine will use is what is seen.

Knows nothing of Blender. `live` is a stillwater.Live that has frames, or None: then nothing bends, and no gust is seen.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, radians, sin, sqrt

from .water import Point, WaterPlane, grid

ORANGE, BLUE, YELLOW, WHITE = (1.0, 0.45, 0.05), (0.35, 0.7, 1.0), (1.0, 0.9, 0.4), (0.95, 0.95, 0.95)
BLACK = (0.03, 0.03, 0.03)
AWAY = 0.45  # how long a way away from the viewer is drawn, of one to the right
PIECES = 24  # of a sway line
STRONG, FAINT = 1.0, 0.45


@dataclass(frozen=True)
class Lines:
    """Ends of lines, two and two, and how opaque each is."""

    colour: tuple[float, float, float]
    width: float  # px on the screen
    ends: list[Point]
    alphas: list[float]


@dataclass(frozen=True)
class Subject:
    """What is drawn of: a recipe, the picture's size, the frame, the active layer's name, the engine's live side."""

    recipe: dict
    size: tuple[int, int]
    frame: int
    active: str
    live: object | None = None

    def moved(self, layer: str, points: list[Point]) -> list[Point]:
        """Points of the picture at this frame, as part of a layer."""
        if self.live is None or layer not in self.live.layers:
            return points
        return self.live.moved(self.frame, layer, points)


def sway_lines(subject: Subject) -> Iterator[Lines]:
    """Each from root to tip, bent; a straight, faint one where it is at rest; a cross at the root."""
    for layer in _moving(subject, "sway"):
        root, tip = layer["motion"]["armature"]
        if tuple(root) == tuple(tip):  # not drawn yet
            continue
        points = [_between(root, tip, i / PIECES) for i in range(PIECES + 1)]
        alpha = STRONG if layer["name"] == subject.active else FAINT
        yield _chain(ORANGE, 1, [root, tip], 0.4 * alpha)
        yield _chain(ORANGE, 3, subject.moved(layer["name"], points), alpha)
        yield _cross(ORANGE, root, 0.008 * subject.size[0], alpha)


def waterlines(subject: Subject) -> Iterator[Lines]:
    """Each along its hull, where the water has it; a faint one where it is at rest."""
    for layer in _moving(subject, "bob"):
        points = [tuple(point) for point in layer["motion"]["waterline"]]
        alpha = STRONG if layer["name"] == subject.active else FAINT
        yield _chain(BLUE, 1, points, 0.4 * alpha)
        yield _chain(BLUE, 3, subject.moved(layer["name"], points), alpha)


def water(subject: Subject) -> Iterator[Lines]:
    """The plane up to the horizon, fading towards it, while the active layer is water or floats."""
    view = subject.recipe["view"]
    layer = next((each for each in subject.recipe["layers"] if each["name"] == subject.active), None)
    if layer is None or layer["motion"]["type"] not in ("ripple", "bob") or "horizon" not in view:
        return
    (x0, y0), (x1, y1) = view["horizon"]
    if (x0, y0) == (x1, y1):
        return
    plane = WaterPlane(view["horizon"], view["fov"], view["height"], subject.size)
    lines = grid(plane, subject.size)
    if not lines:
        return
    ends = [end for line in lines for end in line]
    below = [max(0.0, plane.level(end)[1] - plane.horizon) for end in ends]
    deepest = max(below) or 1.0
    yield Lines(BLUE, 1, ends, [0.12 + 0.5 * sqrt(depth / deepest) for depth in below])
    on_horizon = [end for line, depth in zip(lines, below[::2], strict=True) if depth < 1e-6 for end in line]
    yield Lines(BLUE, 2, on_horizon, [0.8] * len(on_horizon))


def wind(subject: Subject) -> Iterator[Lines]:
    """An arrow over the ground near the upper left corner, and, where it gusts, small ones all over the picture."""
    number = subject.recipe["wind"]
    speed, direction = (_at(number[name], subject.frame) for name in ("speed", "direction"))
    if not speed:
        return
    way = cos(radians(direction)), -AWAY * sin(radians(direction))
    width, height = subject.size
    unit = 0.035 * min(width, height) * sqrt(speed)
    place = (0.12 * min(width, height) + 0.5 * unit, 0.12 * min(width, height))
    yield _arrow(YELLOW, 3, place, way, unit, 0.95)
    if subject.live is None or not _at(number["gusts"], subject.frame):
        return
    places = [(width * (i + 0.5) / 12, height * (j + 0.5) / 7) for j in range(7) for i in range(12)]
    ends, alphas = [], []
    for place, (_, _, factor) in zip(places, subject.live.gust(subject.frame, places), strict=True):
        small = _arrow(YELLOW, 1, place, way, 0.45 * unit * factor, min(0.75, 0.25 * factor))
        ends += small.ends
        alphas += small.alphas
    yield Lines(YELLOW, 1, ends, alphas)


def outline(lines, scale: float) -> Iterator[Lines]:
    """Lines of outline.outline(), of a matte that has `scale` pixels for one of the picture."""
    ends = _ends(lines, scale)
    yield Lines(WHITE, 1.5, ends, [0.9] * len(ends))


def marching(lines, scale: float, dash: float, step: float) -> Iterator[Lines]:
    """The same in dashes of `dash` picture pixels, black and white, that have gone on by a share `step` of a dash."""
    ends = _ends(lines, scale)
    middles = [(ends[i][0] + ends[i + 1][0] + ends[i][1] + ends[i + 1][1]) / 2 for i in range(0, len(ends), 2)]
    bright = [(middle / dash + step) % 2 < 1 for middle in middles]
    for colour, shown in ((BLACK, False), (WHITE, True)):
        part = [end for i, lit in enumerate(bright) if lit == shown for end in ends[2 * i : 2 * i + 2]]
        yield Lines(colour, 1.5, part, [0.9] * len(part))


def _ends(lines, scale: float) -> list[Point]:
    return [(x / scale, y / scale) for line in lines.tolist() for x, y in line]


def _moving(subject: Subject, kind: str) -> list[dict]:
    return [each for each in subject.recipe["layers"] if each["visible"] and each["motion"]["type"] == kind]


def _at(number, frame: int) -> float:
    """An animated number of the recipe."""
    if not isinstance(number, dict):
        return number
    return number["values"][min(max(0, frame - number["first"]), len(number["values"]) - 1)]


def _between(a: Point, b: Point, share: float) -> Point:
    return a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])


def _chain(colour, width: float, points: list[Point], alpha: float) -> Lines:
    ends = [end for i in range(len(points) - 1) for end in points[i : i + 2]]
    return Lines(colour, width, ends, [alpha] * len(ends))


def _cross(colour, at: Point, size: float, alpha: float) -> Lines:
    x, y = at
    ends = [(x - size, y), (x + size, y), (x, y - size), (x, y + size)]
    return Lines(colour, 2, ends, [alpha] * 4)


def _arrow(colour, width: float, middle: Point, way: Point, length: float, alpha: float) -> Lines:
    """Its head lies in the ground's plane, as its shaft does."""
    x, y = middle
    side = -way[1] / AWAY, AWAY * way[0]  # the way turned by a right angle, over the ground
    tail, tip = (x - way[0] * length / 2, y - way[1] * length / 2), (x + way[0] * length / 2, y + way[1] * length / 2)
    ends = [tail, tip]
    for sign in (1, -1):
        back = tuple(tip[i] - (0.3 * way[i] + sign * 0.16 * side[i]) * length for i in (0, 1))
        ends += [tip, back]
    return Lines(colour, width, ends, [alpha] * len(ends))
