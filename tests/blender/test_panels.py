"""Panels show what there is, in both editors, and change nothing."""

from types import SimpleNamespace

import bpy
import pytest
from panels import Recorder, draw, registered


@pytest.fixture
def panel(extension):
    """Draws all panels of one editor and returns what they show."""

    def show(editor="view_3d"):
        shown = [draw(cls) for cls in registered(editor) if not hasattr(cls, "poll") or cls.poll(bpy.context)]
        kinds = ("texts", "properties", "operators")
        return {kind: [entry for part in shown for entry in getattr(part, kind)] for kind in kinds}

    return show


@pytest.mark.parametrize("editor", ["view_3d", "node_editor"])
def test_an_empty_scene_offers_a_picture(scene, panel, editor):
    shown = panel(editor)
    assert shown["operators"] == ["stillwater.add_picture", "stillwater.load_recipe"]
    assert shown["texts"][0].startswith("Engine ")


@pytest.mark.parametrize("tree, shown", [("CompositorNodeTree", True), ("ShaderNodeTree", False)])
def test_only_the_compositor_s_node_editor_shows_it(extension, scene, picture, tree, shown):
    editor = SimpleNamespace(scene=scene, space_data=SimpleNamespace(tree_type=tree))
    assert {cls.poll(editor) for cls in registered("node_editor")} == {shown}


def test_panels_stand_in_the_order_of_the_work(scene):
    labels = [cls.bl_label for cls in registered("view_3d")]
    assert labels == ["Stillwater", "Layers", "Wind", "View", "Live", "Bake", "Output"]


@pytest.mark.parametrize("motion", ["still", "sway", "ripple", "bob", "drift"])
def test_every_number_of_a_motion_is_shown(scene, picture, panel, motion):
    picture.layers[0].motion.type = motion
    shown = panel()["properties"]
    row = Recorder()
    bpy.types.STILLWATER_UL_layers.draw_item(None, bpy.context, row, picture, picture.layers[0], 0, picture, "", 0)
    assert row.properties == ["name", "visible"]
    group = getattr(picture.layers[0].motion, motion, None)
    wanted = [] if group is None else [n for n in type(group).__annotations__ if n not in ("waterline", "water_id")]
    assert set(wanted) <= set(shown) and "speed" in shown and "fov" in shown and "compression" in shown


FORMS = {"none": set(), "file": {"file", "channel"}, "labels": {"labels", "value"}}


@pytest.mark.parametrize("form, names", FORMS.items())
def test_a_matte_shows_what_its_form_needs(picture, panel, form, names):
    picture.layers[0].matte.form = form
    shown = set(panel()["properties"]) & {"file", "channel", "labels", "value"}
    assert shown == names


def test_the_bake_is_shown(extension, scene, picture, panel):
    assert "stillwater.bake" in panel()["operators"]
    state = extension.compositor.tree.ensure(scene, picture).stillwater
    state.state, state.message, state.share = "running", "Frame 7, 3 of 4", 0.75
    shown = panel()
    assert "Frame 7, 3 of 4" in shown["texts"]
    assert "stillwater.cancel" in shown["operators"] and "stillwater.bake" not in shown["operators"]


def test_a_long_sentence_is_broken_into_lines(extension, scene, picture, panel):
    state = extension.compositor.tree.ensure(scene, picture).stillwater
    sentence = "layers[0].motion.frequency: 0 is not above 0 (Hz), and this goes on for longer than a panel is wide"
    state.state, state.message = "failed", sentence
    state.warning = "first warning\nsecond warning"
    shown = panel()["texts"]
    assert sentence in " ".join(shown) and max(map(len, shown)) <= 31
    assert "first warning" in shown and "second warning" in shown


def test_the_list_of_layers_is_changed_by_its_buttons(scene, picture):
    for action, names in [
        ("add", ["Layer", "all"]),
        ("down", ["all", "Layer"]),
        ("down", ["all", "Layer"]),
        ("up", ["Layer", "all"]),
        ("remove", ["all"]),
        ("remove", []),
        ("remove", []),
        ("add", ["Background"]),
    ]:
        bpy.ops.stillwater.layer(action=action)
        assert [layer.name for layer in picture.layers] == names, action
        assert picture.active_layer == 0 or picture.active_layer < len(names)


def test_a_new_picture_has_a_background(scene):
    bpy.ops.stillwater.add_picture()
    assert [layer.name for layer in scene.stillwater.active().layers] == ["Background"]
    bpy.ops.stillwater.remove_picture()
    assert scene.stillwater.active() is None and not bpy.ops.stillwater.remove_picture.poll()
