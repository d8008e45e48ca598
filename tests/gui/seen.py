"""The active picture, and where its parts are on the screen."""

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector
from window import Box

TABS = 30  # px, beside the panels of a sidebar
FIELD = 80  # px from the middle of a label to its field


def picture():
    return bpy.context.scene.stillwater.active()


def state():
    """How the bake is doing."""
    return picture().tree.stillwater


def is_live() -> bool:
    return picture().plane.data != picture().image


def on_screen(window, x: float, y: float) -> tuple[int, int]:
    """Where a place of the picture (px from its upper left corner) is seen in the viewport."""
    (width, height), plane = picture().picture_size, picture().plane
    side = plane.empty_display_size / max(width, height)
    place = plane.matrix_world @ Vector(((x - width / 2) * side, (height / 2 - y) * side, 0))
    area, box = window.area("VIEW_3D"), window.box("VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    seen = location_3d_to_region_2d(region, area.spaces.active.region_3d, place)
    return round(box.x + seen.x), round(box.y + seen.y)


def part(window, corners) -> Box:
    """Where a part of the picture (left, top, right, bottom) is on the screen."""
    left, top = on_screen(window, *corners[:2])
    right, bottom = on_screen(window, *corners[2:])
    return Box(left, bottom, right - left, top - bottom)


def right_end(sidebar) -> int:
    """Where a row of the sidebar has its last icon."""
    return sidebar.x + sidebar.width - 42


def open_sidebar(window):
    """With its Stillwater tab."""
    yield from window.key("N", at=window.box("VIEW_3D").middle)
    yield from window.click("Stillwater", inside=window.box("VIEW_3D", "UI"), turned=True)
    yield from window.see("Open Picture")


def open_overlays(window):
    """Blender's popover with the switches of what is drawn over a viewport."""
    yield from window.settle()
    header = window.box("VIEW_3D", "HEADER")
    along = [(x, header.middle[1]) for x in range(header.x + header.width - 10, header.middle[0], -10)]
    switch = yield from window.point_at("overlay.show_overlays", along)
    yield from window.click((switch[0] + 18, switch[1]))


def switch_off_and_on(window, name: str, box: Box, least: int):
    """One switch of the open popover: at least so many pixels of a box differ without, none with it again."""
    words = yield from window.see(name)
    before = window.pixels(box)
    without = lambda: (window.pixels(box) != before).any(2).sum()  # noqa: E731
    yield from window.click(words)
    yield from window.until(lambda: without() > least, 20, lambda: f"{without()} pixels differ without {name}")
    yield from window.click(words)
    yield from window.until(lambda: without() == 0, 20, lambda: f"{without()} pixels differ with {name} again")


def changes(window, box: Box, before: np.ndarray) -> float:
    """By how much a box differs from what it was, on average, 0..255."""
    return float(np.abs(window.pixels(box) - before.astype(float)).mean())
