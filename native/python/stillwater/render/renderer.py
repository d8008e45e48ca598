"""The engine's FrameRenderer for a recipe: layers, motions and moments handed over as its parameter structs."""

import numpy as np

from .. import _stillwater as engine
from ..recipe.stochastic import Bob, Ripple, Still, Sway
from .cache import Prepared
from .filming import ExampleNow, ExampleTrack, Pace
from .flowing import FlowNow, FlowTrack
from .ready import Canvas, Way, pace_of
from .resolve import DriftNow, MomentNow, Now, Timeline

_KINDS = {Sway: engine.Sway, Ripple: engine.Ripple, Bob: engine.Bob, DriftNow: engine.Drift}


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
    motions = _motions(timeline, start, paces)
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
    view = engine.View(horizon=recipe.view.horizon, fov=recipe.view.fov, height=recipe.view.height)
    return engine.FrameRenderer(size, scale, view, _moment(start.moment).wind, layers, **alpha)


def numbers(timeline: Timeline, frame: int, paces: list[Pace | None]) -> tuple:
    """What the engine's renderer is told of one frame: its moment, and a state for each layer."""
    now = timeline.at(frame)
    layers = zip(now.layers, _motions(timeline, now, paces), strict=True)
    return _moment(now.moment), [engine.LayerState(layer.opacity, motion) for layer, motion in layers]


def _motions(timeline: Timeline, now: Now, paces: list[Pace | None]) -> list:
    tracks = (flow or film for flow, film in zip(timeline.flows, timeline.films, strict=True))
    return [_motion(layer.motion, track, pace) for layer, track, pace in zip(now.layers, tracks, paces, strict=True)]


def _moment(now: MomentNow):
    return engine.Moment(**{**_fields(now), "wind": engine.Wind(**_fields(now.wind))})


def _motion(motion, track: FlowTrack | ExampleTrack | None, pace: Pace | None):
    if isinstance(motion, Still):
        return None
    if isinstance(motion, FlowNow):
        field, following = map(list(track.paintings).index, motion.fields)
        return engine.Flow(
            cycle=motion.cycle, ways=motion.ways, step=motion.step, field=field, next_field=following, next_share=motion.share
        )
    if isinstance(motion, ExampleNow):
        if not track.moves:
            return None
        field, following = map(list(track.paintings).index, motion.fields)
        moment = pace.moment(motion.way)
        step = pace.moment(motion.way + motion.step) - moment
        return engine.Example(moment=moment, step=step, field=field, next_field=following, next_share=motion.share)
    fields = _fields(motion)
    fields.pop("water", None)  # which layer, not a number of the motion: engine.Layer has it
    return _KINDS[type(motion)](**fields)


def _fields(part) -> dict:
    return {name: getattr(part, name) for name in part.__struct_fields__}


def eight_bit(combined: np.ndarray) -> np.ndarray:
    """A frame over black as H x W x 3 bytes, sRGB."""
    return np.rint(np.clip(combined[..., :3], 0, 1) * 255).astype(np.uint8)
