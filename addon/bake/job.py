"""Bakes that run: a worker each, looked after by a timer.

No Python thread, no modal operator (it would suspend autosave). Between two ticks nothing of Blender's is kept but a
tree's session_uid: undo and loading may replace everything else. What panels show stands on the tree.
"""

import json
import time
from pathlib import Path

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from .. import engine, preferences, strokes, versions
from ..compositor import tree as node
from ..compositor.frames import spans
from ..properties import image
from ..recipe.animation import Animation
from ..recipe.sentences import named
from ..recipe.write import frames_to_sample, recipe_of
from ..ui import redraw
from . import places
from .progress import Progress
from .worker import Worker

INTERVAL = 0.1  # s, between two looks at the workers
TELLING = 0.5  # s, between two changes of what panels show: each draws them anew

_jobs: dict[int, tuple[Worker, Progress]] = {}  # by the tree's session_uid
_told: dict[int, float] = {}  # when each one's tree was told last
over: list = []  # called with each tree whose bake is over


def describe(scene, picture, folder: Path, frames: range | None = None) -> dict:
    """The picture's recipe, its paths relative to `folder`. `frames`: where animated numbers are asked for, else all.

    Throws ValueError where strokes can't be read.
    """
    scene.view_layers[0].update()  # a script may have moved what strokes are seen through
    data = scene.animation_data
    animation = Animation(
        scene,
        picture.path_from_id(),
        frames or frames_to_sample(scene.frame_start, scene.frame_end),
        versions.curves_of(data.action, data.action_slot) if data else (),
        versions.stripped_paths(data) if data else (),
    )
    return recipe_of(scene, picture, animation, places.locate_from(folder), strokes.drawn(scene, picture))


