"""From an empty Blender to a picture whose clouds drift, by mouse and keys alone."""

from pathlib import Path

import bpy
import paintings

FOLDER = Path(bpy.app.tempdir)
FIELD = 80  # px from the middle of a label to its field


def picture():
    return bpy.context.scene.stillwater.active()


def right_end(sidebar) -> int:
    """Where a row of the sidebar has its last icon."""
    return sidebar.x + sidebar.width - 42


def test_the_sidebar_has_a_stillwater_tab(window):
    yield from window.key("N", at=window.box("VIEW_3D").middle)
    yield from window.click("Stillwater", inside=window.box("VIEW_3D", "UI"), turned=True)
    yield from window.see("New Picture")
    yield from window.screenshot("01-sidebar")


def test_a_new_picture_has_a_background(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.click("New Picture", sidebar)
    yield from window.see("Background", sidebar)
    yield from window.screenshot("02-new-picture")


def test_the_picture_s_path_is_typed(window):
    file, _ = paintings.clouds(FOLDER)
    yield from window.fill("Picture:", str(file), window.box("VIEW_3D", "UI"), beside=FIELD)
    assert Path(bpy.path.abspath(picture().picture)) == file
    yield from window.screenshot("03-path")


def test_a_layer_is_added_before_the_background(window):
    sidebar = window.box("VIEW_3D", "UI")
    layers = yield from window.see("Layers", sidebar)
    yield from window.click_button("bpy.ops.stillwater.layer(action='add'", near=(right_end(sidebar), layers[1]))
    yield from window.fill("Layer", "Clouds", sidebar, ctrl=True)
    assert [layer.name for layer in picture().layers] == ["Clouds", "Background"]
    yield from window.see("Clouds", sidebar)
    yield from window.screenshot("04-layer")


def test_a_bake_that_lacks_something_says_what(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.click("Bake", sidebar, lowest=True)
    yield from window.until(lambda: picture().tree.stillwater.state == "failed", 30, "no answer from the worker")
    yield from window.screenshot("05-refused")


def test_the_layer_gets_a_matte_and_a_motion(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.choose("Matte", "File", sidebar, beside=FIELD)
    yield from window.fill("File", str(FOLDER / "matte.png"), sidebar, beside=FIELD, lowest=True)
    yield from window.screenshot("06-matte")
    yield from window.choose("Motion", "Drift", sidebar, beside=FIELD)
    yield from window.screenshot("07-motion")
    layer = picture().layers[0]
    assert layer.matte.form == "file" and Path(layer.matte.file).name == "matte.png"
    assert layer.motion.type == "drift"


def test_the_bake_runs_beside_blender_and_tells_how_far_it_is(window):
    sidebar = window.box("VIEW_3D", "UI")
    yield from window.click("Bake", sidebar, lowest=True)
    state = picture().tree.stillwater
    yield from window.until(lambda: state.share > 0.1, 60, lambda: f"{state.state}: {state.message}")
    yield from window.screenshot("08-baking")
    assert state.state == "running"


def test_the_cross_cancels_it_and_keeps_what_is_done(window):
    sidebar = window.box("VIEW_3D", "UI")
    bake = yield from window.see("Bake", sidebar)
    yield from window.click_button("bpy.ops.stillwater.cancel(", near=(right_end(sidebar), bake[1]))
    state = picture().tree.stillwater
    yield from window.until(lambda: state.state != "running", 10, "it goes on")
    assert state.state == "cancelled", state.state
    assert len(list(Path(bpy.path.abspath(state.folder)).glob("*.exr"))) > 20
    yield from window.screenshot("09-cancelled")


def test_fewer_frames_are_baked(window):
    yield from window.fill("End", "24", window.box("DOPESHEET_EDITOR", "HEADER"))
    yield from window.click("Bake", window.box("VIEW_3D", "UI"), lowest=True)
    state = picture().tree.stillwater
    yield from window.until(lambda: state.state == "done", 60, lambda: f"{state.state}: {state.message}")
    yield from window.screenshot("10-baked")


def test_the_compositor_gets_the_node_from_its_add_menu(window):
    yield from window.click("Compositing")
    yield from window.until(lambda: screen().name == "Compositing", 10, "no compositor")
    yield from window.click("Add", window.box("NODE_EDITOR", "HEADER"))
    yield from window.screenshot("11-add")
    yield from window.click("Stillwater", lowest=True)
    yield from window.key("HOME", at=window.box("NODE_EDITOR").middle)
    node = bpy.context.scene.compositing_node_group.nodes.active
    assert node.node_tree == picture().tree
    yield from window.screenshot("12-node")


def screen():
    return bpy.context.window_manager.windows[0].screen
