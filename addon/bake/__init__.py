"""From the scene to frames on disk: start with job.py."""

import bpy
from bpy.app.handlers import persistent

from . import guard, job, keeping, leftovers, operators, outdated, panel, status_bar

CLASSES = [*operators.CLASSES, *keeping.CLASSES, *leftovers.CLASSES, *panel.CLASSES]


@persistent
def _another_file(*_):
    job.end_all()
    outdated.forget()


@persistent
def _settle(*_):
    job.settle()
    outdated.touch()


@persistent
def _before_undo(*_):
    job.before_undo()


@persistent
def _render_begins(*arguments):
    guard.render_begins(*arguments)


@persistent
def _frame_begins(*arguments):
    guard.frame_begins(*arguments)


@persistent
def _render_ends(*arguments):
    guard.render_ends(*arguments)


HANDLERS = [
    ("load_pre", _another_file),
    ("load_post", _settle),
    ("undo_pre", _before_undo),
    ("redo_pre", _before_undo),
    ("undo_post", _settle),
    ("redo_post", _settle),
    ("render_init", _render_begins),
    ("render_pre", _frame_begins),
    ("render_complete", _render_ends),
    ("render_cancel", _render_ends),
]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)
    bpy.types.STATUSBAR_HT_header.append(status_bar.draw)
    job.over.append(outdated.touch)
    outdated.register()
    guard.register()


def unregister():
    guard.unregister()
    job.over.remove(outdated.touch)
    bpy.types.STATUSBAR_HT_header.remove(status_bar.draw)
    job.end_all()
    outdated.unregister()
    for name, handler in reversed(HANDLERS):
        getattr(bpy.app.handlers, name).remove(handler)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
