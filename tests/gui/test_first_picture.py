"""A new user's first minutes: from an empty Blender to a tree that sways in the compositor, by mouse and keys alone."""

import json
import tempfile
from pathlib import Path

import bpy
import numpy as np
from seen import FIELD, TABS, changes, is_live, on_screen, open_overlays, open_sidebar, part, picture, right_end, state
from seen import switch_off_and_on
from window import Box

SAMPLE = Path(__file__).resolve().parents[2] / "blend_samples" / "tree"
SWAY_LINE = [(808, 600), (809, 75)]  # root and tip in the sample's picture, px
FILE = Path(tempfile.mkdtemp()) / "meadow.blend"
STEPS = 32  # that Blender can undo
CROWN, MEADOW = (560, 200, 740, 330), (150, 690, 400, 780)  # left, top, right, bottom: swaying, standing still


def bent_line(window) -> Box:
    """Where the sway line is."""
    return part(window, (700, 60, 920, 620))


def test_the_sidebar_has_a_stillwater_tab(window):
    yield from open_sidebar(window)
    yield from window.screenshot("01-sidebar")


def test_a_picture_is_opened_and_seen_as_it_is(window):
    yield from window.click("Open Picture")
    yield from window.until(lambda: window.has("FILE_BROWSER"), 10, "no file browser")
    yield from window.open_file(SAMPLE / "picture.png", "Open Picture")
    yield from window.until(lambda: picture() is not None, 20, "no picture")
    yield from window.screenshot("02-opened")
    pixels = np.array(picture().image.pixels).reshape(800, 1280, 4)[::-1, :, :3] * 255
    for x, y in ((200, 40), (640, 60), (500, 430), (300, 700)):
        column, row = on_screen(window, x + 0.5, y + 0.5)
        seen = window.pixels(Box(column - 2, row - 2, 5, 5)).mean((0, 1))
        assert np.abs(seen - pixels[y - 3 : y + 4, x - 3 : x + 4].mean((0, 1))).max() < 8, (x, y, seen, pixels[y, x])


def test_a_tree_is_added_from_the_presets(window):
    sidebar = window.box("VIEW_3D", "UI")
    row = yield from window.see("Background", sidebar)
    yield from window.click((right_end(sidebar), row[1]))
    last = yield from window.see("Clouds in a Storm")
    yield from window.screenshot("03-presets")
    yield from window.cut_out("presets", Box(sidebar.x + 8, last[1] - 20, last[0] + 92 - sidebar.x, row[1] + 40 - last[1]))
    yield from window.click("Tree")
    yield from window.until(lambda: len(picture().layers) == 2, 10, "no layer")
    assert picture().layers[0].motion.type == "sway"
    yield from window.screenshot("04-layer")


