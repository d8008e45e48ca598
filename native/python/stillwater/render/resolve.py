"""From the recipe to the plain numbers of one frame: animated numbers, integrals, seeds.

Nothing here knows the engine: the numbers are hashed into the frame's key (keys.py) and handed to C++ (renderer.py).
"""

import hashlib
import math

import msgspec

from ..recipe import Recipe
from ..recipe.animation import Loop, Track, combine, ends_differ
from ..recipe.fluids import Example, Flow
from ..recipe.mattes import NoFill
from ..recipe.parts import Keys
from ..recipe.picture import Layer
from ..recipe.stochastic import Bob, Drift, Ripple, Still, Sway
from .filming import ExampleNow, ExampleTrack
from .flowing import FlowNow, FlowTrack
from .outlining import OutlineNow, OutlineTrack


BARE = "none; where the moving outline leaves, the picture as it was is seen (exemplar or a file paints what is behind)"


class WindNow(msgspec.Struct, frozen=True):
    """The wind at a frame; `travel` is the way of the gusts over the ground since frame 1 (right, away), m."""

    speed: float
    direction: float
    gusts: float
    gust_size: float
    seed: int
    travel: tuple[float, float]


class MomentNow(msgspec.Struct, frozen=True):
    """A frame of the timeline; `loop_travel` is what the wind's travel gains over one loop."""

    frame: int
    fps: float
    first_frame: int
    loop_frames: int
    wind: WindNow
    loop_travel: tuple[float, float]


class DriftNow(msgspec.Struct, frozen=True, tag="drift"):
    """How far a layer has drifted since frame 1, and how far it drifts in one loop, px."""

    offset: tuple[float, float]
    loop_offset: tuple[float, float]


class LayerNow(msgspec.Struct, frozen=True):
    """A layer at a frame; its motion is the recipe's, with plain numbers and its seed in place."""

    opacity: float
    motion: Still | Sway | Ripple | Bob | DriftNow | FlowNow | ExampleNow
    outline: OutlineNow | None = None


class Now(msgspec.Struct, frozen=True):
    """All that changes from frame to frame."""

    moment: MomentNow
    layers: tuple[LayerNow, ...]


