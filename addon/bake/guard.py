"""Renders of frames that are missing or out of date: warn, bake first, or say nothing, as the person prefers.

The first frame of a render asks about itself alone; a second one says that it is an animation, and asks about all.
Blender has evaluated the nodes before it comes to a frame: what is changed in them then is seen a frame too late, new
files at once. So where a render bakes, the node is made ready when the render begins, with at least one frame, and does
not send missing frames to the nearest until the render has ended.

Where there is a window, Blender calls render handlers in the render's own thread. There nothing of Blender's is
touched: a wish is left to a timer of the main thread, and only who wants frames baked first waits for it. Should the
main thread be waiting for the render itself, its timer is silent: then the render goes on with the frames there are. In
background, or from a script, the main thread renders, and bakes by itself.
"""

import contextvars
import time
from dataclasses import dataclass, field

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from .. import preferences, versions
from ..compositor import tree as node
from . import job, outdated

INTERVAL = 0.25  # s, between two looks at wishes
SILENT = 5.0  # s without the main thread's timer, after which it counts as waiting for the render
LONG = 60.0  # s, the same while it looks at the frames
LOOK = 0.05  # s

_in_main_thread: contextvars.ContextVar[bool] = contextvars.ContextVar("_in_main_thread", default=False)


@dataclass
class Wish:
    """What a render asks for a scene: to BEGIN, this FRAME, ALL frames, or to END."""

    kind: str
    scene: str
    frame: int
    begun: bool = False
    over: bool = False
    bakes: list[int] = field(default_factory=list)  # the trees (session_uid) whose bakes it started


_wishes: list[Wish] = []
_frames_so_far = 0  # of the render that goes on
_heard = 0.0  # when the main thread's timer came last
_preference = "WARN"  # as the timer found it


def what_to_do_with_stale(context) -> str:
    """The person's preference: WARN, BAKE or NOTHING."""
    return preferences.of(context).stale_render


def render_begins(scene, *_) -> None:
    """A handler: a new render."""
    global _frames_so_far
    _frames_so_far = 0
    _ask("BEGIN", scene)


def frame_begins(scene, *_) -> None:
    """A handler: the render comes to a frame; what must be there is seen to."""
    global _frames_so_far
    _frames_so_far += 1
    if _frames_so_far <= 2:
        _ask("FRAME" if _frames_so_far == 1 else "ALL", scene)


def render_ends(scene, *_) -> None:
    """A handler: the render is over, or cancelled."""
    _ask("END", scene)


def _ask(kind: str, scene) -> None:
    wish = Wish(kind, scene.name, scene.frame_current)
    if _in_main_thread.get():
        _begin(wish, what_to_do_with_stale(bpy.context))
        for tree in _baking(wish):
            job.wait(tree)
        _finish(wish)
        return
    if _preference == "NOTHING":
        return
    _wishes.append(wish)
    while _preference == "BAKE" and kind != "END" and not wish.over:
        if time.monotonic() - _heard > (LONG if wish.begun else SILENT):
            print("Stillwater: Blender waits for this render; it goes on with the frames that there are", flush=True)
            wish.over = True
        time.sleep(LOOK)


def attend() -> float:
    """The main thread's timer: grants wishes, one after the other."""
    global _heard, _preference
    _heard, _preference = time.monotonic(), what_to_do_with_stale(bpy.context)
    while _wishes:
        wish = _wishes[0]
        if not wish.begun and not wish.over:
            wish.begun = True
            _begin(wish, _preference)
        if not wish.over and _baking(wish):
            break
        _finish(wish)
        wish.over = True
        _wishes.remove(wish)
    return INTERVAL


def _begin(wish: Wish, preference: str) -> None:
    """Warns of what a wish's frames are not, or starts their bakes."""
    for scene, picture in _shown(wish) if preference != "NOTHING" else ():
        if wish.kind == "BEGIN":
            if preference == "BAKE":
                _make_ready(scene, picture, wish)
        elif wish.kind in ("FRAME", "ALL"):
            _see_to(scene, picture, wish, preference)


