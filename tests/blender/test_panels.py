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
    assert shown["texts"] == []


@pytest.mark.parametrize("tree, shown", [("CompositorNodeTree", True), ("ShaderNodeTree", False)])
def test_only_the_compositor_s_node_editor_shows_it(extension, scene, picture, tree, shown):
    editor = SimpleNamespace(scene=scene, space_data=SimpleNamespace(tree_type=tree))
    assert {cls.poll(editor) for cls in registered("node_editor")} == {shown}


def test_panels_stand_in_the_order_of_the_work(scene):
    labels = [cls.bl_label for cls in registered("view_3d")]
    assert labels == ["Stillwater", "Picture", "Layers", "Strokes", "Layer", "Wind", "View", "Live", "Bake", "Output"]


@pytest.mark.parametrize("motion", ["still", "sway", "ripple", "bob", "drift", "flow"])
def test_every_number_of_a_motion_is_shown(scene, picture, panel, motion):
    layer = picture.layers[0]
    layer.motion.type, layer.motion.ripple.spectrum = motion, "tma"
    layer.motion.bob.waterline.add()
    shown = panel()["properties"]
    layer.motion.drift.use_velocity = True
    shown += panel()["properties"]
    group = layer.motion.numbers()
    hidden = {"waterline", "water_id", "outline_moving", "outline_persistence"}  # a moving outline has no engine yet
    wanted = [] if group is None else [n for n in type(group).__annotations__ if n not in hidden]
    assert set(wanted) <= set(shown) and "speed" in shown and "fov" in shown and "compression" in shown
    assert ("place" in shown) == (motion == "bob")


@pytest.mark.parametrize("spectrum, names", [("phillips", []), ("jonswap", ["fetch"]), ("tma", ["fetch", "depth"])])
def test_only_what_a_spectrum_needs_is_shown(picture, panel, spectrum, names):
    picture.layers[0].motion.type, picture.layers[0].motion.ripple.spectrum = "ripple", spectrum
    assert [name for name in panel()["properties"] if name in ("fetch", "depth")] == names + ["depth"]  # the output's


def row(picture, index: int) -> Recorder:
    drawn = Recorder()
    layer = picture.layers[index]
    bpy.types.STILLWATER_UL_layers.draw_item(None, bpy.context, drawn, picture, layer, 0, picture, "", index)
    return drawn


def test_a_row_of_the_list_warns_where_something_is_missing(extension, picture):
    extension.properties.arrange.add_layer(picture, "sky")
    assert row(picture, 0).properties == row(picture, 1).properties == ["selected", "name", "solo", "visible"]
    assert (row(picture, 0).texts, row(picture, 1).texts) == ([""], [])


def test_units_are_told_where_blender_shows_none_and_they_fit(picture, extension):
    label, kinds = extension.ui.sidebar.label, lambda group: group.bl_rna.properties
    wind, view, layer = picture.wind, picture.view, picture.layers[0]
    motion = layer.motion
    said = [label(kinds(wind)[name]) for name in ("speed", "direction", "gusts", "gust_size")]
    assert said == ["Speed (m/s)", "Direction", "Gusts", "Gust Size"]
    assert (label(kinds(view)["fov"]), label(kinds(view)["height"])) == ("Field of View", "Eye Height")
    assert [label(kinds(motion.sway)[name]) for name in ("frequency", "damping")] == ["Frequency", "Damping (1/s)"]
    assert label(kinds(motion.drift)["velocity"]) == "Velocity"
    assert label(kinds(layer)["feather"]) == "Feather"
    assert label(kinds(motion.sway)["armature_root"]) == "Root" and label(kinds(motion.ripple)["mode"]) == "Mode"


FORMS = {"none": set(), "file": {"file", "channel"}, "labels": {"labels", "value"}}


@pytest.mark.parametrize("form, names", FORMS.items())
def test_a_matte_shows_what_its_form_needs(picture, panel, form, names):
    picture.layers[0].matte.form = form
    shown = set(panel()["properties"]) & {"file", "channel", "labels", "value"}
    assert shown == names


@pytest.mark.parametrize("path, name", [("/a/b/tree.png", "tree.png"), ("C:\\a\\tree.png", "tree.png"),
                                        ("//tree.png", "tree.png"), ("tree.png", ""), ("", "")])  # fmt: skip
