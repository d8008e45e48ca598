"""What Blender's menus hold of ours."""

from types import SimpleNamespace

import bpy
from panels import Recorder


class MenuRecorder(Recorder):
    def __init__(self):
        super().__init__()
        self.menus = []

    def menu(self, name, **_):
        assert hasattr(bpy.types, name)
        self.menus.append(name)


def _drawn(name: str) -> MenuRecorder:
    menu, recorder = getattr(bpy.types, name), MenuRecorder()
    ours = [draw for draw in getattr(menu.draw, "_draw_funcs", [menu.draw]) if "stillwater" in draw.__module__]
    for draw in ours:
        draw(SimpleNamespace(layout=recorder), bpy.context)
    return recorder


def operators(name: str) -> list[str]:
    return _drawn(name).operators


def submenus(name: str) -> list[str]:
    return _drawn(name).menus