def test_its_matte_is_typed(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.scroll_to("Behind", sidebar)  # what comes after all of the matte
    yield from window.choose("Matte", "File", sidebar, beside=FIELD)
    yield from window.fill("File", str(SAMPLE / "mattes" / "tree.png"), sidebar, beside=FIELD, lowest=True)
    assert picture().layers[0].matte.file.endswith("tree.png")
    yield from window.screenshot("05-matte")


def test_its_sway_line_is_drawn_with_the_mouse(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.scroll_to("Strokes", sidebar)
    yield from window.point_at("stillwater.draw_stroke", window.places("Sway Line", sidebar))
    yield from window.press()
    yield from window.until(lambda: bpy.context.mode == "PAINT_GREASE_PENCIL", 10, "no draw mode")
    shelf = lambda: window.area("VIEW_3D").spaces.active.show_region_asset_shelf  # noqa: E731
    yield 0.5
    yield from window.until(lambda: not shelf(), 10, "brushes lie over the picture")
    yield from window.screenshot("06-draw-mode")
    yield from window.drag([on_screen(window, *place) for place in SWAY_LINE])
    yield from window.screenshot("07-drawn")
    assert not window.places("Draw its sway line, from where", sidebar)
    yield from window.click("Done", lowest=True)
    yield from window.until(lambda: bpy.context.mode == "OBJECT", 10, "still in draw mode")
    assert shelf()


def test_the_play_button_shows_it_in_motion_without_a_bake(window):
    yield from window.until(is_live, 60, "the layers are not cut out")
    yield from window.settle()
    crown, meadow = part(window, CROWN), part(window, MEADOW)
    tree, still, moved = window.pixels(crown), window.pixels(meadow), []
    yield from window.key("SPACE", at=on_screen(window, 300, 300))
    assert window.plays
    for _ in range(3):
        yield 0.3
        moved.append(changes(window, crown, tree))
        assert np.array_equal(window.pixels(meadow), still)
    yield from window.screenshot("08-playing")
    yield from window.key("SPACE")
    assert not window.plays
    assert min(moved) > 1 and len(set(moved)) > 1, moved
    assert bpy.context.scene.frame_current > 1
    assert state().state == "none" and not state().there, (state().state, state().there)


def test_a_number_that_changes_is_seen_at_once(window):
    sidebar = window.box("VIEW_3D", "UI")
    crown = part(window, CROWN)
    before = window.pixels(crown)
    yield from window.scroll_to("Amount", sidebar)
    yield from window.fill("Amount", "2", sidebar, beside=FIELD)
    assert picture().layers[0].motion.sway.amount == 2
    assert changes(window, crown, before) > 1
    yield from window.screenshot("09-stronger")


def test_overlays_are_switched_in_blender_s_popover(window):
    yield from window.settle()
    yield from window.cut_out("sway-line", window.box("VIEW_3D"), 0.6)
    yield from open_overlays(window)
    yield from window.see("Sway Lines")
    yield from window.screenshot("10-overlays")
    yield from switch_off_and_on(window, "Sway Lines", bent_line(window), least=400)
    yield from window.key("ESC")


def test_the_bake_runs_beside_blender_and_tells_how_far_it_is(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.scroll_to("To Sequencer", sidebar)
    yield from window.click("Bake", sidebar, lowest=True)
    yield from window.until(lambda: state().share > 0.05, 60, lambda: f"{state().state}: {state().message}")
    yield from window.screenshot("12-baking")
    assert state().state == "running"
    recipe = json.loads((Path(bpy.path.abspath(state().folder)).parent / "recipe.json").read_text())
    drawn = np.array(recipe["layers"][0]["motion"]["armature"])
    assert np.abs(drawn - SWAY_LINE).max() < 2, drawn


def test_the_cross_cancels_it_and_keeps_what_is_done(window):
    sidebar = window.box("VIEW_3D", "UI")
    bake = yield from window.see("Bake", sidebar)
    yield from window.click_button("stillwater.cancel(", near=(right_end(sidebar), bake[1]))
    yield from window.until(lambda: state().state != "running", 10, "it goes on")
    assert state().state == "cancelled", state().state
    assert list(Path(bpy.path.abspath(state().folder)).glob("*.exr"))
    yield from window.screenshot("13-cancelled")


def test_fewer_frames_are_baked(window):
    yield from window.fill("End", "24", window.box("DOPESHEET_EDITOR", "HEADER"))
    yield from window.click("Bake", window.box("VIEW_3D", "UI"), lowest=True)
    yield from window.until(lambda: state().state == "done", 60, lambda: f"{state().state}: {state().message}")
    yield from window.screenshot("14-baked")


def test_what_is_out_of_date_is_told_until_undo(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.scroll_to("Amount", sidebar)
    yield from window.fill("Amount", "1", sidebar, beside=FIELD)
    yield from window.scroll_to("To Sequencer", sidebar)
    label = lambda: next(n.label for n in bpy.context.scene.compositing_node_group.nodes if n.type == "GROUP")  # noqa: E731
    yield from window.until(lambda: "out of date" in label(), 20, label)
    yield from window.screenshot("15-out-of-date")
    end = yield from window.see("To Sequencer", sidebar)
    yield from window.cut_out("bake", Box(sidebar.x, end[1] - 20, sidebar.width - TABS, 205))
    yield from window.key("Z", at=window.box("VIEW_3D").middle, ctrl=True)
    yield from window.see("All 24 frames are ready", sidebar)


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
    nodes = window.box("NODE_EDITOR")
    yield from window.key("N", at=nodes.middle)  # its sidebar lies over the nodes
    yield from window.key("HOME")
    yield from window.screenshot("16-compositor")
    yield from window.cut_out("node", Box(nodes.middle[0] - 630, nodes.y + 104, 1260, 240), 0.5)


def test_the_file_is_saved_with_its_frames_beside_it(window):
    yield from window.key("S", at=window.box("NODE_EDITOR").middle, ctrl=True)
    yield from window.until(lambda: window.has("FILE_BROWSER"), 10, "no file browser")
    yield from window.screenshot("17-save")
    yield from window.save_file(FILE, "Save Blender File")
    yield from window.until(FILE.is_file, 20, "no file")
    assert Path(bpy.data.filepath) == FILE and state().folder.startswith("//stillwater"), state().folder
    assert len(list((FILE.parent / "stillwater").rglob("*.exr"))) >= 24


def is_whole():
    assert [layer.name for layer in picture().layers] == ["Tree", "Background"] and picture().plane.visible_get()
    assert bpy.context.scene.frame_end == 24 and bpy.context.mode == "OBJECT"
    assert state().there == "1-24" and state().state == "done"


def test_undo_goes_back_to_the_start_step_by_step(window):
    yield from window.click("Layout")
    yield from window.move(window.box("VIEW_3D").middle)
    steps = 0
    while picture() is not None:
        layers = len(picture().layers)
        yield from window.stroke("Z", ctrl=True)
        steps += 1
        assert steps < STEPS, "the picture never goes"
        assert picture() is None or len(picture().layers) in (layers, layers - 1)
    assert not [thing for thing in bpy.data.objects if thing.type in ("EMPTY", "GREASEPENCIL")]
    assert bpy.context.scene.view_settings.view_transform == "AgX" and bpy.context.scene.camera.name == "Camera"
    yield from window.see("Open Picture", window.box("VIEW_3D", "UI"))
    yield from window.screenshot("18-undone")


def test_redo_brings_all_of_it_again(window):
    """And the step that was undone before."""
    yield from window.move(window.box("VIEW_3D").middle)
    steps = 0
    while bpy.ops.ed.redo.poll():
        yield from window.stroke("Z", ctrl=True, shift=True)
        steps += 1
        assert steps < STEPS, "it never ends"
    is_whole()
    assert picture().layers[0].motion.sway.amount == 1
    yield from window.until(is_live, 60, "it is not live")
    yield from window.screenshot("19-redone")


def test_the_saved_file_is_opened_and_works(window):
    yield from window.key("O", at=window.box("VIEW_3D").middle, ctrl=True)
    if bpy.data.is_dirty:
        yield from window.click("Don't Save", lowest=True)
    yield from window.until(lambda: window.has("FILE_BROWSER"), 10, "no file browser")
    yield from window.open_file(FILE, "Open")
    yield from window.until(lambda: picture().layers[0].motion.sway.amount == 2, 20, "not opened")
    is_whole()
    yield from window.until(is_live, 60, "it is not live")
    yield from window.screenshot("20-opened-again")