def test_the_name_of_a_file_is_to_be_read(extension, picture, panel, path, name):
    layer = picture.layers[0]
    layer.matte.form, layer.matte.file = "file", path
    assert extension.ui.sidebar.file_of(path) == name and (not name or name in panel()["texts"])


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


def test_several_selected_layers_are_told_and_changed_together(extension, picture, panel):
    extension.properties.arrange.add_layer(picture, "sky")
    alone = panel()
    assert "2 layers are selected" not in alone["texts"] and "stillwater.copy_to_selected" not in alone["operators"]
    picture.layers[1].selected = True
    several = panel()
    assert "2 layers are selected" in several["texts"]
    assert {"stillwater.show_layers", "stillwater.copy_to_selected"} <= set(several["operators"])


def test_no_layer_is_a_sentence_that_says_what_to_do(picture, panel):
    picture.layers.clear()
    assert "Add a layer for each part of the picture that moves" in " ".join(panel()["texts"])


def menu(name: str) -> Recorder:
    drawn = Recorder()
    getattr(bpy.types, name).draw(SimpleNamespace(layout=drawn), bpy.context)
    return drawn


def test_the_menu_of_new_layers_offers_each_motion_s_presets(picture):
    offered = menu("STILLWATER_MT_add_layer")
    assert offered.texts[0] == "Still"
    assert {"Still Tree", "Tree in a Storm", "Pond", "Lake", "Sea", "Boat", "Ship", "Clouds"} <= set(offered.texts)
    assert set(offered.operators) == {"stillwater.add_layer"}


def test_the_menu_of_layers_holds_what_has_no_button(picture):
    wanted = {"duplicate_layer", "copy_layers", "paste_layers", "move_layer", "select_layers", "show_layers"}
    wanted |= {"copy_to_selected", "layers_from_mask", "layers_from_pass"}
    drawn = menu("STILLWATER_MT_layers")
    assert {f"stillwater.{name}" for name in wanted} == set(drawn.operators)
    assert menu("STILLWATER_MT_motion").texts == ["Still", "Sway", "Ripple", "Bob", "Drift", "Flow", "Example"]


@pytest.mark.parametrize("panel_name, names", [("STILLWATER_PT_motion_presets", ["Lake", "Pond", "Sea"]),
                                               ("STILLWATER_PT_wind_presets", ["Breeze", "Calm", "Storm", "Wind"])])
def test_presets_drop_down_with_a_line_to_save_one(picture, panel_name, names):
    picture.layers[0].motion.type = "ripple"
    cls = getattr(bpy.types, panel_name)
    shown = Recorder()
    part = SimpleNamespace(layout=shown, draw_kind=lambda *args: cls.draw_kind(SimpleNamespace(layout=shown), *args))
    cls.draw(part, bpy.context)
    assert [text for text in shown.texts if text] == names and shown.properties == ["preset_name"]
    assert shown.operators == ["stillwater.apply_preset"] * len(names) + ["stillwater.save_preset"]


def test_a_right_click_on_a_layer_s_value_copies_it(extension, scene, picture):
    extension.properties.arrange.add_layer(picture, "sky")
    layer = picture.layers[1]

    def offered(pointer, name):
        drawn = Recorder()
        context = SimpleNamespace(scene=scene, button_pointer=pointer, button_prop=pointer.bl_rna.properties[name])
        extension.layers.menus.draw_context_menu(SimpleNamespace(layout=drawn), context)
        return [(one.path, one.layer) for one in drawn.made]

    assert offered(layer.motion.sway, "amount") == [("motion.sway.amount", 1)]
    assert offered(layer, "opacity") == [("opacity", 1)] and offered(layer.motion, "type") == [("motion.type", 1)]
    assert offered(layer, "name") == offered(picture.wind, "speed") == offered(scene.render, "fps") == []
    drawn = Recorder()
    extension.layers.menus.draw_context_menu(SimpleNamespace(layout=drawn), SimpleNamespace(scene=scene))
    assert drawn.operators == []


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


def test_each_number_of_a_picture_has_one_place(opened, panel):
    shown = panel()["properties"]
    assert [shown.count(name) for name in ("colour_space", "seed", "loop", "compression")] == [1, 2, 1, 1]  # the wind's seed


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
