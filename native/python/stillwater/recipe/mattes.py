"""What is cut out of the picture, and what fills the hole behind it."""

from typing import Annotated, Literal

from msgspec import Meta

from .parts import Choice, File, Part, Place, choice, number, text, whole
from .strokes import Stroke

MattingMethod = choice(Literal["closed-form", "bayesian"], "how the unknown part is solved")


class Matte(Choice):
    """How much of each pixel belongs to the layer: one of five forms."""


class FileMatte(Matte, Part):
    """An image: the named channel, or grey."""

    file: File
    channel: text("name of the channel, where the image has it", max_length=255) = "A"


class LabelMatte(Matte, Part):
    """All pixels of a label map that have one value."""

    labels: File
    value: whole("label", ge=0, le=2**31 - 1)


class TrimapMatte(Matte, Part):
    """White is the layer, black is not, grey is unknown."""

    trimap: File
    method: MattingMethod = "closed-form"


class Scribbles(Part):
    foreground: list[Stroke] = []
    background: list[Stroke] = []


class ScribbleMatte(Matte, Part):
    """Strokes on the layer and beside it; all else is unknown."""

    scribbles: Scribbles
    method: MattingMethod = "closed-form"


class LassoMatte(Matte, Part):
    """An outline; unknown within `feather` of it."""

    lasso: Annotated[list[Place], Meta(min_length=3, description="corners of the outline")]
    feather: number("half width of the unknown band", "px", ge=0, le=1000) = 8.0
    snap: number("how far the outline is pulled to edges", "px", ge=0, le=1000) = 0.0
    method: MattingMethod = "closed-form"


Matte.forms = {
    "file": FileMatte,
    "labels": LabelMatte,
    "trimap": TrimapMatte,
    "scribbles": ScribbleMatte,
    "lasso": LassoMatte,
}


class TouchUp(Part):
    """A place to be filled again, with another search."""

    stroke: Stroke
    radius: choice(number("how far patches may come from", "px", gt=0, le=16384) | None, "null = anywhere") = None
    seed: whole("another number gives another filling", ge=0, le=2**53) = 1


class Fill(Choice):
    """How the hole behind a layer is filled: one of three forms."""


class ExemplarFill(Fill, Part):
    """From patches of the picture itself (Criminisi et al. 2003)."""

    method: Literal["exemplar"] = "exemplar"
    patch: whole("side of a patch", "px", ge=3, le=63) = 9
    radius: choice(number("how far patches may come from", "px", gt=0, le=16384) | None, "null = anywhere") = None
    grow: number("patches keep this far from the hole", "px", ge=0, le=1000) = 2.0
    source: choice(Matte | None, "where patches may come from, null = anywhere") = None
    touch_up: list[TouchUp] = []


class FileFill(Fill, Part):
    """A painted background."""

    file: File


class NoFill(Fill, Part):
    """Transparent behind."""

    method: Literal["none"]


Fill.forms = {"file": FileFill, "method=exemplar": ExemplarFill, "method=none": NoFill}
