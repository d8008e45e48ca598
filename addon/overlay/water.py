"""The water's plane in a picture, as the engine's view has it (motion/view.h): a level plane under a pinhole camera
whose principal point is the picture's centre, and whose horizon is a line. Knows nothing of Blender.
"""

from math import ceil, floor, hypot, log10, radians, tan

Point = tuple[float, float]
DISTANCES = [step * 10.0**power for power in range(-2, 6) for step in (1, 2, 5)]  # m
LINES = 12  # to each side, that run away from the eye
CLOSEST = 0.015  # of the picture's height: lines across that are nearer to the horizon are left out


class WaterPlane:
    """`horizon`: two points, px; `fov` in degrees, horizontal; `height` of the eye, m; `size` of the picture, px.

    Throws ValueError for a horizon without a length.
    """

    def __init__(self, horizon: tuple[Point, Point], fov: float, height: float, size: tuple[int, int]):
        (x0, y0), (x1, y1) = horizon
        length = hypot(x1 - x0, y1 - y0)
        if not length:
            raise ValueError("horizon: has no length")
        self._along = (x1 - x0) / length, (y1 - y0) / length
        # The water lies where y grows; at the right of an upright horizon.
        if self._along[0] < 0 or (self._along[0] == 0 and self._along[1] > 0):
            self._along = -self._along[0], -self._along[1]
        self._centre = size[0] / 2, size[1] / 2
        self._focal = size[0] / 2 / tan(radians(fov) / 2)
        self._height = height
        self.horizon = self.level((x0, y0))[1]
        self._slanted = hypot(self._focal, self.horizon)

    def level(self, picture: Point) -> Point:
        """Coordinates counted from the picture's centre, turned so that the horizon runs along x."""
        (ax, ay), x, y = self._along, picture[0] - self._centre[0], picture[1] - self._centre[1]
        return ax * x + ay * y, ax * y - ay * x

    def picture(self, level: Point) -> Point:
        """The other way."""
        (ax, ay), (x, y) = self._along, level
        return self._centre[0] + ax * x - ay * y, self._centre[1] + ay * x + ax * y

    def seen(self, right: float, away: float) -> Point | None:
        """Where a point of the water is seen, metres from the foot of the eye; None behind the picture's plane."""
        f, horizon, slanted = self._focal, self.horizon, self._slanted
        depth = (away * f - self._height * horizon) / slanted
        if depth <= 1e-6 * self._height:
            return None
        return self.picture((f * right / depth, f * (away * horizon + self._height * f) / slanted / depth))

    def away(self, level_y: float) -> float:
        """How far away the water is at a row below the horizon, m."""
        f = self._focal
        return self._height * (level_y * self.horizon + f * f) / (f * (level_y - self.horizon))

    def vanishing(self) -> Point:
        """Where lines that run away from the eye meet."""
        return self.picture((0, self.horizon))


def grid(plane: WaterPlane, size: tuple[int, int]) -> list[tuple[Point, Point]]:
    """Lines on the water within the picture: across at 1, 2, 5, 10, ... m, and away at even steps that fit the view."""
    lowest = max(plane.level(corner)[1] for corner in _corners(size))
    if lowest <= plane.horizon:
        return []
    nearest = plane.away(lowest)
    lines = [(plane.picture((-1e6, plane.horizon)), plane.picture((1e6, plane.horizon)))]
    for away in DISTANCES:
        level = plane.seen(0, away)
        if away >= nearest and level is not None:
            y = plane.level(level)[1]
            if y - plane.horizon > CLOSEST * size[1]:
                lines.append((plane.picture((-1e6, y)), plane.picture((1e6, y))))
    step = _rounded(max(nearest, 1e-3) / 2)
    for i in range(-LINES, LINES + 1):
        near = plane.seen(i * step, nearest)
        if near is not None:
            lines.append((near, plane.vanishing()))
    clipped = (clip(a, b, size) for a, b in lines)
    return [line for line in clipped if line is not None]


def clip(a: Point, b: Point, size: tuple[int, int]) -> tuple[Point, Point] | None:
    """The part of a line that lies within the picture (Liang and Barsky 1984); None where there is none."""
    low, high = 0.0, 1.0
    for start, way, side in ((a[0], b[0] - a[0], size[0]), (a[1], b[1] - a[1], size[1])):
        for distance, speed in ((start, -way), (side - start, way)):
            if speed == 0 and distance < 0:
                return None
            if speed > 0:
                high = min(high, distance / speed)
            elif speed < 0:
                low = max(low, distance / speed)
    if low >= high:
        return None
    at = lambda share: (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))  # noqa: E731
    return at(low), at(high)


def _corners(size: tuple[int, int]) -> list[Point]:
    return [(x, y) for x in (0, size[0]) for y in (0, size[1])]


def _rounded(length: float) -> float:
    """The next of 1, 2, 5, 10, ... above a length."""
    power = 10.0 ** floor(log10(length))
    return next(step * power for step in (1, 2, 5, 10) if step >= ceil(length / power - 1e-9))