def _see_to(scene, picture, wish: Wish, preference: str) -> None:
    found = outdated.look(scene, picture, play=False)
    if found.is_ready or (wish.kind == "FRAME" and not found.problem and found.at(wish.frame) == "ready"):
        return
    if found.problem or preference == "WARN":
        _say(f"{picture.name}: {'; '.join(found.lines)}")
    else:
        _bake(scene, picture, wish, None if wish.kind == "ALL" else wish.frame)


def _make_ready(scene, picture, wish: Wish) -> None:
    """The node reads the frames as they come; one there must be, whose passes it knows."""
    found = outdated.look(scene, picture, play=False)
    if found.is_ready or found.problem:
        return
    before, tree = picture.tree, node.ensure(scene, picture)
    _keep_step(before, tree)
    tree.stillwater.holds = False
    if not node.show(tree):
        _bake(scene, picture, wish, min(max(wish.frame, scene.frame_start), scene.frame_end))


def _bake(scene, picture, wish: Wish, frame: int | None) -> None:
    """Starts the bake of one frame, or of all; one that runs already is waited for."""
    before = picture.tree
    try:
        if not (before and job.running(before)):
            _keep_step(before, job.start(scene, picture, frames=None if frame is None else (frame, frame)))
        wish.bakes.append(picture.tree.session_uid)
    except (ValueError, OSError) as error:
        _say(f"{picture.name}: {error}")


def _keep_step(before, tree) -> None:
    """A tree that a render made becomes part of an undo step.

    Else undoing the step before would free it, and leave the scene, which is the same in both, pointing at it.
    """
    if tree != before:
        with _in_a_window():
            bpy.ops.ed.undo_push(message=rpt_("Bake"))


def _finish(wish: Wish) -> None:
    """After a wish: a bake that went wrong is said; then, and when the render ends, missing frames show the nearest."""
    for _, picture in _shown(wish):
        tree = picture.tree
        if tree is None or job.running(tree):
            continue
        went_wrong = tree.session_uid in wish.bakes and tree.stillwater.state in ("failed", "cancelled")
        if went_wrong:
            _say(f"{picture.name}: {tree.stillwater.message}")
        if (went_wrong or wish.kind == "END") and not tree.stillwater.holds:
            tree.stillwater.holds = True
            node.show(tree)


def _shown(wish: Wish) -> list[tuple]:
    """The scene's pictures whose nodes its render goes through."""
    scene = bpy.data.scenes.get(wish.scene)
    if scene is None or not versions.composites(scene):
        return []
    if wish.kind in ("FRAME", "ALL") and not scene.frame_start <= wish.frame <= scene.frame_end:
        return []
    return [(scene, picture) for picture in scene.stillwater.pictures if node.nodes_of(scene, picture.id)]


def _baking(wish: Wish) -> list:
    """The trees whose bakes it waits for."""
    return [tree for tree in job.running_trees() if tree.session_uid in wish.bakes]


def _say(sentence: str) -> None:
    """On the console, and where there is a window in a pop-up."""
    print(f"Stillwater: {sentence}", flush=True)
    if not bpy.app.background and bpy.context.window_manager.windows:
        with _in_a_window():
            bpy.context.window_manager.popup_menu(
                lambda menu, _: menu.layout.label(text=sentence), title="Stillwater", icon="ERROR"
            )


def _in_a_window():
    """What operators and pop-ups ask for, which a timer has not."""
    return bpy.context.temp_override(window=next(iter(bpy.context.window_manager.windows), None))


def register():
    _in_main_thread.set(True)
    if not bpy.app.background:
        bpy.app.timers.register(attend, persistent=True)


def unregister():
    _wishes.clear()
    if bpy.app.timers.is_registered(attend):
        bpy.app.timers.unregister(attend)
