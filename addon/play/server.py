"""`stillwater serve`: one process for each Blender, started when something must be prepared.

A timer reads what it says. It ends with Blender, as its standard input does.
"""

import json
from collections.abc import Callable
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from .. import engine, preferences
from ..bake.worker import Worker, ending

INTERVAL = 0.04  # s
OVER = {"done", "matte", "error", "cancelled"}  # the last answer to a request

_worker: Worker | None = None
_command: list[str] = []  # what started it
_open: dict[int, Callable[[dict], None]] = {}  # requests that are not over, and who is told
_last = 0


def prepare(name: str, recipe: dict, folder: Path, longest: int, told: Callable[[dict], None]) -> int:
    """Asks for a recipe's layers at the size of a screen; a newer request of the same `name` ends the older.

    `told` gets every answer; the last is a "done", an "error" or a "cancelled". Returns the request's number. Throws
    ValueError without an engine, OSError where the process can't be started.
    """
    return _ask(name, recipe, folder, told, {"do": "prepare", "longest": longest})


def matte(name: str, recipe: dict, folder: Path, layer: str, told: Callable[[dict], None]) -> int:
    """Asks for the matte of the layer of this name, near to what it will be, soon; else as prepare().

    It ends what is prepared for the same `name`, and is not ended by a prepare() that follows. The last answer is a
    "matte", an "error" or a "cancelled".
    """
    return _ask(name, recipe, folder, told, {"do": "matte", "layer": layer})


def wake() -> None:
    """Starts the process, where there is none, for a request that is soon to come. Throws ValueError, OSError."""
    global _worker, _command
    chosen = preferences.of(bpy.context)
    command = [*engine.serve_command(chosen.python), *chosen.worker_options()]
    if command != _command and not _open:  # the preferences changed
        end()
    if _worker is None:
        _worker, _command = Worker(command, bpy.app.tempdir), command


def _ask(name: str, recipe: dict, folder: Path, told: Callable[[dict], None], request: dict) -> int:
    global _last
    wake()
    path = Path(bpy.app.tempdir, f"stillwater-live-{name}.json")
    unfinished = path.with_suffix(".part")
    unfinished.write_text(json.dumps(recipe), encoding="utf-8")
    unfinished.replace(path)  # whole: the process may be about to read it for the request before
    _last += 1
    _open[_last] = told
    try:
        _worker.tell({"id": _last, "recipe": str(path), "folder": str(folder), **request})
    except OSError:
        tick()  # it has ended: that is said to all
    if not bpy.app.timers.is_registered(tick):
        bpy.app.timers.register(tick, first_interval=INTERVAL)
    return _last


def cancel(number: int) -> None:
    """Ends a request; nobody is told of it any more."""
    if _open.pop(number, None) is not None and _worker is not None:
        try:
            _worker.tell({"id": number, "do": "cancel"})
        except OSError:
            tick()


def tick() -> float | None:
    """Reads what was said; called by a timer while anything is asked."""
    global _worker
    if _worker is None:
        return None
    events, code = _worker.poll()
    for event in events:
        told = _open.get(event.get("id"))
        if told is None:
            continue
        if event["event"] in OVER:
            del _open[event["id"]]
        told(event)
    if code is not None:
        sentence = ending(code, _worker.last_words(), rpt_)
        _worker.close()
        _worker = None
        waiting = list(_open.values())
        _open.clear()
        for told in waiting:
            told({"event": "error", "sentence": sentence})
    return INTERVAL if _open else None


def end() -> None:
    """Ends the process, at once."""
    global _worker
    _open.clear()
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)
    if _worker is not None:
        _worker.close()
        _worker = None
