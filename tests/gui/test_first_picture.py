"""A new user's first minutes: from an empty Blender to a tree that sways in the compositor, by mouse and keys alone."""

import json
from pathlib import Path

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector
from window import Box

SAMPLE = Path(__file__).resolve().parents[2] / "blend_samples" / "tree"
SWAY_LINE = [(808, 600), (809, 75)]  # root and tip in the sample's picture, px
FIELD = 80  # px from the middle of a label to its field


def picture():
    return bpy.context.scene.stillwater.active()


def state():
    """How the bake is doing."""
    return picture().tree.stillwater


def on_screen(window, x: float, y: float) -> tuple[int, int]:
    """Where a place of the picture (px from its upper left corner) is seen in the viewport."""
    (width, height), plane = picture().picture_size, picture().plane
    side = plane.empty_display_size / max(width, height)
    place = plane.matrix_world @ Vector(((x - width / 2) * side, (height / 2 - y) * side, 0))
    area, box = window.area("VIEW_3D"), window.box("VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    seen = location_3d_to_region_2d(region, area.spaces.active.region_3d, place)
    return round(box.x + seen.x), round(box.y + seen.y)


def right_end(sidebar) -> int:
    """Where a row of the sidebar has its last icon."""
    return sidebar.x + sidebar.width - 42


def test_the_sidebar_has_a_stillwater_tab(window):
    yield from window.key("N", at=window.box("VIEW_3D").middle)
    yield from window.click("Stillwater", inside=window.box("VIEW_3D", "UI"), turned=True)
    yield from window.see("Open Picture")
    yield from window.screenshot("01-sidebar")


def test_a_picture_is_opened_and_seen_as_it_is(window):
    yield from window.click("Open Picture")
    yield from window.until(lambda: window.has("FILE_BROWSER"), 10, "no file browser")
    yield from window.open_file(SAMPLE / "picture.png", "Open Picture")
    yield from window.until(lambda: picture() is not None, 20, "no picture")
    yield from window.screenshot("02-opened")
    pixels = np.array(picture().image.pixels).reshape(800, 1280, 4)[::-1, :, :3] * 255
    for x, y in ((100, 100), (640, 60), (500, 430), (300, 700)):
        column, row = on_screen(window, x + 0.5, y + 0.5)
        seen = window.pixels(Box(column - 2, row - 2, 5, 5)).mean((0, 1))
        assert np.abs(seen - pixels[y - 3 : y + 4, x - 3 : x + 4].mean((0, 1))).max() < 8, (x, y, seen, pixels[y, x])


def test_a_tree_is_added_from_the_presets(window):
    sidebar = window.box("VIEW_3D", "UI")
    row = yield from window.see("Background", sidebar)
    yield from window.click((right_end(sidebar), row[1]))
    yield from window.see("Tree in a Storm")
    yield from window.screenshot("03-presets")
    yield from window.click("Tree")
    yield from window.until(lambda: len(picture().layers) == 2, 10, "no layer")
    assert picture().layers[0].motion.type == "sway"
    yield from window.screenshot("04-layer")


def test_its_matte_is_typed(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.choose("Matte", "File", sidebar, beside=FIELD)
    yield from window.fill("File", str(SAMPLE / "mattes" / "tree.png"), sidebar, beside=FIELD, lowest=True)
    assert picture().layers[0].matte.file.endswith("tree.png")
    yield from window.screenshot("05-matte")


def test_its_sway_line_is_drawn_with_the_mouse(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.scroll_to("Wind", sidebar)
    yield from window.click("Sway Line", sidebar, lowest=True)
    yield from window.until(lambda: bpy.context.mode == "PAINT_GREASE_PENCIL", 10, "no draw mode")
    yield from window.screenshot("06-draw-mode")
    yield from window.drag([on_screen(window, *place) for place in SWAY_LINE])
    yield from window.screenshot("07-drawn")
    assert not window.places("Draw its sway line, from where", sidebar)
    yield from window.click("Done", lowest=True)
    yield from window.until(lambda: bpy.context.mode == "OBJECT", 10, "still in draw mode")


def test_the_bake_runs_beside_blender_and_tells_how_far_it_is(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.scroll_to("Output", sidebar)
    yield from window.click("Bake", sidebar, lowest=True)
    yield from window.until(lambda: state().share > 0.05, 60, lambda: f"{state().state}: {state().message}")
    yield from window.screenshot("08-baking")
    assert state().state == "running"
    recipe = json.loads((Path(bpy.path.abspath(state().folder)).parent / "recipe.json").read_text())
    drawn = np.array(recipe["layers"][0]["motion"]["armature"])
    assert np.abs(drawn - SWAY_LINE).max() < 2, drawn


def test_the_cross_cancels_it_and_keeps_what_is_done(window):
    sidebar = window.box("VIEW_3D", "UI")
    bake = yield from window.see("Bake", sidebar)
    yield from window.click_button("bpy.ops.stillwater.cancel(", near=(right_end(sidebar), bake[1]))
    yield from window.until(lambda: state().state != "running", 10, "it goes on")
    assert state().state == "cancelled", state().state
    assert list(Path(bpy.path.abspath(state().folder)).glob("*.exr"))
    yield from window.screenshot("09-cancelled")


def test_fewer_frames_are_baked(window):
    yield from window.fill("End", "24", window.box("DOPESHEET_EDITOR", "HEADER"))
    yield from window.click("Bake", window.box("VIEW_3D", "UI"), lowest=True)
    yield from window.until(lambda: state().state == "done", 60, lambda: f"{state().state}: {state().message}")
    yield from window.screenshot("10-baked")


def test_the_compositor_shows_the_node_and_its_picture(window):
    yield from window.click("Compositing")
    yield from window.until(lambda: window.has("NODE_EDITOR"), 10, "no compositor")
    groups = [node.node_tree for node in bpy.context.scene.compositing_node_group.nodes if node.type == "GROUP"]
    assert groups == [picture().tree]
    viewer = window.box("IMAGE_EDITOR")
    middle = Box(viewer.middle[0] - 100, viewer.middle[1] - 50, 200, 100)
    colourful = lambda: np.ptp(window.pixels(middle), 2).mean() > 20  # noqa: E731  an empty viewer is grey
    yield from window.until(colourful, 30, "the viewer shows no picture")
    yield from window.key("HOME", at=viewer.middle)
    yield from window.key("HOME", at=window.box("NODE_EDITOR").middle)
    yield from window.screenshot("11-compositor")
