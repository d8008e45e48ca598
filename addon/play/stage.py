"""One picture as the viewport shows it: its recipe, the frames from it, what is missing and what went wrong.

    recipe changed --take--> ready: frames of it
                        \\-> something must be prepared: the server is asked, frames stay those of the recipe before;
                        |   for the matte that is being drawn it is asked first, for a sketch
                        \\-> wrong: a sentence that says why, and frames of what is cut out already, if anything is
"""

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import engine
from ..recipe.sentences import named
from . import server
from .draft import draft_of, solved_matte


@dataclass(frozen=True)
class Sketch:
    """A matte while it is drawn, near to what it will be."""

    layer: str
    matte: np.ndarray  # height x width of the picture, 0 .. 255, top row first
    number: int  # how many came before


class Stage:
    """Throws nothing: `problem` says what keeps it from showing frames."""

    def __init__(self, identifier: str, changed: Callable[[], None]):
        """`changed` is called when the server has answered."""
        self.identifier, self._changed = identifier, changed
        self.problem = ""
        self.share: float | None = None  # of a preparation that runs
        self.what = ""  # is being prepared, in the engine's words
        self.rests = False  # nothing of the picture moves
        self.shown: tuple = ()  # what the plane shows
        self.taken = 0  # how many recipes were taken
        self.read: dict = {}  # the recipe as the scene last had it, whether it is shown or not
        self.reads = 0  # how often it was another one
        self.recipe: dict = {}  # the one that was taken
        self._live = None
        self.folder = self._folder = Path()
        self._longest = 0
        self._cache: Path | None = None
        self.drafted = False  # frames are of what is cut out already of a recipe that is wrong otherwise
        self.sketch: Sketch | None = None  # until the matte itself is there
        self.active = ""  # the layer whose matte is looked at
        self._sketched, self._sketches, self._sketch_request = "", 0, 0
        self._subject: dict = {}  # the recipe that frames are asked of
        self._request = 0
        self._asked = ""
        self._gave_up = self._why = ""

    @property
    def live(self):
        """The engine's side, a stillwater.Live with frames to give; None where it has none."""
        return self._live if self._live is not None and self._live.ready else None

    def look(self, recipe: dict) -> None:
        """Notes the recipe as the scene has it now."""
        if recipe != self.read:
            self.read, self.reads = recipe, self.reads + 1

    def take(self, recipe: dict, folder: Path, longest: int, cache: Path | None, active: str = "") -> None:
        """Takes the recipe as it is now. Costs nothing where it is the same.

        `cache`: its folder; None = in `folder`. `active`: the layer that is drawn on: of its matte there is a sketch.
        """
        self.active = active
        if (recipe, folder, longest, cache) != (self.recipe, self._folder, self._longest, self._cache):
            self.recipe, self._folder, self._longest, self._cache = recipe, folder, longest, cache
            self._take()

    def again(self) -> None:
        """Tries anew what went wrong."""
        self._gave_up, self.problem = "", ""
        self.recipe = {}

    def close(self) -> None:
        """Asks for nothing any more."""
        server.cancel(self._request)
        server.cancel(self._sketch_request)

    def _take(self) -> None:
        try:
            if self._live is None:
                self._live = engine.live()
            ready = self._live.take(self.recipe, self._folder, self._longest, self._cache)
            self.problem, self.drafted = "", False
        except (ValueError, OSError) as error:
            self.problem = named(str(error), self._names())
            self._take_draft()
            return
        self._settle(self.recipe, ready)

    def _take_draft(self) -> None:
        """Where layers are cut out by what was drawn, they can be seen before all else is right."""
        draft, ready = draft_of(self.recipe), None
        self.drafted = any(solved_matte(draft, layer["name"]) for layer in draft["layers"])
        if self.drafted and self._live is not None:
            try:
                ready = self._live.take(draft, self._folder, self._longest, self._cache)
            except (ValueError, OSError):
                self.drafted = False
        if ready is None:
            server.cancel(self._request)
            self._asked, self.share = "", None
        else:
            self._settle(draft, ready)

    def _settle(self, subject: dict, ready: bool) -> None:
        self._subject = subject
        if not ready:
            self._ask_for_sketch()
            self._ask()
            return
        server.cancel(self._request)
        server.cancel(self._sketch_request)
        self._asked, self.share, self.sketch = "", None, None
        self.taken += 1

    def _ask_for_sketch(self) -> None:
        """Of the matte that is drawn on, where it is another than the last one: before what takes longer is asked."""
        matte = solved_matte(self._subject, self.active)
        wanted = json.dumps([self.active, matte, self._subject.get("picture"), str(self._folder)])
        if matte is None or wanted == self._sketched:
            return
        server.cancel(self._sketch_request)
        self._asked, self._sketched = "", wanted
        try:
            self._sketch_request = server.matte(
                self.identifier, self._subject, self._folder, self.active, self._told_sketch
            )
        except (ValueError, OSError):
            self._sketched = ""  # whoever asks for the layers says why

    def _told_sketch(self, event: dict) -> None:
        match event:
            case {"event": "matte", "key": str() as key, "layer": str() as layer}:
                matte = engine.quick_matte(key, self._cache or engine.cache_in(self._folder))
                if matte is not None:
                    self._sketches += 1
                    self.sketch = Sketch(layer, matte, self._sketches)
        self._changed()

    def _ask(self) -> None:
        wanted = json.dumps([preparation(self._subject), str(self._folder), self._longest, str(self._cache)])
        if wanted == self._gave_up:
            self.problem = self._why
            return
        if wanted == self._asked:
            return
        server.cancel(self._request)
        self._asked, self.share, self.what = wanted, 0.0, ""
        try:
            self._request = server.prepare(self.identifier, self._subject, self._folder, self._longest, self._told)
        except (ValueError, OSError) as error:
            self._give_up(str(error))

    def _give_up(self, sentence: str) -> None:
        self._gave_up, self._why = self._asked, sentence
        self._asked, self.share, self.problem = "", None, sentence

    def _names(self) -> list[str]:
        return [layer["name"] for layer in (self._subject if self.drafted else self.recipe)["layers"]]

    def _told(self, event: dict) -> None:
        """An answer of the server."""
        match event:
            case {"event": "preparing", "share": float() | int() as share, **more}:
                self.share, self.what = float(share), str(more.get("what", ""))
            case {"event": "done", "files": dict() as files}:
                self._live.learn(files)
                self._asked, self.share = "", None
                self._take()
            case {"event": "error", "sentence": str() as sentence}:
                self._give_up(named(sentence, self._names()))
        self._changed()


def preparation(recipe: dict) -> list:
    """What of a recipe must be prepared: the rest are numbers. What drifts or flows is made endless."""
    layers = [
        [*(layer.get(name) for name in ("matte", "fill", "feather", "follows")), _endless(layer)]
        for layer in recipe["layers"]
    ]
    return [recipe.get("picture"), recipe["colour_space"], recipe.get("fps"), recipe.get("loop"), layers]


def _endless(layer: dict):
    """What of its motion must be prepared: a flow's field and, where it is keyed, how far it carries; all of a clip."""
    motion = layer.get("motion", {})
    return motion if motion.get("type") in ("flow", "example") else motion.get("type") == "drift"


def moves(recipe: dict) -> bool:
    """Whether any frame differs from the picture."""
    layers = recipe["layers"]
    return any(
        layer["motion"]["type"] != "still" or not layer["visible"] or layer["opacity"] != 1 for layer in layers
    )
