"""The sidebar's tab: its main panel, what the panels of all rooms share (sidebar.py), drawing them anew (redraw.py)."""

import bpy

from . import main

CLASSES = main.CLASSES


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
