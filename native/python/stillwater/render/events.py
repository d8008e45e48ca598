"""What happens while frames are rendered; as JSON, the lines of `render --progress json`."""

from msgspec import Struct


class Event(Struct, tag_field="event", tag=str.lower, frozen=True, omit_defaults=True):
    """Base of all events; its JSON names it in the field `event`."""


class Started(Event):
    """The recipe and its files are right, the frames are this worker's."""

    first: int
    last: int
    of: int  # frames
    size: tuple[int, int]  # of a frame, pixels
    folder: str


class Preparing(Event):
    """`share` (0..1) of what must be computed before the first frame is done."""

    share: float
    what: str


class Frame(Event):
    """A frame stands under its final name; `kept`: it did already, and all that it reads is unchanged."""

    frame: int
    of: int
    seconds: float
    path: str
    kept: bool = False


class Warn(Event, tag="warning"):
    """Something is not as the recipe says, and the frames are rendered all the same."""

    sentence: str


class LayerFile(Event, tag="layer"):
    """Of `layers`: a layer is written."""

    name: str
    path: str


class Done(Event):
    """All frames are there."""

    rendered: int
    kept: int
    seconds: float
    movie: str | None = None


class Error(Event):
    """The work ended here."""

    sentence: str


class Ready(Event, tag="done"):
    """Of `serve`: what was asked for is in the cache. `files`: size, time in ns and hash of each file read, by path."""

    key: str
    files: dict[str, list]


class QuickMatte(Event, tag="matte"):
    """Of `serve`: a matte of this layer, near to what it will be, is in the cache."""

    key: str
    layer: str


class Dropped(Event, tag="cancelled"):
    """Of `serve`: a request was cancelled, or a newer one for the same recipe came."""
