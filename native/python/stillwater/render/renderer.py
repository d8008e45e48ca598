"""The engine's FrameRenderer for a recipe: its layers handed over as parameter structs."""

import numpy as np

from .. import _stillwater as engine
from ..recipe.stochastic import Bob
from .cache import Prepared
from .filming import Pace
from .moments import moment_of, motions_of, numbers, view_of
from .ready import Canvas, Way, pace_of
from .resolve import Timeline


class Renderer:
    """Frames of one recipe at one scale, in any order."""

    def __init__(self, timeline: Timeline, canvas: Canvas, ready: dict[Way, list[Prepared]]):
        """`ready`: what make_ready() gave."""
        self._timeline, self._layers_too = timeline, timeline.recipe.output.layers
        plates = [canvas.plates(way, made, timeline) for way, made in ready.items()]
        self._paces = [pace_of(timeline, way, made) for way, made in ready.items()]
        has_alpha = canvas.layers.facts["has_alpha"]
        self._renderer = frame_renderer(
            timeline, plates, canvas.size, canvas.scale, self._paces, has_alpha=has_alpha
        )

    def frame(self, frame: int):
        """One frame: .combined H x W x 4 premultiplied display-referred, .flow H x W x 2, .matte H x W, .layers."""
        (now, states), (after, states_after) = (numbers(self._timeline, at, self._paces) for at in (frame, frame + 1))
        return self._renderer.render(now, after, states, states_after, flow=True, layers=self._layers_too)


def frame_renderer(
    timeline: Timeline, images: list, size: tuple[int, int], scale: float, paces: list[Pace | None], **alpha
) -> engine.FrameRenderer:
    """The engine's renderer. `images`: an engine.LayerImage or engine.LayerPlates for each layer; `paces`: of its clip.

    `alpha`: the same layers of the picture's own alpha, or has_alpha=True where the plates have them.
    """
    recipe, start = timeline.recipe, timeline.at(1)  # animated fields are replaced at each frame
    place = {layer.name: i for i, layer in enumerate(recipe.layers)}
    motions = motions_of(timeline, start, paces)
    layers = [
        engine.Layer(
            image,
            motion,
            water=place[layer.motion.water] if isinstance(layer.motion, Bob) else -1,
            follows=place[layer.follows.layer] if layer.follows else -1,
            mirror=bool(layer.follows and layer.follows.mirror),
            visible=layer.visible,
            endless=endless,
        )
        for image, layer, motion, endless in zip(images, recipe.layers, motions, timeline.endless, strict=True)
    ]
    return engine.FrameRenderer(size, scale, view_of(recipe), moment_of(start.moment).wind, layers, **alpha)


def eight_bit(combined: np.ndarray) -> np.ndarray:
    """A frame over black as H x W x 3 bytes, sRGB."""
    return np.rint(np.clip(combined[..., :3], 0, 1) * 255).astype(np.uint8)
