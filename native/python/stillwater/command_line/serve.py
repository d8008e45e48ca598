"""`stillwater serve`: prepares what live work needs, request after request, until its standard input ends.

A request is a line of JSON on standard input, an answer one on standard output, with the request's `id`:

    {"id": 1, "do": "prepare", "recipe": "lake/recipe.json", "folder": "lake", "longest": 960}
    {"id": 1, "event": "preparing", "share": 0.4, "what": "cutting out tree"}
    {"id": 1, "event": "done", "key": ..., "files": ...}        or "error" with a sentence, or "cancelled"
    {"id": 2, "do": "matte", "recipe": "lake/recipe.json", "layer": "boat"}
    {"id": 2, "event": "matte", "key": ..., "layer": "boat"}
    {"id": 1, "do": "cancel"}

One request is worked on at a time. A newer one for the same recipe cancels the older; but a matte, which is there at
once, is not cancelled by the `prepare` that follows it.
"""

import sys
from pathlib import Path
from typing import Annotated

import msgspec
from msgspec import Meta, Struct

from ..render.events import Dropped, Error, Event
from . import cache_options


class Request(Struct, tag_field="do", tag=str.lower, forbid_unknown_fields=True):
    """What every request has."""

    id: int


class Prepare(Request):
    """Layers for frames whose longer side is `longest` pixels. What they give lies in the cache.

    `recipe`: its file; `folder`: where its relative paths start, where not beside the file. The cache lies there too,
    unless `--cache` says where.
    """

    recipe: Annotated[str, Meta(min_length=1)]
    folder: Annotated[str, Meta(min_length=1)] | None = None
    longest: Annotated[int, Meta(ge=16, le=16384)] = 960


class Matte(Request):
    """The matte of a layer while it is drawn: near to what it will be, and soon. Fields as of Prepare."""

    recipe: Annotated[str, Meta(min_length=1)]
    layer: str
    folder: Annotated[str, Meta(min_length=1)] | None = None


class Cancel(Request):
    """Ends the request with this id, if it is not over."""


class Stopped(Exception):
    """The request at work is not wanted any more."""


def add_to(commands) -> None:
    parser = commands.add_parser("serve", help="prepare what live pictures need, asked by JSON lines on standard input")
    parser.add_argument("--threads", type=int, default=0, metavar="N", help="0: one a core")
    cache_options.add_to(parser)
    parser.set_defaults(run=_run, file="serve")


def _run(given) -> None:
    from .. import _stillwater as engine

    engine.install_signal_handler()
    engine.listen_to_standard_input()
    engine.set_threads(given.threads)
    server = Server(engine.next_line, _say, given.cache and given.cache.absolute(), given.cache_limit)
    while True:
        server.step()


def _say(identifier: int | None, event: Event) -> None:
    answer = {"id": identifier, **msgspec.to_builtins(event)}
    sys.stdout.write(msgspec.json.encode(answer).decode() + "\n")
    sys.stdout.flush()


class Server:
    """Takes requests from `next_line(seconds)` and answers with `say(id, event)`.

    `cache`: its folder, None = one in each recipe's folder; `limit`: bytes that it may hold, None = the usual.
    """

    def __init__(self, next_line, say, cache: Path | None = None, limit: int | None = None):
        self._next_line, self._say, self._cache, self._limit = next_line, say, cache, limit
        self._waiting: list[Prepare | Matte] = []
        self._at_work: Prepare | Matte | None = None
        self._pictures = None
        self._stopped = False

    def step(self) -> None:
        """Does what waits, or waits for what comes."""
        self._listen(0 if self._waiting else 3600)
        if self._waiting:
            self._work(self._waiting.pop(0))

    def _listen(self, seconds: float) -> None:
        while (line := self._next_line(seconds)) is not None:
            seconds = 0
            if not line.strip():
                continue
            try:
                self._take(msgspec.json.decode(line, type=Prepare | Matte | Cancel))
            except (msgspec.DecodeError, UnicodeDecodeError) as error:
                self._say(_identifier(line), Error(f"request: {error}"))

    def _take(self, request: Prepare | Matte | Cancel) -> None:
        drop = self._same_id if isinstance(request, Cancel) else self._same_recipe
        for older in [each for each in self._waiting if drop(each, request)]:
            self._waiting.remove(older)
            self._say(older.id, Dropped())
        if self._at_work and drop(self._at_work, request):
            self._stopped = True
        if not isinstance(request, Cancel):
            self._waiting.append(request)

    @staticmethod
    def _same_id(older: Prepare | Matte, request: Request) -> bool:
        return older.id == request.id

    @staticmethod
    def _same_recipe(older: Prepare | Matte, request: Prepare | Matte) -> bool:
        return older.recipe == request.recipe and (isinstance(older, Prepare) or isinstance(request, Matte))

    def _beat(self) -> None:
        self._listen(0)
        if self._stopped:
            raise Stopped

    def _work(self, request: Prepare | Matte) -> None:
        from ..recipe import parse
        from ..render.cache import FOLDER, LIMIT, Cache
        from .show import sentence_of

        self._at_work, self._stopped = request, False
        try:
            path = Path(request.recipe)
            document = parse(path.read_bytes(), Path(request.folder or path.parent).resolve())
            cache = Cache(self._cache or document.folder / FOLDER, self._limit or LIMIT)
            for event in self._events(request, document, cache):
                self._beat()
                self._say(request.id, event)
        except Stopped:
            self._say(request.id, Dropped())
        except BrokenPipeError:
            raise
        except Exception as error:  # noqa: BLE001  the next request may be right
            self._say(request.id, Error(sentence_of(error)))
        finally:
            self._at_work = None

    def _events(self, request: Prepare | Matte, document, cache):
        from ..render.preview import prepare
        from ..render.quick_matte import Pictures, quick_matte

        if isinstance(request, Prepare):
            return prepare(document, request.longest, cache, self._beat)
        self._pictures = self._pictures or Pictures()
        return quick_matte(document, request.layer, cache, self._pictures, self._beat)


def _identifier(line: bytes) -> int | None:
    """The id of a request that is wrong otherwise."""
    try:
        identifier = msgspec.json.decode(line)["id"]
    except (msgspec.DecodeError, UnicodeDecodeError, TypeError, KeyError):
        return None
    return identifier if isinstance(identifier, int) else None
