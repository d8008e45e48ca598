"""From the scene to frames on disk: start with job.py."""

import bpy
from bpy.app.handlers import persistent

from . import job, leftovers, operators, panel

CLASSES = [*operators.CLASSES, *leftovers.CLASSES, *panel.CLASSES]


@persistent
def _another_file(*_):
    job.end_all()


@persistent
def _settle(*_):
    job.settle()


HANDLERS = [("load_pre", _another_file), ("load_post", _settle), ("undo_post", _settle), ("redo_post", _settle)]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for name, handler in HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    job.end_all()
    for name, handler in reversed(HANDLERS):
        getattr(bpy.app.handlers, name).remove(handler)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
