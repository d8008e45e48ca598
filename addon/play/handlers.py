"""When live pictures are shown anew: at another frame, when a number changes, after undo, in another file."""

import bpy
from bpy.app.handlers import persistent

from ..strokes import draw_mode
from . import plane, recipes, server, show

LIFTED = 0.02  # s, between two looks at whether the pen was lifted

_rendering = False
_stale = True  # something changed since the recipes were last looked at


@persistent
def frame_changed(scene, depsgraph=None):
    """While Blender plays, recipes are looked at only where something changed; any other frame looks anew."""
    global _stale
    if _busy(depsgraph) or not scene.stillwater.pictures:
        return
    refresh = _stale or not _playing()
    if refresh and not _playing():
        recipes.forget_curves()
    _stale = False
    show.scene(scene, refresh)


@persistent
def something_changed(scene, depsgraph=None):
    """A slider, a key, a stroke. While Blender plays, the next frame shows it."""
    global _stale
    if _busy(depsgraph) or depsgraph is None:
        return
    show.tidy()
    if not scene.stillwater.pictures:
        return
    changed = [update.id.original for update in depsgraph.updates]
    if not any(_matters(scene, datablock) for datablock in changed):
        return
    if any(isinstance(datablock, bpy.types.Action) for datablock in changed):
        recipes.forget_curves()
    _stale = True
    if draw_mode.pen_is_down():
        if not bpy.app.timers.is_registered(pen_lifted):
            bpy.app.timers.register(pen_lifted, first_interval=LIFTED)
    elif not _playing():
        _stale = False
        show.scene(scene)


def pen_lifted() -> float | None:
    """Once a stroke is whole, what it says is shown; called by a timer."""
    global _stale
    if draw_mode.pen_is_down():
        return LIFTED
    if not _playing() and not _rendering and _stale:
        _stale = False
        for window in bpy.context.window_manager.windows:
            show.scene(window.scene)
    return None


@persistent
def another_state(*_):
    """Undo, redo, or a file just opened or saved: planes and images may be others now."""
    recipes.forget()
    show.tidy()
    show.put_back()
    for window in bpy.context.window_manager.windows:
        show.scene(window.scene)


@persistent
def another_file(*_):
    server.end()
    show.forget()


@persistent
def planes_at_rest(*_):
    """Before saving; and before a step is undone: Blender frees a live image that no undo step holds, but keeps a plane
    that is the same in both steps, with what it points at."""
    show.put_back()


@persistent
def render_begins(*_):
    global _rendering
    _rendering = True


@persistent
def render_ends(*_):
    global _rendering
    _rendering = False


def _matters(scene, datablock) -> bool:
    """Whether a recipe may be another one for it."""
    if isinstance(datablock, bpy.types.Scene | bpy.types.Action):
        return True
    pictures = scene.stillwater.pictures
    items = [item for picture in pictures for item in (picture.plane, picture.strokes) if item is not None]
    return datablock in items or datablock in [item.data for item in items]


def _busy(depsgraph) -> bool:
    """Frames of a render are not shown; its handlers run in a thread of its own."""
    return _rendering or (depsgraph is not None and depsgraph.mode == "RENDER")


def _playing() -> bool:
    return any(window.screen.is_animation_playing for window in bpy.context.window_manager.windows)


HANDLERS = [
    ("frame_change_post", frame_changed),
    ("depsgraph_update_post", something_changed),
    ("undo_pre", planes_at_rest),
    ("redo_pre", planes_at_rest),
    ("undo_post", another_state),
    ("redo_post", another_state),
    ("load_pre", another_file),
    ("load_post", another_state),
    ("save_pre", planes_at_rest),
    ("save_post", another_state),
    ("render_init", render_begins),
    ("render_complete", render_ends),
    ("render_cancel", render_ends),
]


def register():
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    for name, handler in reversed(HANDLERS):
        getattr(bpy.app.handlers, name).remove(handler)
    show.put_back()
    for timer in (plane.rest, pen_lifted):
        if bpy.app.timers.is_registered(timer):
            bpy.app.timers.unregister(timer)
    server.end()
    show.forget()
