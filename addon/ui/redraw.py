"""Draws anew what shows values that no person changed: Blender draws panels by itself only after a click."""

import bpy

from .sidebar import EDITORS


def panels() -> None:
    """The sidebars that have our tab."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions if area.type in EDITORS else ():
                if region.type == "UI":
                    region.tag_redraw()


def status_bars() -> None:
    """Taking the status text away is the one way to have them drawn; a tool at work may have set one, and keeps it."""
    for window in bpy.context.window_manager.windows:
        if not window.modal_operators:
            with bpy.context.temp_override(window=window):
                window.workspace.status_text_set(None)
