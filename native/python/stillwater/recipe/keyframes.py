"""Drawn keyframes of a fluid and the guide that in-betweens follow (METHODS.md, keyframes)."""

from typing import Annotated, Literal

from msgspec import Meta

from .mattes import Matte
from .parts import Choice, File, Part, Seed, animated, choice, number, whole
from .stochastic import Velocity
from .strokes import FlowStroke, Stroke


class Key(Part):
    """One drawing and its frame."""

    frame: whole("frame of the drawing", "frame", ge=-1_000_000, le=1_000_000)
    file: File


class SolverPlace(Part):
    """A source, obstacle or force of the solver; its place is a stroke or a matte."""

    stroke: Stroke | None = None
    matte: Matte | None = None
    velocity: animated(Velocity) = (0.0, 0.0)
    density: animated(number("density", ge=0, le=1e6)) = 1.0
    temperature: animated(number("temperature", ge=-1e6, le=1e6)) = 1.0


class Solver(Part):
    """A fluid simulation."""

    grid: tuple[whole("cells across", ge=4, le=4096), whole("cells down", ge=4, le=4096)]
    viscosity: number("viscosity", ge=0, le=1e6) = 0.0
    vorticity: number("vorticity confinement", ge=0, le=1e6) = 0.0
    buoyancy: number("lift of warm fluid", ge=-1e6, le=1e6) = 1.0
    sources: list[SolverPlace] = []
    obstacles: list[SolverPlace] = []
    forces: list[SolverPlace] = []


class Guide(Choice):
    """The velocity that in-betweens follow: one of four forms."""


class SolverGuide(Guide, Part):
    solver: Solver


class FlowGuide(Guide, Part):
    flow: choice(File, "PATTERN_####.exr or .flo; channels X, Y [px/frame]")


class FootageGuide(Guide, Part):
    footage: choice(File, "clip")


class StrokeGuide(Guide, Part):
    strokes: list[FlowStroke]


Guide.forms = {"solver": SolverGuide, "flow": FlowGuide, "footage": FootageGuide, "strokes": StrokeGuide}


class Keyframes(Part, tag="keyframes"):
    """In-betweens in the drawn style."""

    keys: Annotated[list[Key], Meta(min_length=1, description="the drawings")]
    guide: Guide
    mode: choice(Literal["approximate", "interpolate"], "interpolate: keys stay as drawn, one pass") = "approximate"
    passes: whole("passes", ge=1, le=10) = 2
    coherence: number("beta: coherence in time", ge=0, le=1000) = 1.0
    weights: choice(Literal["blend", "constant", "smooth-step"], "how keys count over time") = "blend"
    radius: whole("keys that count; in pass 2 frames", ge=1, le=100) = 2
    hold: whole("frames that a drawing stands (2: on twos)", "frames", ge=1, le=100) = 1
    patch: whole("side of a patch", "px", ge=3, le=63) = 5
    prior: number("weight of the prior", ge=0, le=1000) = 5.0
    modulation: number("gamma: how strongly the guide modulates", ge=0, le=1) = 1.0
    modulation_by: choice(Literal["speed", "rank"], "what modulates") = "speed"
    gradient_weight: number("weight of gradients against colours", ge=0, le=1000) = 0.5
    vote: choice(Literal["mean", "mean-shift"], "how patches are merged") = "mean"
    rotate: choice(bool, "patches may turn") = True
    scale: choice(bool, "patches may grow and shrink") = True
    seed: Seed | None = None


