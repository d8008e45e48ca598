"""One picture as the viewport shows it: its recipe, the frames from it, what is missing and what went wrong.

    recipe changed --take--> ready: frames of it
                        \\-> something must be prepared: the server is asked, frames stay those of the recipe before
                        \\-> wrong: no frames, and a sentence that says why
"""

import json
from collections.abc import Callable
from pathlib import Path

from .. import engine
from ..recipe.sentences import named
from . import server


class Stage:
    """Throws nothing: `problem` says what keeps it from showing frames."""

    def __init__(self, identifier: str, changed: Callable[[], None]):
        """`changed` is called when the server has answered."""
        self.identifier, self._changed = identifier, changed
        self.problem = ""
        self.share: float | None = None  # of a preparation that runs
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

    def take(self, recipe: dict, folder: Path, longest: int, cache: Path | None) -> None:
        """Takes the recipe as it is now. Costs nothing where it is the same.

        `cache`: its folder; None = in `folder`.
        """
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

    def _take(self) -> None:
        try:
            if self._live is None:
                self._live = engine.live()
            ready = self._live.take(self.recipe, self._folder, self._longest, self._cache)
            self.problem, self.taken = "", self.taken + ready
        except (ValueError, OSError) as error:
            server.cancel(self._request)
            self._asked, self.share, self.problem = "", None, named(str(error), self._names())
            return
        if ready:
            server.cancel(self._request)
            self._asked, self.share = "", None
        else:
            self._ask()

    def _ask(self) -> None:
        wanted = json.dumps([preparation(self.recipe), str(self._folder), self._longest, str(self._cache)])
        if wanted == self._gave_up:
            self.problem = self._why
            return
        if wanted == self._asked:
            return
        server.cancel(self._request)
        self._asked, self.share = wanted, 0.0
        try:
            self._request = server.prepare(self.identifier, self.recipe, self._folder, self._longest, self._told)
        except (ValueError, OSError) as error:
            self._give_up(str(error))

    def _give_up(self, sentence: str) -> None:
        self._gave_up, self._why = self._asked, sentence
        self._asked, self.share, self.problem = "", None, sentence

    def _names(self) -> list[str]:
        return [layer["name"] for layer in self.recipe["layers"]]

    def _told(self, event: dict) -> None:
        """An answer of the server."""
        match event:
            case {"event": "preparing", "share": float() | int() as share}:
                self.share = float(share)
            case {"event": "done", "files": dict() as files}:
                self._live.learn(files)
                self._asked, self.share = "", None
                self._take()
            case {"event": "error", "sentence": str() as sentence}:
                self._give_up(named(sentence, self._names()))
        self._changed()


def preparation(recipe: dict) -> list:
    """What of a recipe must be prepared: the rest are numbers. What drifts is made endless."""
    layers = [
        [*(layer.get(name) for name in ("matte", "fill", "feather", "follows")), layer["motion"]["type"] == "drift"]
        for layer in recipe["layers"]
    ]
    return [recipe.get("picture"), recipe["colour_space"], layers]


def moves(recipe: dict) -> bool:
    """Whether any frame differs from the picture."""
    layers = recipe["layers"]
    return any(
        layer["motion"]["type"] != "still" or not layer["visible"] or layer["opacity"] != 1 for layer in layers
    )
