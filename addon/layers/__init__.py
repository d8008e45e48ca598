"""The list of layers, what each does, and the wind and view that they share.

list.py and panel.py show them; order.py, from_outline.py, from_labels.py, selection.py, clipboard.py, presets.py and waterline.py hold the operators.
"""

import bpy

from ..strokes import draw_mode
from . import clipboard, from_labels, from_outline, list, menus, order, panel, preset_files, presets, selection, waterline, wind_and_view

ROOM = [list, order, from_outline, from_labels, selection, clipboard, presets, waterline, menus, panel, wind_and_view]
CLASSES = [cls for part in ROOM for cls in part.CLASSES]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.utils.register_preset_path(str(preset_files.SHIPPED))
    bpy.types.UI_MT_button_context_menu.append(menus.draw_context_menu)
    draw_mode.finished.append(from_outline.place)


def unregister():
    draw_mode.finished.remove(from_outline.place)
    bpy.types.UI_MT_button_context_menu.remove(menus.draw_context_menu)
    bpy.utils.unregister_preset_path(str(preset_files.SHIPPED))
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
