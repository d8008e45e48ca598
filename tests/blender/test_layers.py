"""Layers come, go, change places and are edited together; every step can be undone and redone."""

import importlib

import bpy
import pytest
from layered import drive, fill, key, keyed, now, order, over_time, said, select, selected
from pixels import PACKAGE

LAYERS = "stillwater.pictures[0].layers"
reordered = importlib.import_module(f"{PACKAGE}.layers.order").reordered


@pytest.fixture
def layers(extension, scene, picture):
    fill(extension, picture, "a", "b", "c", "d")
    return picture


def step(operator: str, **options) -> None:
    """One step, undone and done again."""
    bpy.ops.ed.undo_push(message="before")
    before = order(), selected()
    getattr(bpy.ops.stillwater, operator)("EXEC_DEFAULT", True, **options)
    after = order(), selected()
    bpy.ops.ed.undo()
    assert (order(), selected()) == before
    bpy.ops.ed.redo()
    assert (order(), selected()) == after


@pytest.mark.parametrize(
    "chosen, direction, expected",
    [
        ("b", "UP", "b a c d"),
        ("b", "DOWN", "a c b d"),
        ("c", "TOP", "c a b d"),
        ("b", "BOTTOM", "a c d b"),
        ("b c", "UP", "b c a d"),
        ("b c", "DOWN", "a d b c"),
        ("b d", "TOP", "b d a c"),
        ("c a", "BOTTOM", "b d a c"),
        ("a c", "UP", "a c b d"),
        ("d b", "DOWN", "a c b d"),
    ],
)
def test_selected_layers_move_together(layers, chosen, direction, expected):
    select(*chosen.split())
    step("move_layer", direction=direction)
    assert order() == expected
    assert set(selected().split()) == set(chosen.split())
    assert now().layers[now().active_layer].name == chosen.split()[0]


@pytest.mark.parametrize("direction", ["UP", "DOWN", "TOP", "BOTTOM"])
def test_any_move_keeps_all_layers_and_the_order_within_those_moved_and_not(direction):
    for count in range(1, 6):
        for bits in range(1, 2**count):
            moved = [i for i in range(count) if bits >> i & 1]
            new = reordered(count, moved, direction)
            assert sorted(new) == list(range(count))
            assert [i for i in new if i in moved] == moved
            assert [i for i in new if i not in moved] == [i for i in range(count) if i not in moved]


@pytest.mark.parametrize("chosen, direction", [("a", "UP"), ("d", "DOWN"), ("a b", "TOP"), ("c d", "BOTTOM")])
def test_what_is_at_the_end_already_stays(layers, chosen, direction):
    select(*chosen.split())
    assert bpy.ops.stillwater.move_layer(direction=direction) == {"CANCELLED"}
    assert order() == "a b c d"


def test_a_layer_comes_before_the_active_one(layers):
    select("c")
    step("add_layer")
    assert order() == "a b Layer c d" and selected() == "Layer"
    step("add_layer", motion="ripple")
    assert order() == "a b Water Layer c d" and now().layers[2].motion.type == "ripple"


def test_a_boat_floats_on_the_only_water_there_is(layers):
    for motion in ("bob", "ripple", "bob", "ripple", "bob"):
        bpy.ops.stillwater.add_layer(motion=motion)
    boats = {layer.name: layer.motion.bob.water for layer in layers.layers if layer.motion.type == "bob"}
    assert boats == {"Boat": "", "Boat.001": "Water", "Boat.002": ""}


def test_the_first_layer_is_the_background(scene, picture):
    picture.layers.clear()
    bpy.ops.stillwater.add_layer()
    assert order() == "Background"


def test_selected_layers_go_together(layers):
    select("c", "a")
    step("remove_layer")
    assert order() == "b d" and selected() == "d"
    select("d")
    step("remove_layer")
    assert order() == "b" and selected() == "b"
    step("remove_layer")
    assert order() == "" and now().active_layer == 0


def test_duplicates_stand_before_their_originals_and_are_selected(layers):
    select("c", "a")
    step("duplicate_layer")
    assert order() == "a.001 a b c.001 c d" and selected() == "a.001 c.001"
    assert now().layers[now().active_layer].name == "c.001"
    step("duplicate_layer")
    assert order() == "a.002 a.001 a b c.002 c.001 c d"


