"""The defaults are those of the page RECIPE.md, written down here once more by hand."""

import msgspec
import pytest
from stillwater.recipe import Layer, Output, Recipe, View, Wind
from stillwater.recipe.fluids import Example, Flow, Library, SpeedMap, Transfer
from stillwater.recipe.keyframes import Keyframes, Solver, SolverPlace
from stillwater.recipe.mattes import ExemplarFill, FileMatte, LassoMatte, TrimapMatte
from stillwater.recipe.stochastic import Bob, Drift, Ripple, Still, Sway
from stillwater.recipe.strokes import CloneStroke, FlowStroke, Outline, Refine, Stroke

LOOK = dict(shutter=0.2, average_blur=8, grid=None, repetitions=3, matching="steerable", clip_scale=1, clip_fps=None,
            outline=None, endless=True, stylize=1, speed=1, refine=Refine())

PAGE = [
    (Recipe, dict(colour_space="auto", size=None, fps=24, seed=0, loop=False, wind=Wind(), view=View(), output=Output())),
    (Wind, dict(speed=5, direction=0, gusts=0, gust_size=0.25, seed=None)),
    (View, dict(horizon=None, fov=50, height=1.7)),
    (Output, dict(folder="frames", name="frame", depth="half", compression="zip", layers=False, scale=1)),
    (Layer, dict(visible=True, opacity=1, feather=0, follows=None, matte=None, fill=ExemplarFill(), motion=Still())),
    (Stroke, dict(width=10)),
    (FileMatte, dict(channel="A")),
    (TrimapMatte, dict(method="closed-form")),
    (LassoMatte, dict(feather=8, method="closed-form")),
    (ExemplarFill, dict(method="exemplar", patch=9, radius=None, grow=2, source=None)),
    (Sway, dict(frequency=0.6, mass=1, damping=0.4, amount=1, foreshortening=0, shimmer=0)),
    (Ripple, dict(amplitude=1, roughness=1, tile=60, resolution=256, mode="height", spectrum="phillips", fetch=100,
                  depth=200)),
    (Bob, dict(amount=1)),
    (Drift, dict(velocity=None, wind=0.5)),
    (Flow, dict(speed=1, period=60, refine=Refine(), outline=None)),
    (Example, dict(clip_frames=None, clip_steady=False, life=16, transfer=Transfer(), **LOOK)),
    (Library, dict(kinds=["fire"], speed_map=None, candidates=100, smoothness=1, dynamics=1, texture=1, **LOOK)),
    (Transfer, dict(patch=16, order="best-last")),
    (CloneStroke, dict(width=20, alpha=1)),
    (SpeedMap, dict(white=4)),
    (Keyframes, dict(mode="approximate", passes=2, coherence=1, weights="blend", radius=2, hold=1, patch=5, prior=5,
                     modulation=1, modulation_by="speed", gradient_weight=0.5, vote="mean", rotate=True, scale=True)),
    (Solver, dict(viscosity=0, vorticity=0, buoyancy=1)),
    (SolverPlace, dict(density=1, temperature=1)),
    (FlowStroke, dict(speed=2, local=False, alpha=1, width=10)),
    (Refine, dict(width=12, amount=1)),
    (Outline, dict(moving=False, persistence=0.9)),
]


@pytest.mark.parametrize("kind, defaults", PAGE, ids=[kind.__name__ for kind, _ in PAGE])
def test_defaults(kind, defaults):
    fields = {field.name: field for field in msgspec.structs.fields(kind)}
    for name, value in defaults.items():
        field = fields[name]
        given = field.default if field.default is not msgspec.NODEFAULT else field.default_factory()
        assert given == value, name
