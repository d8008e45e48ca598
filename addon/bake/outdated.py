"""Which frames of the scene's pictures are out of date, and why.

Panels, nodes and renders ask `of(picture)`, which computes nothing. A timer looks again and again, in steps of a few ms
and never for more than a twentieth of the time: Blender tells nobody when a property of the scene is changed.
"""

import json
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from .. import engine, preferences, versions
from ..compositor import tree as node
from ..recipe.animation import facts_of
from ..ui import redraw
from . import job, places
from .collect import files_of
from .report import Report, report

INTERVAL = 0.1  # s, between two steps
STEP = 0.004  # s, what a step may take
PAUSE = 0.5  # s, at least between two looks at a picture
SHARE = 20  # times what a look at the recipe takes must pass before the next one
PLAYED = "Driven values: Check Frames says what is out of date"


@dataclass
class _Picture:
    """What is known of one picture."""

    report: Report | None = None
    glance: str = ""  # what the report was found for
    steps: Iterator | None = None  # of a look that is not over
    due: float = 0.0  # when to look again
    marks: dict[Path, tuple] = field(default_factory=dict)  # what frames' files say, by their size and time


_known: dict[str, _Picture] = {}  # by scene's name and picture's id


def of(scene, picture) -> Report | None:
    """How the picture's frames stand, as far as it is known."""
    known = _known.get(_key(scene, picture))
    return known.report if known else None


def look(scene, picture, play: bool = True) -> Report:
    """Looks now, to the end. `play`: may go through the scene's frames, where drivers or strips ask for it."""
    known = _known.setdefault(_key(scene, picture), _Picture())
    known.steps = None
    if not play and _needs_playing(scene, picture):
        known.report = Report(problem=rpt_(PLAYED))
    else:
        for _ in _steps(known, scene, picture):
            pass
    _show(picture, known.report)
    return known.report


def touch(*_) -> None:
    """Something changed: what is known is looked at again at once."""
    for known in _known.values():
        known.due = 0.0


def forget() -> None:
    """Another file."""
    _known.clear()


def tick() -> float:
    """One step; called by a timer."""
    manager = bpy.context.window_manager
    scene = manager.windows[0].scene if manager.windows else bpy.context.scene
    if scene is None or any(window.screen.is_animation_playing for window in manager.windows):
        return INTERVAL
    end = time.monotonic() + STEP
    for picture in scene.stillwater.pictures:
        if _is_baking(picture):
            continue
        known = _known.setdefault(_key(scene, picture), _Picture())
        if known.steps is None and time.monotonic() >= known.due:
            _begin(known, scene, picture)
        while known.steps is not None and time.monotonic() < end:
            if next(known.steps, True):
                known.steps = None
                _show(picture, known.report)
    return INTERVAL


def _begin(known: _Picture, scene, picture) -> None:
    """Starts a look, and says when the next one is due."""
    start, before = time.monotonic(), known.report
    if _needs_playing(scene, picture):
        known.report = Report(problem=rpt_(PLAYED))
    else:
        known.steps = _steps(known, scene, picture)
        if next(known.steps, True):  # over already: nothing has changed
            known.steps = None
    known.due = time.monotonic() + max(PAUSE, SHARE * (time.monotonic() - start))
    if known.steps is None and known.report != before:
        _show(picture, known.report)


def _steps(known: _Picture, scene, picture) -> Iterator[bool]:
    """Looks at one frame a step; leaves the report. What is wrong with the recipe is the report's problem."""
    try:
        if picture.tree is None or not picture.tree.stillwater.there:
            known.report, known.glance = Report(missing=((scene.frame_start, scene.frame_end),), said=rpt_), ""
            return
        folder = places.folder_of(picture)
        glance = _glance(scene, picture, folder)
        if glance == known.glance:
            return
        recipe = job.describe(scene, picture, folder)
        yield False
        cache = preferences.of(bpy.context).cache()
        standing = engine.standing(engine.parse(recipe, folder), lambda path: _mark(known, path), cache)
        found = []
        for frames in standing.all():
            found.append(frames)
            yield False
        spans = engine.joined(found)
        known.report, known.glance = report(spans, engine.by_reason(spans), rpt_), glance
    except (ValueError, OSError) as error:
        known.report, known.glance = Report(problem=" ".join(str(error).splitlines())), ""


def _glance(scene, picture, folder: Path) -> str:
    """All that a report follows from, had quickly: F-curves by their keys, files by their time."""
    recipe = job.describe(scene, picture, folder, range(scene.frame_start, scene.frame_start + 1))
    data, path = scene.animation_data, picture.path_from_id()
    curves = versions.curves_of(data.action, data.action_slot) if data else []
    keys = [facts_of(curve) for curve in curves if curve.data_path.startswith(path)]
    return json.dumps([recipe, keys, _state_of(folder, recipe)])


def _state_of(folder: Path, recipe: dict) -> list:
    """What of the disk a report depends on: the frames' folder, and the files that the recipe names."""
    named = [part[name] for part, name in files_of(recipe)]
    return [_time_of(folder / name) for name in [recipe["output"]["folder"], *named]]


def _time_of(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return 0


def _mark(known: _Picture, path: Path):
    """What a frame's file says, read once for each of its states."""
    state = path.stat()
    key = state.st_mtime_ns, state.st_size
    if known.marks.get(path, (None,))[0] != key:
        known.marks[path] = key, engine.read_mark(path)
    return known.marks[path][1]


def _show(picture, found: Report | None) -> None:
    """Lets nodes and panels say it."""
    if picture.tree is not None and found is not None and picture.tree.library is None:
        node.label(picture.tree, found.words)
    redraw.panels()


def _needs_playing(scene, picture) -> bool:
    """Whether drivers or strips animate it: then its numbers are had only by going through the frames."""
    data = scene.animation_data
    paths = {driver.data_path for driver in data.drivers} | versions.stripped_paths(data) if data else set()
    return any(path.startswith(picture.path_from_id()) for path in paths)


def _is_baking(picture) -> bool:
    return picture.tree is not None and job.running(picture.tree)


def _key(scene, picture) -> str:
    return f"{scene.name}/{picture.id}"


def register():
    if not bpy.app.background:
        bpy.app.timers.register(tick, first_interval=INTERVAL, persistent=True)


def unregister():
    _known.clear()
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)