def test_a_duplicate_says_what_its_original_says(extension, layers):
    layer = layers.layers[0]
    layer.motion.type, layer.feather, layer.visible = "bob", 3, False
    for place in ((1, 2), (3, 4)):
        layer.motion.bob.waterline.add().place = place
    layer.motion.bob.water = "d"
    layer.matte.form, layer.matte.file = "file", "//matte.png"
    layer.motion.ripple.resolution, layer.motion.drift.velocity = "512", (1, 2)
    select("a")
    step("duplicate_layer")
    copy, original = said(extension)["layers"][:2]
    assert {**copy, "name": "a"} == original and original["motion"]["waterline"] == [[1, 2], [3, 4]]
    assert now().layers[0].motion.ripple.resolution == "512"
    assert tuple(now().layers[0].motion.drift.velocity) == (1, 2)


def test_clicking_a_layer_selects_it_alone(layers):
    select("b", "c")
    layers.active_layer = 3
    assert selected() == "d"
    layers.layers[0].selected = True
    layers.active_layer = 0
    assert selected() == "a d" and layers.layers[3].selected


@pytest.mark.parametrize(
    "action, expected", [("SELECT", "a b c d"), ("DESELECT", "b"), ("INVERT", "a b d"), ("MOTION", "b d")]
)
def test_selecting(layers, action, expected):
    for index in (1, 3):
        layers.layers[index].motion.type = "sway"
    select("b", "c")
    step("select_layers", action=action)
    assert selected() == expected


def test_all_selected_layers_are_hidden_and_get_a_motion(extension, layers):
    select("b", "c")
    step("show_layers", visible=False)
    assert [layer["visible"] for layer in said(extension)["layers"]] == [True, False, False, True]
    step("set_motion", type="drift")
    assert [layer["motion"]["type"] for layer in said(extension)["layers"]] == ["still", "drift", "drift", "still"]
    step("show_layers", visible=True)
    assert all(layer.visible for layer in now().layers)


def test_a_value_is_copied_to_the_selected_layers(layers):
    layers.layers[1].motion.sway.amount = 3
    layers.layers[1].motion.drift.velocity = (4, 5)
    layers.layers[1].follows.layer = "d"
    select("b", "a", "d")
    for path in ("motion.sway.amount", "motion.drift.velocity", "opacity", "follows.layer"):
        step("copy_to_selected", path=path)
    assert [layer.motion.sway.amount for layer in now().layers] == [3, 3, 1, 3]
    assert [tuple(layer.motion.drift.velocity) for layer in now().layers] == [(4, 5), (4, 5), (0, 0), (4, 5)]
    assert [round(layer.opacity, 3) for layer in now().layers] == [0.2, 0.2, 0.3, 0.2]
    assert [layer.follows.layer for layer in now().layers] == ["d", "d", "", ""]  # none follows itself


def test_a_value_of_any_layer_is_copied(layers):
    select("a", "b")
    bpy.ops.stillwater.copy_to_selected(path="opacity", layer=3)
    assert [round(layer.opacity, 3) for layer in layers.layers] == [0.4, 0.4, 0.3, 0.4]


def test_keys_and_drivers_come_with_a_copied_value(extension, layers):
    """And those that the others had there go."""
    key(extension, f"{LAYERS}[0].opacity", (1, 0), (4, 0.3))
    key(extension, f"{LAYERS}[1].opacity", (1, 1), (4, 0.7))
    key(extension, f"{LAYERS}[1].motion.drift.velocity", (1, 1), (4, 4), index=1)
    drive(f"{LAYERS}[2].opacity", "0.5")
    select("a", "b", "c")
    bpy.ops.stillwater.copy_to_selected(path="opacity")
    for name in "abc":
        assert over_time(extension, name, "opacity") == pytest.approx([0, 0.1, 0.2, 0.3], abs=1e-5)
    select("d", "a")
    bpy.ops.stillwater.copy_to_selected(path="opacity")
    assert over_time(extension, "a", "opacity") == 0.4
    paths = sorted(curve.data_path.removeprefix(LAYERS) for curve in keyed(extension))
    assert paths == ["[1].motion.drift.velocity", "[1].opacity", "[2].opacity"]


def test_a_motion_is_copied_without_its_place(layers):
    one, two = layers.layers[0].motion, layers.layers[1].motion
    one.type, one.sway.amount, one.sway.shimmer, one.sway.seed = "sway", 2, 0.5, 7
    one.sway.armature_root, two.sway.armature_root = (1, 2), (3, 4)
    select("a", "b")
    step("copy_to_selected")
    two = now().layers[1].motion
    assert (two.type, two.sway.amount, two.sway.shimmer) == ("sway", 2, 0.5)
    assert (tuple(two.sway.armature_root), two.sway.seed) == ((3, 4), -1)


