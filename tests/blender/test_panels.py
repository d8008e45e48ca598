"""Panels show what there is, in both editors, and change nothing."""

from types import SimpleNamespace

import bpy
import pytest
from panels import Recorder, draw, registered
from pictures import HEIGHT, WIDTH, paint


@pytest.fixture
def panel(extension):
    """Draws all panels of one editor and returns what they show."""

    def show(editor="view_3d"):
        shown = [draw(cls) for cls in registered(editor) if not hasattr(cls, "poll") or cls.poll(bpy.context)]
        kinds = ("texts", "properties", "operators", "lists")
        return {kind: [entry for part in shown for entry in getattr(part, kind)] for kind in kinds}

    return show


@pytest.mark.parametrize("editor", ["view_3d", "node_editor"])
def test_an_empty_scene_offers_a_picture(scene, panel, editor):
    shown = panel(editor)
    assert shown["operators"] == ["stillwater.open_picture", "stillwater.load_recipe"]
    assert shown["texts"][0].startswith("Engine ")


@pytest.mark.parametrize("tree, shown", [("CompositorNodeTree", True), ("ShaderNodeTree", False)])
def test_only_the_compositor_s_node_editor_shows_it(extension, scene, picture, tree, shown):
    editor = SimpleNamespace(scene=scene, space_data=SimpleNamespace(tree_type=tree))
    assert {cls.poll(editor) for cls in registered("node_editor")} == {shown}


def test_panels_stand_in_the_order_of_the_work(scene):
    labels = [cls.bl_label for cls in registered("view_3d")]
    assert labels == ["Stillwater", "Picture", "Layers", "Wind", "View", "Bake", "Output"]


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


@pytest.fixture
def opened(scene, tmp_path):
    scene.view_settings.view_transform = "AgX"
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "lake.png")))
    return scene.stillwater.active()


def test_the_picture_is_shown(opened, panel):
    shown = panel()
    assert f"lake.png, {WIDTH} x {HEIGHT} px" in shown["texts"]
    assert {f"stillwater.{verb}_picture" for verb in ("replace", "reload", "remove")} <= set(shown["operators"])
    assert "stillwater.show_picture" not in shown["operators"] and "colour_space" in shown["properties"]


def test_a_missing_picture_is_shown_with_what_to_do(opened, panel):
    opened.missing = True
    shown = panel()
    assert "is not there" in " ".join(shown["texts"]) and shown["operators"].count("stillwater.replace_picture") == 2


def test_the_view_transform_is_shown_with_a_way_back(scene, opened, panel):
    assert "View transform Standard: renders equal the picture" in " ".join(panel()["texts"])
    assert "stillwater.former_view" in panel()["operators"]
    bpy.ops.stillwater.former_view()
    assert "View transform AgX: renders differ from the picture's own colors" in " ".join(panel()["texts"])
    assert "stillwater.standard_view" in panel()["operators"]


def test_what_was_deleted_is_offered_again(scene, opened, panel):
    bpy.data.objects.remove(opened.camera)
    assert "stillwater.show_picture" in panel()["operators"]


def test_a_second_picture_makes_a_list(scene, opened, panel, tmp_path):
    assert "active_picture" not in panel()["lists"]
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "pond.png")))
    assert "active_picture" in panel()["lists"]
    scene.stillwater.active_picture = 0
    assert "stillwater.show_picture" in panel()["operators"]  # the camera looks at the second
