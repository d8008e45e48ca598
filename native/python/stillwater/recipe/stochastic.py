"""Motions of METHODS.md 1 (Chuang et al. 2005): what one wind does to trees, water, boats and clouds."""

from typing import Annotated, Literal

from msgspec import Meta

from .parts import Line, Part, Place, Seed, animated, choice, number, text

Velocity = Annotated[
    tuple[number("to the right", "px/frame", ge=-1e4, le=1e4), number("down", "px/frame", ge=-1e4, le=1e4)],
    Meta(description="velocity [px/frame]", extra_json_schema={"unit": "px/frame"}, extra={"unit": "px/frame"}),
]


class Still(Part, tag="still"):
    """Nothing moves."""


class Sway(Part, tag="sway"):
    """Trees, plants, flags: bend about the root of an armature."""

    armature: choice(Line, "[[root], [tip]] [px]; may reach outside the picture")
    frequency: animated(number("natural frequency", "Hz", gt=0, le=100)) = 0.6
    mass: number("mass, relative", gt=0, le=1e6) = 1.0
    damping: number("damping", "1/s", gt=0, le=1000) = 0.4
    amount: animated(number("strength; 1 is 0.05 of the armature's length rms at 5 m/s", ge=0, le=1000)) = 1.0
    foreshortening: number("shortening along the armature", ge=0, le=1) = 0.0
    shimmer: number("small independent motion of leaves", ge=0, le=1) = 0.0
    seed: Seed | None = None


class Ripple(Part, tag="ripple"):
    """Water: a plane of waves, seen in `view`, under `wind`."""

    amplitude: animated(number("1 is the significant height of a grown sea at this wind", ge=0, le=1000)) = 1.0
    roughness: number("how many times the field is tiled over the same water", ge=1e-4, le=1e4) = 1.0
    tile: number("side of the wave field's tile", "m", ge=10, le=2000) = 60.0
    resolution: choice(Literal[16, 32, 64, 128, 256, 512, 1024, 2048], "wave numbers a side of the tile") = 256
    mode: choice(Literal["height", "normal"], "displaced by the height, or by the slope (mirror-like water)") = "height"
    spectrum: choice(Literal["phillips", "pierson-moskowitz", "jonswap", "tma"], "distribution of the waves") = "phillips"
    fetch: number("length of open water under the wind", "km", gt=0, le=1e5) = 100.0
    depth: number("depth of the water", "m", gt=0, le=12000) = 200.0
    seed: Seed | None = None


class Bob(Part, tag="bob"):
    """Boats: heave and roll with the water under the waterline."""

    waterline: Annotated[list[Place], Meta(min_length=2, description="points along the hull's waterline [px]")]
    water: text("name of the ripple layer that carries it")
    amount: animated(number("strength", ge=0, le=1000)) = 1.0


class Drift(Part, tag="drift"):
    """Clouds: pass endlessly, at a velocity of their own or with the wind."""

    velocity: choice(animated(Velocity) | None, "null: the wind's") = None
    wind: number("speed for each m/s of wind along the picture", "px/frame", ge=-1000, le=1000) = 0.5