UNCOPIED = ["name", "selected", "solo", "id", "id.x", "motion.sway", "motion.nothing", "motion.bob.waterline[0].place"]


@pytest.mark.parametrize("path", UNCOPIED)
def test_what_can_t_be_copied_is_said(layers, path):
    select("a", "b")
    with pytest.raises(RuntimeError, match="is not a value of a layer that can be copied"):
        bpy.ops.stillwater.copy_to_selected(path=path)


def test_a_waterline_is_edited_by_points(layers):
    layers.layers[0].motion.type = "bob"
    places = lambda: [tuple(point.place) for point in now().layers[0].motion.bob.waterline]  # noqa: E731
    for i in range(3):
        step("add_waterline_point", place=(i, 2 * i))
    assert places() == [(0, 0), (1, 2), (2, 4)]
    step("remove_waterline_point", index=1)
    assert places() == [(0, 0), (2, 4)]
    assert bpy.ops.stillwater.remove_waterline_point(index=5) == {"CANCELLED"}
    step("remove_waterline_point")
    assert places() == [(0, 0)]
    step("clear_waterline")
    assert places() == []
    assert bpy.ops.stillwater.remove_waterline_point() == {"CANCELLED"}


def test_solo_is_for_looking_and_never_for_bakes(extension, layers):
    layers.layers[1].visible = False
    assert [layer.seen() for layer in layers.layers] == [True, False, True, True]
    for index in (1, 2):
        layers.layers[index].solo = True
    assert [layer.seen() for layer in layers.layers] == [False, False, True, False]
    assert [layer["visible"] for layer in said(extension)["layers"]] == [True, False, True, True]
    assert all("solo" not in layer and "selected" not in layer for layer in said(extension)["layers"])


POLLS = {
    "add_layer": "The scene has no Stillwater picture yet",
    "paste_layers": "The scene has no Stillwater picture yet",
    "move_layer": "Select a layer first",
    "remove_layer": "Select a layer first",
    "duplicate_layer": "Select a layer first",
    "select_layers": "Select a layer first",
    "show_layers": "Select a layer first",
    "set_motion": "Select a layer first",
    "copy_layers": "Select a layer first",
    "copy_to_selected": "Select more layers first, by the boxes in the list",
    "add_waterline_point": "Select a layer with the motion Bob first",
    "remove_waterline_point": "Select a layer with the motion Bob first",
    "clear_waterline": "Select a layer with the motion Bob first",
    "apply_preset": "The scene has no Stillwater picture yet",
    "save_preset": "The scene has no Stillwater picture yet",
}


@pytest.mark.parametrize("operator, sentence", POLLS.items())
def test_what_is_greyed_out_says_why(extension, scene, operator, sentence):
    if sentence != "The scene has no Stillwater picture yet":
        picture = extension.properties.arrange.add_picture(scene, "Lake")
        if sentence != "Select a layer first":
            extension.properties.arrange.add_layer(picture, "a")
    with pytest.raises(RuntimeError, match=sentence):
        getattr(bpy.ops.stillwater, operator)()


def test_layers_of_a_linked_scene_are_left_alone(extension, layers, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "linked.blend"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(tmp_path / "linked.blend"), link=True) as (there, here):
        here.scenes = list(there.scenes)
    bpy.context.window.scene = here.scenes[0]
    for operator in POLLS:
        with pytest.raises(RuntimeError, match="This scene is linked"):
            getattr(bpy.ops.stillwater, operator)()
    assert order() == "a b c d"


def test_every_operator_is_found_by_a_name_in_title_case_and_says_what_it_does(extension):
    ours = [cls for cls in extension.layers.CLASSES if issubclass(cls, bpy.types.Operator)]
    assert len(ours) == 19
    for cls in ours:
        kind = getattr(bpy.ops.stillwater, cls.bl_idname.split(".")[1]).get_rna_type()
        small = {"to", "of", "the", "from"}
        assert all(word[0].isupper() or word in small for word in kind.name.split()), kind.name
        assert kind.description and not kind.description.endswith("."), kind.name
        assert "INTERNAL" not in cls.bl_options
