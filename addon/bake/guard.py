"""Renders of frames that are missing or out of date: warn, bake first, or say nothing, as the person prefers.

The first frame of a render asks about itself alone; a second one says that it is an animation, and asks about all.

Where there is a window, Blender calls render handlers in the render's own thread. There nothing of Blender's is touched:
a wish is left to a timer of the main thread, and only who wants frames baked first waits for it. Should the main
thread be waiting for the render itself, its timer is silent: then the render goes on with the frames there are. In
background, or from a script, the main thread renders, and bakes by itself.
"""

import contextvars
import time
from dataclasses import dataclass

import bpy

from .. import versions
from ..compositor import tree as node
from . import job, outdated

INTERVAL = 0.25  # s, between two looks at wishes
SILENT = 5.0  # s without the main thread's timer, after which it counts as waiting for the render
LOOK = 0.05  # s

PACKAGE = __package__.rpartition(".")[0]
_in_main_thread: contextvars.ContextVar[bool] = contextvars.ContextVar("_in_main_thread", default=False)


@dataclass
class Wish:
    """What a render asks for: one frame of a scene, or all."""

    scene: str
    frame: int
    whole: bool
    begun: bool = False
    over: bool = False


_wishes: list[Wish] = []
_frames_so_far = 0  # of the render that goes on
_heard = 0.0  # when the main thread's timer came last
_preference = "WARN"  # as the timer found it


def what_to_do_with_stale(context) -> str:
    """The person's preference: WARN, BAKE or NOTHING."""
    addon = context.preferences.addons.get(PACKAGE)
    return getattr(addon.preferences if addon else None, "stale_render", "WARN")


def render_begins(scene, *_) -> None:
    """A handler: a new render."""
    global _frames_so_far
    _frames_so_far = 0


def frame_begins(scene, *_) -> None:
    """A handler: the render comes to a frame; what must be there is seen to."""
    global _frames_so_far
    _frames_so_far += 1
    if _frames_so_far > 2:
        return
    wish = Wish(scene.name, scene.frame_current, _frames_so_far == 2)
    if _in_main_thread.get():
        _grant_here(wish)
    elif _preference != "NOTHING":
        _wishes.append(wish)
        while _preference == "BAKE" and not wish.over:
            if time.monotonic() - _heard > SILENT:
                print("Stillwater: Blender waits for this render; it goes on with the frames that there are", flush=True)
                wish.over = True
            time.sleep(LOOK)


def attend() -> float:
    """The main thread's timer: grants wishes."""
    global _heard, _preference
    _heard, _preference = time.monotonic(), what_to_do_with_stale(bpy.context)
    for wish in list(_wishes):
        if not wish.begun:
            wish.begun = True
            _begin(wish, _preference)
        if not any(job.running(tree) for tree in _trees_of(wish)):
            wish.over = True
        if wish.over:
            _wishes.remove(wish)
    return INTERVAL


def _grant_here(wish: Wish) -> None:
    _begin(wish, what_to_do_with_stale(bpy.context))
    for tree in _trees_of(wish):
        if job.running(tree):
            job.wait(tree)
            if tree.stillwater.state != "done":
                _say(f"{tree.name}: {tree.stillwater.message}")


def _begin(wish: Wish, preference: str) -> None:
    """Warns of what a wish's frames are not, or starts their bakes."""
    for scene, picture in _shown(wish) if preference != "NOTHING" else ():
        found = outdated.look(scene, picture, play=False)
        if found.is_ready or not (found.problem or wish.whole or found.at(wish.frame) != "ready"):
            continue
        if found.problem or preference == "WARN":
            _say(f"{picture.name}: {'; '.join(found.lines)}")
            continue
        try:
            job.start(scene, picture, frames=None if wish.whole else (wish.frame, wish.frame))
        except (ValueError, OSError) as error:
            _say(f"{picture.name}: {error}")


def _shown(wish: Wish) -> list[tuple]:
    """The scene's pictures whose nodes its render goes through."""
    scene = bpy.data.scenes.get(wish.scene)
    if scene is None or not versions.composites(scene) or not scene.frame_start <= wish.frame <= scene.frame_end:
        return []
    return [(scene, picture) for picture in scene.stillwater.pictures if node.nodes_of(scene, picture.id)]


def _trees_of(wish: Wish) -> list:
    return [picture.tree for _, picture in _shown(wish) if picture.tree is not None]


def _say(sentence: str) -> None:
    """On the console, and where there is a window in a pop-up."""
    print(f"Stillwater: {sentence}", flush=True)
    windows = bpy.context.window_manager.windows
    if not bpy.app.background and windows:
        with bpy.context.temp_override(window=windows[0]):
            bpy.context.window_manager.popup_menu(
                lambda menu, _: menu.layout.label(text=sentence), title="Stillwater", icon="ERROR"
            )


def register():
    _in_main_thread.set(True)
    if not bpy.app.background:
        bpy.app.timers.register(attend, persistent=True)


def unregister():
    _wishes.clear()
    if bpy.app.timers.is_registered(attend):
        bpy.app.timers.unregister(attend)
