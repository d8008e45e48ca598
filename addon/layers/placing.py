"""Where a motion would be in a layer of which only the outline is known. Knows nothing of Blender."""

EDGE = 0.12  # of the outline's height: what counts as its upper or lower end
AFLOAT = 0.15  # of its height, from below: where a hull meets the water

Point = list[float]  # x, y, px


def sway_line(outline: list[Point]) -> tuple[Point, Point]:
    """Root and tip of what stands: the middles of its lower and of its upper end."""
    top, bottom = _reach(outline)
    edge = EDGE * (bottom - top)
    low = _middle(_crossings(outline, bottom - edge))
    high = _middle(_crossings(outline, top + edge))
    return [low, bottom], [high, top]


def waterline(outline: list[Point]) -> list[Point]:
    """Across the hull, a little above its lowest point."""
    top, bottom = _reach(outline)
    y = bottom - AFLOAT * (bottom - top)
    found = _crossings(outline, y)
    return [[min(found), y], [max(found), y]]


def horizon(outline: list[Point], width: float) -> list[Point]:
    """Level, where the water that is outlined ends above."""
    top, _ = _reach(outline)
    return [[0.0, top], [width, top]]


def _reach(outline: list[Point]) -> tuple[float, float]:
    heights = [y for _, y in outline]
    return min(heights), max(heights)


def _crossings(outline: list[Point], y: float) -> list[float]:
    """Where a level line crosses the closed outline."""
    found = []
    for (x0, y0), (x1, y1) in zip(outline, [*outline[1:], outline[0]], strict=True):
        if (y0 <= y) != (y1 <= y):
            found.append(x0 + (x1 - x0) * (y - y0) / (y1 - y0))
    return found


def _middle(found: list[float]) -> float:
    return (min(found) + max(found)) / 2
