"""What the engine is told of one frame: the numbers of a recipe as its parameter structs."""

from .. import _stillwater as engine
from ..recipe import Recipe
from ..recipe.stochastic import Bob, Ripple, Still, Sway
from .filming import ExampleNow, ExampleTrack, Pace
from .flowing import FlowNow, FlowTrack
from .resolve import DriftNow, LayerNow, MomentNow, Now, Timeline

_KINDS = {Sway: engine.Sway, Ripple: engine.Ripple, Bob: engine.Bob, DriftNow: engine.Drift}


def numbers(timeline: Timeline, frame: int, paces: list[Pace | None]) -> tuple:
    """The moment of a frame, and a state for each layer. `paces`: of its clip."""
    now = timeline.at(frame)
    return moment_of(now.moment), [
        engine.LayerState(layer.opacity, motion, layer.outline.index if layer.outline else 0)
        for layer, motion in zip(now.layers, motions_of(timeline, now, paces), strict=True)
    ]


def motions_of(timeline: Timeline, now: Now, paces: list[Pace | None]) -> list:
    """What moves each layer; None where nothing does."""
    return [motion_of(timeline, i, layer, pace) for i, (layer, pace) in enumerate(zip(now.layers, paces, strict=True))]


def motion_of(timeline: Timeline, i: int, layer: LayerNow, pace: Pace | None):
    """What moves one layer; None where nothing does."""
    return _motion(layer.motion, timeline.fluid(i), pace)


def view_of(recipe: Recipe):
    return engine.View(horizon=recipe.view.horizon, fov=recipe.view.fov, height=recipe.view.height)


def moment_of(moment: MomentNow):
    return engine.Moment(**{**_fields(moment), "wind": engine.Wind(**_fields(moment.wind))})


def _motion(motion, track: FlowTrack | ExampleTrack | None, pace: Pace | None):
    if isinstance(motion, Still):
        return None
    if isinstance(motion, FlowNow):
        field, following = map(list(track.paintings).index, motion.fields)
        return engine.Flow(
            cycle=motion.cycle, ways=motion.ways, step=motion.step, field=field, next_field=following, next_share=motion.share
        )
    if isinstance(motion, ExampleNow):
        if not track.fastest:
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
