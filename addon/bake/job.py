"""Bakes that run: a worker each, looked after by a timer.

No Python thread, no modal operator (it would suspend autosave). Between two ticks nothing of Blender's is kept but a
tree's session_uid: undo and loading may replace everything else. What panels show stands on the tree.
"""

import json
import time

import bpy

from .. import engine, preferences, strokes, versions
from ..compositor import tree as node
from ..properties import image
from ..recipe.animation import Animation
from ..recipe.write import frames_to_sample, recipe_of
from . import places
from .progress import Progress
from .worker import Worker

INTERVAL = 0.1  # s

_jobs: dict[int, tuple[Worker, Progress]] = {}  # by the tree's session_uid


def write_recipe(scene, picture) -> str:
    """Writes the picture's recipe into its folder and returns the file's path."""
    folder = places.folder_of(picture)
    scene.view_layers[0].update()  # a script may have moved what strokes are seen through
    data = scene.animation_data
    animation = Animation(
        scene,
        picture.path_from_id(),
        frames_to_sample(scene.frame_start, scene.frame_end),
        versions.curves_of(data.action, data.action_slot) if data else (),
        versions.stripped_paths(data) if data else (),
    )
    recipe = recipe_of(scene, picture, animation, places.locate_from(folder), strokes.drawn(scene, picture))
    path = folder / "recipe.json"
    unfinished = path.with_suffix(".json.part")
    unfinished.write_text(json.dumps(recipe, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    unfinished.replace(path)
    return str(path)


def start(scene, picture, fresh: bool = False):
    """Writes the recipe and starts its worker; returns the tree. Throws ValueError and OSError with a sentence."""
    chosen = preferences.of(bpy.context)
    command = engine.worker_command(chosen.python)
    tree = node.claim(scene, picture)
    if tree.session_uid in _jobs:
        raise ValueError(f"{picture.name}: is being baked already")
    image.take_over(picture)
    image.check(picture)
    command += ["render", write_recipe(scene, picture), "--progress", "json", "--parent"]
    command += chosen.worker_options()
    command += ["--fresh"] if fresh else []
    state = tree.stillwater
    state.folder = places.locate_in(places.frames_of(picture))(".")
    state.name = picture.output.name
    state.first, state.last = scene.frame_start, scene.frame_end
    _jobs[tree.session_uid] = Worker(command, bpy.app.tempdir), Progress()
    _tell(tree, _jobs[tree.session_uid][1])
    if not bpy.app.timers.is_registered(tick):
        bpy.app.timers.register(tick, first_interval=INTERVAL)
    return tree


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
            worker.close()
            del _jobs[uid]
            continue
        events, code = worker.poll()
        for event in events:
            progress.take(event)
        if code is not None:
            progress.end(code, worker.last_words())
            worker.close()
            del _jobs[uid]
            node.show(tree)
        _tell(tree, progress)
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


def settle() -> None:
    """After a file was opened or a step undone: what says that it is being baked, and is not, was cancelled."""
    for tree in bpy.data.node_groups:
        if tree.bl_idname == "CompositorNodeTree" and tree.stillwater.state == "running" and not running(tree):
            tree.stillwater.state, tree.stillwater.message = "cancelled", "Interrupted; the frames made so far are kept"


def end_all() -> None:
    """Ends every worker."""
    for worker, _ in _jobs.values():
        worker.close()
    _jobs.clear()
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)


def _tell(tree, progress: Progress) -> None:
    """Puts the progress where panels read it."""
    state = tree.stillwater
    state.state, state.share, state.message = progress.state, progress.share, progress.message
    state.warning = "\n".join(progress.warnings)
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in {"VIEW_3D", "NODE_EDITOR"}:
                area.tag_redraw()
