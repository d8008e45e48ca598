"""How much memory a render will need at most, before it starts.

The largest of three moments: cutting the layers (picture, mattes, the layers so far and the widest one at work),
making them ready (those from the cache, mapped, and what is made of them), and rendering (what is ready, and the frame
at work). A test holds it within 20 % of the measured peak.
"""

PROCESS = 170e6  # Python and the engine's libraries
RGBA, PLANE = 16, 4  # bytes a pixel
LEFT = RGBA + 2 * PLANE  # what is left of the picture, what hides it, what is solid
AT_WORK = 7 * RGBA  # a layer that is being cut: its colour, the one behind, and the pyramids they come from
FRAME = 28  # picture, flow, matte
WRITTEN, WRITTEN_AT_ONCE = 24, 64 << 20  # what is written of them; bytes of it that are held
STRIP = 1.25  # an endless layer's period, of its side
TURNED = 1.8  # an endless layer that is being made ready, beside itself: on its canvas, and one period of it


def needed_bytes(job) -> float:
    """For a Job whose files are checked."""
    if job.stack is not None:
        return PROCESS + _rendering(job, job.boxes)
    boxes = _behind(job.boxes)
    return PROCESS + max(_cutting(job, boxes), _rendering(job, boxes))


def _behind(boxes: list) -> list:
    """The boxes as they will be: a layer goes on behind those in front that it touches."""
    grown, hidden = [], None
    for x, y, width, height in boxes:
        sides = (x, y, x + width, y + height)
        if width and hidden is not None:
            low, high = (max(sides[i], hidden[i]) for i in (0, 1)), (min(sides[i], hidden[i]) for i in (2, 3))
            if all(a <= b for a, b in zip(low, high, strict=True)):
                sides = _union(sides, hidden)
        if width:
            hidden = sides if hidden is None else _union(sides, hidden)
        grown.append((sides[0], sides[1], sides[2] - sides[0], sides[3] - sides[1]))
    return grown


def _cutting(job, boxes) -> float:
    pixels = job.sources.size[0] * job.sources.size[1]
    with_matte = [box for box, layer in zip(boxes, job.recipe.layers, strict=True) if layer.matte is not None]
    layers = RGBA * sum(map(_area, boxes)) * (2 if job.has_alpha else 1)
    return pixels * (RGBA + PLANE * len(with_matte) + LEFT) + layers + AT_WORK * max(map(_area, with_matte), default=0)


def _rendering(job, boxes) -> float:
    shrunk = min(1.0, job.scale) ** 2
    canvas = RGBA * job.sources.size[0] * job.sources.size[1]
    cut, ready, at_work = 0.0, 0.0, canvas if shrunk < 1 else 0.0
    for layer, box, endless in zip(job.recipe.layers, boxes, job.timeline.endless, strict=True):
        cut += RGBA * _area(box)
        if not layer.visible:
            continue
        width = STRIP * job.sources.size[0] if endless[0] else box[2]
        height = STRIP * job.sources.size[1] if endless[1] else box[3]
        plate = RGBA * shrunk * width * height
        ready += plate
        if any(endless):
            at_work = max(at_work, TURNED * plate)
    if job.has_alpha:
        cut, ready = 2 * cut, 2 * ready
    own = RGBA * sum(layer.visible for layer in job.recipe.layers) if job.recipe.output.layers else 0
    pixels = job.size[0] * job.size[1]
    return ready + max(cut + at_work, pixels * (FRAME + own) + min(pixels * (WRITTEN + own), WRITTEN_AT_ONCE))


def _union(a, b) -> tuple:
    return min(a[0], b[0]), min(a[1], b[1]), max(a[2], b[2]), max(a[3], b[3])


def _area(box) -> int:
    return box[2] * box[3]