def write_recipe(scene, picture, path: Path | None = None) -> str:
    """Writes the picture's recipe to `path`, or into its folder, and returns the file's path.

    Throws OSError, and ValueError where strokes can't be read.
    """
    path = path or places.folder_of(picture) / "recipe.json"
    recipe = describe(scene, picture, path.parent)
    unfinished = path.with_name(f"{path.name}.part")
    unfinished.write_text(json.dumps(recipe, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    unfinished.replace(path)
    return str(path)


def start(scene, picture, fresh: bool = False, frames: tuple[int, int] | None = None):
    """Writes the recipe and starts its worker; returns the tree. Throws ValueError and OSError with a sentence.

    `frames`: first and last to bake, instead of all; the node shows all that are there, whichever.
    """
    chosen = preferences.of(bpy.context)
    command = engine.worker_command(chosen.python)
    tree = node.claim(scene, picture)
    if tree.session_uid in _jobs:
        raise ValueError(rpt_("{name}: is being baked already").format(name=picture.name))
    image.take_over(picture)
    image.check(picture)
    command += ["render", _write_own_recipe(scene, picture), "--progress", "json", "--parent"]
    command += chosen.worker_options()
    command += ["--frames", f"{frames[0]}-{frames[1]}"] if frames else []
    command += ["--fresh"] if fresh else []
    node.describe(tree, scene, picture, places.locate_in(places.frames_of(picture))("."), layers_alone(picture))
    progress = Progress(layers=[layer.name for layer in picture.layers], said=rpt_)
    _jobs[tree.session_uid] = Worker(command, bpy.app.tempdir), progress
    _tell(tree, progress)
    if not bpy.app.timers.is_registered(tick):
        bpy.app.timers.register(tick, first_interval=INTERVAL)
    return tree


def _write_own_recipe(scene, picture) -> str:
    try:
        return write_recipe(scene, picture)
    except OSError as error:
        why = f"{error.filename}: {error.strerror}" if error.filename else str(error)
        raise ValueError(rpt_("{why}; save the file where a folder can be made beside it").format(why=why)) from None


def layers_alone(picture) -> list[tuple[str, str]]:
    """Name and EXR layer of each layer that the frames hold beside the whole. Throws ValueError."""
    named = [layer.name for layer in picture.layers if layer.visible] if picture.output.layers else []
    return list(zip(named, engine.layer_names(named), strict=True)) if named else []


def running(tree) -> bool:
    return tree.session_uid in _jobs


def cancel(tree) -> None:
    """Asks the tree's worker to end."""
    worker, progress = _jobs[tree.session_uid]
    progress.cancelled = True
    worker.cancel()


def end(tree) -> None:
    """Ends the tree's worker at once, where there is one."""
    worker, _ = _jobs.pop(tree.session_uid, (None, None))
    if worker is not None:
        worker.close()


def tick() -> float | None:
    """Reads what all workers said; called by a timer while there is one."""
    trees = {tree.session_uid: tree for tree in bpy.data.node_groups if tree.bl_idname == "CompositorNodeTree"}
    for uid, (worker, progress) in list(_jobs.items()):
        tree = trees.get(uid)
        if tree is None:  # removed, or another file was opened
            _end(uid)
            continue
        events, code = worker.poll()
        for event in events:
            progress.take(event)
        if code is not None:
            progress.end(code, worker.last_words())
            _end(uid)
            node.show(tree)
        if code is not None or time.monotonic() - _told.get(uid, 0) >= TELLING:
            _tell(tree, progress)
        if code is not None:
            for told in over:
                told(tree)
    return INTERVAL if _jobs else None


def wait(tree) -> None:
    """Stays until the tree's bake is over: in background no timer runs."""
    manager = bpy.context.window_manager
    manager.progress_begin(0, 1)
    try:
        while running(tree):
            tick()
            manager.progress_update(tree.stillwater.share)
            time.sleep(INTERVAL / 5)
    except KeyboardInterrupt:
        end_all()
        raise
    finally:
        manager.progress_end()


def running_trees() -> list:
    """The trees that are being baked."""
    return [tree for tree in bpy.data.node_groups if tree.session_uid in _jobs]


def settle() -> None:
    """After a file was opened or a step undone: what says that it is being baked, and is not, has ended since.

    Frames that lie on disk now, whatever happened since the file was saved, are shown. Where all are there, the bake ended
    well; else it was cancelled.
    """
    for tree in _trees():
        _follow_frames(tree)
        if not running(tree) and not tree.stillwater.holds:
            tree.stillwater.holds = True
            node.show(tree)
        elif node.changed_on_disk(tree):
            node.show(tree)
        state = tree.stillwater
        if state.state == "running" and not running(tree):
            whole = state.there == spans(list(range(state.first, state.last + 1)))
            state.state, state.message = "done" if whole else "cancelled", ""
            if not whole:
                state.message = rpt_("Interrupted; the frames made so far are kept")


def _follow_frames(tree) -> None:
    """A step from before the file was saved for the first time knows the frames where they lay until then."""
    state = tree.stillwater
    if not bpy.data.filepath or not Path(state.folder).is_relative_to(places.root_of("")) or Path(state.folder).is_dir():
        return
    pictures = [picture for scene in bpy.data.scenes for picture in scene.stillwater.pictures if picture.tree == tree]
    for picture in pictures[:1]:
        state.folder = places.locate_in(places.frames_of(picture))(".")
        node.show(tree)


def before_undo() -> None:
    """What the timers put on the trees is taken off them; settle() brings it back."""
    for tree in _trees():
        node.let_go(tree)


def _trees() -> list:
    """The trees of all pictures of this file."""
    groups = [tree for tree in bpy.data.node_groups if tree.bl_idname == "CompositorNodeTree" and tree.library is None]
    return [tree for tree in groups if tree.stillwater.picture]


def _end(uid: int) -> None:
    worker, _ = _jobs.pop(uid)
    worker.close()
    _told.pop(uid, None)


def end_all() -> None:
    """Ends every worker."""
    for uid in list(_jobs):
        _end(uid)
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)


def _tell(tree, progress: Progress) -> None:
    """Puts the progress where panels read it."""
    _told[tree.session_uid] = time.monotonic()
    state = tree.stillwater
    message, *warnings = [named(said, progress.layers) for said in (progress.message, *progress.warnings)]
    now = {"state": progress.state, "share": progress.share, "message": message, "left": progress.left()}
    for name, value in {**now, "warning": "\n".join(warnings)}.items():
        if getattr(state, name) != value:
            setattr(state, name, value)
    redraw.panels()
    redraw.status_bars()