class Timeline:
    """A recipe's numbers at any frame. In a loop the frame after the last one is the first, its integrals go on."""

    def __init__(self, recipe: Recipe):
        self.recipe = recipe
        self.loop = Loop(*recipe.frames) if recipe.loop else None
        wind = recipe.wind
        self._speed, self._direction, self._gusts = map(self._track, (wind.speed, wind.direction, wind.gusts))
        self._along = combine(lambda v, a: v * math.cos(math.radians(a)), self._speed, self._direction)
        self._away = combine(lambda v, a: v * math.sin(math.radians(a)), self._speed, self._direction)
        self._wind_seed = seed_of(recipe, "wind") if wind.seed is None else wind.seed
        self._opacities = [self._track(layer.opacity) for layer in recipe.layers]
        motions = [layer.motion for layer in recipe.layers]
        self.flows = [FlowTrack(motion, self.loop) if isinstance(motion, Flow) else None for motion in motions]
        self.films = [ExampleTrack(motion, self.loop) if isinstance(motion, Example) else None for motion in motions]
        self.outlines = [self._outline(i, motion) for i, motion in enumerate(motions)]
        self._motions = [self._motion(i, layer) for i, layer in enumerate(recipe.layers)]
        self.endless = [self._endless(layer) for layer in recipe.layers]

    def at(self, frame: int) -> Now:
        """The numbers of one frame."""
        layers = zip(self._opacities, self._motions, self.outlines, strict=True)
        now = (
            LayerNow(opacity.at(frame), motion(frame), outline and outline.at(frame)) for opacity, motion, outline in layers
        )
        return Now(self._moment(frame), tuple(now))

    def fluid(self, i: int) -> FlowTrack | ExampleTrack | None:
        """The numbers of a layer that flows, with a clip or without; None where it does not."""
        return self.flows[i] or self.films[i]

    def way(self, frame: int) -> tuple[float, float, float]:
        """The wind's way since frame 1 (right, away), and to the right in one loop, m/s x frames."""
        return self._along.integral(frame), self._away.integral(frame), self._along.over_loop()

    def warnings(self) -> list[str]:
        """A sentence for each animated number that must be blended to close the loop, and for each outline that moves before
        nothing but the picture."""
        blended = [] if self.loop is None else list(_blended(self.recipe, self.loop))
        return [*blended, *(f"layers[{i}].fill: {BARE}" for i, outline in enumerate(self.outlines) if outline and self._is_bare(i))]

    def _is_bare(self, i: int) -> bool:
        layer = self.recipe.layers[i]
        return layer.matte is not None and isinstance(layer.fill, NoFill) and i + 1 < len(self.recipe.layers)

    def _track(self, number, component=None) -> Track:
        return Track.of(number, self.loop, component)

    def _moment(self, frame: int) -> MomentNow:
        fps = self.recipe.fps
        travel = (self._along.integral(frame) / fps, self._away.integral(frame) / fps)
        wind = WindNow(
            self._speed.at(frame), self._direction.at(frame), self._gusts.at(frame), self.recipe.wind.gust_size,
            self._wind_seed, travel,
        )  # fmt: skip
        loop_travel = (self._along.over_loop() / fps, self._away.over_loop() / fps)
        period = self.loop.period if self.loop else 0
        return MomentNow(frame, fps, self.loop.first if self.loop else 1, period, wind, loop_travel)

    def _outline(self, i: int, motion) -> OutlineTrack | None:
        """The outline of a layer where it moves: what stands still takes none along."""
        track = self.fluid(i)
        if track is None or not track.fastest or motion.outline is None or not motion.outline.moving:
            return None
        return OutlineTrack(motion.outline, track, self.loop, self.recipe.frames)

    def _motion(self, i: int, layer: Layer):
        """The layer's motion as a function of the frame."""
        track = self.fluid(i)
        if track is not None:
            return track.at
        if isinstance(layer.motion, Drift):
            return self._drift(layer.motion)
        still = layer.motion
        if isinstance(still, Sway | Ripple) and still.seed is None:
            still = msgspec.structs.replace(still, seed=seed_of(self.recipe, f"layer {layer.name}"))
        tracks = {name: self._track(getattr(still, name)) for name in ANIMATED.get(type(still), ())}
        return lambda frame: msgspec.structs.replace(still, **{name: track.at(frame) for name, track in tracks.items()})

    def _endless(self, layer: Layer) -> tuple[bool, bool]:
        """Along which axes a layer must go on for ever: where it, or the layer that it follows, ever drifts."""
        along = (False, False)
        if isinstance(layer.motion, Drift):
            along = tuple(rate.values.any() for rate in self._rates(layer.motion))
        if layer.follows is not None:
            led = self._endless(next(other for other in self.recipe.layers if other.name == layer.follows.layer))
            if layer.follows.mirror and any(led):  # the mirror's axis may be tilted
                led = (True, True)
            along = tuple(a or b for a, b in zip(along, led, strict=True))
        return bool(along[0]), bool(along[1])

    def _rates(self, drift: Drift) -> tuple[Track, Track]:
        """Velocity to the right and down, px a frame."""
        if drift.velocity is None:
            return combine(lambda v: v * drift.wind, self._along), Track(1, [0.0], self.loop)
        return self._track(drift.velocity, 0), self._track(drift.velocity, 1)

    def _drift(self, drift: Drift):
        rates = self._rates(drift)
        in_loop = tuple(rate.over_loop() for rate in rates)
        return lambda frame: DriftNow(tuple(rate.integral(frame) for rate in rates), in_loop)


# The fields with a `~` in the recipe, by the motion that has them (a test compares this with the classes).
ANIMATED = {Sway: ("frequency", "amount"), Ripple: ("amplitude",), Bob: ("amount",)}


def seed_of(recipe: Recipe, what: str) -> int:
    """The seed of something that has none of its own: changes with its name and the recipe's seed, not its place."""
    digest = hashlib.blake2b(f"{recipe.seed} {what}".encode(), digest_size=8).digest()
    return int.from_bytes(digest, "little")


def _blended(recipe: Recipe, loop: Loop):
    parts = {"wind": recipe.wind}
    for i, layer in enumerate(recipe.layers):
        parts |= {f"layers[{i}]": layer, f"layers[{i}].motion": layer.motion}
    for place, part in parts.items():
        for name in part.__struct_fields__:
            number = getattr(part, name)
            if not isinstance(number, Keys):
                continue
            components = range(len(number.values[0])) if isinstance(number.values[0], tuple) else [None]
            if any(ends_differ(Track.of(number, component=component), loop) for component in components):
                yield (
                    f"{place}.{name}: differs between frames {loop.first} and {loop.last}; blended over the last"
                    f" {loop.blended} of {loop.period} frames, so that the loop closes"
                )
