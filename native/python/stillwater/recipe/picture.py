"""The recipe itself: one animated picture, its layers, its wind, its view and its frames."""

from typing import Annotated, Literal

from msgspec import Meta

from .fluids import Example, Flow, Library
from .keyframes import Keyframes
from .mattes import ExemplarFill, Fill, Matte
from .parts import File, Line, Part, Seed, animated, choice, number, text, whole
from .stochastic import Bob, Drift, Ripple, Still, Sway

Motion = Still | Sway | Ripple | Bob | Drift | Flow | Example | Library | Keyframes
Frame = whole("frame", "frame", ge=-100_000, le=1_000_000)


class Wind(Part):
    """The one wind of all layers."""

    speed: animated(number("mean speed", "m/s", ge=0, le=40)) = 5.0
    direction: animated(
        number("where it blows to over the ground: 0 = right, 90 = away from the viewer", "degrees", ge=-36000, le=36000)
    ) = 0.0
    gusts: animated(number("share of the speed that comes as moving gusts", ge=0, le=1)) = 0.0
    gust_size: number("size of a gust, of the picture's width", gt=0, le=100) = 0.25
    seed: Seed | None = None


class View(Part):
    """How the picture sees the world."""

    horizon: choice(Line | None, "two points of the horizon [px]; needed by ripple and bob") = None
    fov: number("horizontal field of view", "degrees", ge=5, le=150) = 50.0
    height: number("of the eye over the water", "m", gt=0, le=1e5) = 1.7


class Output(Part):
    """Where frames go and how they are written."""

    folder: choice(File, "folder of the frames, relative to the recipe's") = "frames"
    name: text("frames are NAME_0001.exr", max_length=200) = "frame"
    depth: choice(Literal["half", "float"], "of the colour and matte channels") = "half"
    compression: choice(
        Literal["none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"], "of OpenEXR"
    ) = "zip"
    layers: choice(bool, "each layer as its own EXR layer beside the whole") = False
    scale: number("output pixels for a picture pixel", ge=0.001, le=16) = 1.0


class Follows(Part):
    """A shadow or a reflection goes with another layer's motion."""

    layer: text("name of the layer")
    mirror: choice(bool, "mirrored, as a reflection") = False


class Layer(Part):
    """One piece of the picture and its motion."""

    name: text("unique name", max_length=200)
    visible: choice(bool, "a hidden layer shows its fill") = True
    opacity: animated(number("opacity", ge=0, le=1)) = 1.0
    feather: number("softens the matte", "px", ge=0, le=1000) = 0.0
    follows: Follows | None = None
    matte: choice(Matte | None, "required but for the last layer") = None
    fill: Fill = ExemplarFill()
    motion: Motion = Still()


class Recipe(Part, kw_only=True):
    """Everything about one animated picture (RECIPE.md, version 1)."""

    stillwater: choice(Literal[1], "version of the recipe")
    picture: choice(File | None, "image; required unless a keyframes layer is all there is") = None
    colour_space: choice(Literal["auto", "srgb", "linear"], "of the picture; auto: linear for EXR and HDR") = "auto"
    size: choice(
        tuple[whole("width", "px", ge=1, le=16384), whole("height", "px", ge=1, le=16384)] | None,
        "[width, height]: required without a picture, else only a check",
    ) = None
    frames: choice(tuple[Frame, Frame], "[first, last], both rendered")
    fps: number("frames per second", "1/s", gt=0, le=1000) = 24.0
    seed: Seed = 0
    loop: choice(bool, "the last frame runs into the first without a seam") = False
    wind: Wind = Wind()
    view: View = View()
    layers: Annotated[list[Layer], Meta(min_length=1, max_length=1000, description="front first")]
    output: Output = Output()
