"""How much memory a render will need at most, before it starts.

The larger of two moments: cutting the layers (picture, mattes, the layers so far and the widest one at work), and
rendering (the layers, mapped and made ready, and the frame at work). A test holds it within 20 % of the measured peak.
"""

from ..recipe.stochastic import Drift

PROCESS = 165e6  # Python and the engine's libraries
RGBA, FIELD, PLANE = 16, 8, 4  # bytes a pixel
AT_WORK = 7 * RGBA  # for each pixel of the layer that is being cut: both colours, what is known of them, pyramids
STRIP = 1.25  # an endless layer's period, of its side


def needed_bytes(job) -> float:
    """For a Job whose files are checked."""
    rendering = _rendering(job)
    return PROCESS + (rendering if job.stack is not None else max(_cutting(job), rendering))


def _cutting(job) -> float:
    pixels = job.sources.size[0] * job.sources.size[1]
    mattes = sum(layer.matte is not None for layer in job.recipe.layers)
    layers = RGBA * sum(_area(box) for box in job.boxes) * (2 if job.has_alpha else 1)
    left = RGBA + 2 * PLANE  # what is left of the picture, what is hidden and what is solid
    return pixels * (RGBA + PLANE * mattes + left) + layers + AT_WORK * max(map(_area, job.boxes))


def _rendering(job) -> float:
    shrunk = min(1.0, job.scale) ** 2
    pixels = job.sources.size[0] * job.sources.size[1]
    layers = 0.0
    for layer, box, endless in zip(job.recipe.layers, job.boxes, job.timeline.endless, strict=True):
        ready = pixels * (STRIP if endless[0] else 1) * (STRIP if endless[1] else 1) if any(endless) else _area(box)
        copies = 2 if isinstance(layer.motion, Drift) else 1  # a drift's blurred copy
        layers += RGBA * (_area(box) + shrunk * ready * copies * layer.visible)
    if job.has_alpha:
        layers *= 2
    frame = job.size[0] * job.size[1] * (2 * RGBA + FIELD + PLANE)
    own = sum(layer.visible for layer in job.recipe.layers) * job.size[0] * job.size[1] * RGBA
    return layers + frame + (own if job.recipe.output.layers else 0)


def _area(box) -> int:
    return box[2] * box[3]
