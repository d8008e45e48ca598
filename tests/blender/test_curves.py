"""Keys and drivers go with their layer: when it moves, goes, is duplicated or renamed, and so does what reads it."""

import bpy
import pytest
from layered import drive, fill, key, keyed, now, order, over_time, said, select

LAYERS = "stillwater.pictures[0].layers"


@pytest.fixture
def layers(extension, scene, picture):
    """a: keyed opacity; b: a driven amount that reads a's opacity; c: a driven amount that reads its own opacity."""
    fill(extension, picture, "a", "b", "c")
    for layer in picture.layers:
        layer.motion.type = "sway"
    key(extension, f"{LAYERS}[0].opacity", (1, 0.1), (4, 0.4))
    drive(f"{LAYERS}[1].motion.sway.amount", "v * 10", f"{LAYERS}[0].opacity")
    drive(f"{LAYERS}[2].motion.sway.amount", "v + frame", f"{LAYERS}[2].opacity")
    return picture


def numbers(extension) -> dict:
    names = [layer["name"] for layer in said(extension)["layers"]]
    fields = (("opacity",), ("motion", "amount"))
    return {name: tuple(over_time(extension, name, *field) for field in fields) for name in names}


def close(value):
    return pytest.approx(value, abs=1e-4)


def test_they_are_what_the_tests_below_rest_on(extension, layers):
    said = numbers(extension)
    assert said["a"] == (close([0.1, 0.2, 0.3, 0.4]), 1)
    assert said["b"] == (close(0.2), close([1, 2, 3, 4]))
    assert said["c"] == (close(0.3), close([1.3, 2.3, 3.3, 4.3]))


@pytest.mark.parametrize("moves", [[(0, 2)], [(2, 0)], [(0, 1), (1, 2), (2, 0), (0, 1)]])
def test_moving_changes_no_number(extension, layers, moves):
    before = numbers(extension)
    for source, to in moves:
        extension.properties.arrange.move_layer(layers, source, to)
        assert numbers(extension) == before, order()


def test_renaming_changes_no_number(extension, layers):
    before = numbers(extension)
    layers.layers[0].name = "z"
    after = numbers(extension)
    assert after.pop("z") == before.pop("a") and after == before


def test_removing_takes_keys_and_drivers_away_and_leaves_the_others(extension, layers):
    before = numbers(extension)
    extension.properties.arrange.remove_layers(layers, [1])
    after = numbers(extension)
    assert after == {name: before[name] for name in "ac"}
    drivers = bpy.context.scene.animation_data.drivers
    assert [driver.data_path for driver in drivers] == [f"{LAYERS}[1].motion.sway.amount"]


def test_what_read_a_removed_layer_reads_no_other_one(extension, layers):
    extension.properties.arrange.remove_layers(layers, [0])
    driver = bpy.context.scene.animation_data.drivers[0].driver
    assert driver.variables[0].targets[0].data_path == "" and keyed(extension) == []
    assert over_time(extension, "c", "motion", "amount") == close([1.3, 2.3, 3.3, 4.3])


def test_a_duplicate_has_keys_and_drivers_of_its_own(extension, layers):
    before = numbers(extension)
    extension.properties.arrange.duplicate_layers(layers, [0, 2])
    assert order() == "a.001 a b c.001 c"
    after = numbers(extension)
    assert {name: after[name] for name in "abc"} == before
    assert after["a.001"] == before["a"] and after["c.001"] == before["c"]
    layers.layers[3].opacity = 0.9  # c.001 reads its own opacity, and c its own
    assert numbers(extension)["c.001"][1] == close([1.9, 2.9, 3.9, 4.9])
    assert numbers(extension)["c"] == before["c"]
    extension.properties.arrange.remove_layers(layers, [0, 3])
    assert numbers(extension) == before


def test_what_is_duplicated_together_stays_together(extension, scene, picture):
    fill(extension, picture, "boat", "reflection", "lake")
    boat, reflection, lake = picture.layers
    boat.motion.type, lake.motion.type = "bob", "ripple"
    boat.motion.bob.water = "lake"
    reflection.follows.layer = "boat"
    drive(f"{LAYERS}[0].opacity", "v", f"{LAYERS}[2].motion.ripple.amplitude")
    lake.motion.ripple.amplitude = 0.5
    extension.properties.arrange.duplicate_layers(picture, [0, 2])
    assert order() == "boat.001 boat reflection lake.001 lake"
    named = {layer.name: layer for layer in picture.layers}
    assert named["boat.001"].motion.bob.water == "lake.001" and named["boat"].motion.bob.water == "lake"
    assert named["reflection"].follows.layer == "boat"
    named["lake.001"].motion.ripple.amplitude = 0.25
    assert [over_time(extension, name, "opacity") for name in ("boat.001", "boat")] == close([0.25, 0.5])
    assert len({layer.id for layer in picture.layers}) == 5


def test_a_curve_is_copied_whole(extension, scene, picture):
    """Handles, interpolation, extrapolation, modifiers: the copy's values are the source's at every time."""
    fill(extension, picture, "a")
    curve = key(extension, f"{LAYERS}[0].opacity", (1, 0), (10, 0.5), (20, 1), (30, 0.2), (40, 0.7))
    ways = ("BEZIER", "ELASTIC", "BACK", "CONSTANT", "LINEAR")
    for point, interpolation in zip(curve.keyframe_points, ways, strict=True):
        point.interpolation, point.easing = interpolation, "EASE_OUT"
        point.amplitude, point.period, point.back = 0.8, 4.5, 1.2
    first = curve.keyframe_points[0]
    first.handle_right_type = "FREE"
    first.handle_right = (7, 0.9)
    curve.extrapolation, curve.lock, curve.color_mode = "LINEAR", True, "CUSTOM"
    noise = curve.modifiers.new("NOISE")
    noise.scale, noise.strength, noise.use_restricted_range = 3, 0.4, True
    noise.frame_start, noise.frame_end, noise.blend_in = 5, 25, 2
    envelope = curve.modifiers.new("ENVELOPE")
    for frame in (2, 30):
        envelope.control_points.add(frame)
    for name, values in (("min", (-1, -2)), ("max", (1, 2))):  # one by one Blender may crash: properties/curve_data.py
        envelope.control_points.foreach_set(name, values)
    steps = curve.modifiers.new("STEPPED")
    steps.frame_step, steps.mute = 4, True
    generator = curve.modifiers.new("GENERATOR")
    generator.poly_order, generator.use_additive = 2, True
    generator.coefficients = (0.1, 0.02, 0.001)
    extension.properties.arrange.duplicate_layers(picture, [0])
    curves = {curve.data_path: curve for curve in keyed(extension)}
    one, two = curves[f"{LAYERS}[0].opacity"], curves[f"{LAYERS}[1].opacity"]
    times = [t / 4 for t in range(-20, 240)]
    assert [one.evaluate(t) for t in times] == [two.evaluate(t) for t in times]
    assert len(set(round(one.evaluate(t), 3) for t in times)) > 40
    assert (one.lock, one.color_mode, [m.mute for m in one.modifiers]) == (True, "CUSTOM", [False, False, True, False])


def test_strips_follow_too_and_each_action_once(extension, scene, picture):
    """Two strips of one action: its curves are renumbered once."""
    fill(extension, picture, "a", "b", "c")
    key(extension, f"{LAYERS}[0].opacity", (1, 0.5), (4, 1))
    data = scene.animation_data
    action, slot = data.action, data.action_slot
    for name, start in (("one", 1), ("two", 20)):
        strip = data.nla_tracks.new().strips.new(name, start, action)
        strip.action_slot = slot
    data.action = None
    extension.properties.arrange.move_layer(picture, 0, 2)
    assert [curve.data_path for curve in extension.versions.curves_of(action, slot)] == [f"{LAYERS}[2].opacity"]
    extension.properties.arrange.duplicate_layers(picture, [2])
    paths = sorted(curve.data_path for curve in extension.versions.curves_of(action, slot))
    assert paths == [f"{LAYERS}[2].opacity", f"{LAYERS}[3].opacity"]


def test_drivers_elsewhere_in_the_file_keep_reading_their_layer(extension, scene, picture):
    """Of objects, and of node trees inside other datablocks."""
    fill(extension, picture, "a", "b", "c")
    lamp = bpy.data.objects.new("Lamp", None)
    material = bpy.data.materials.new("Sea")
    if material.node_tree is None:
        material.use_nodes = True
    value = material.node_tree.nodes.new("ShaderNodeValue")
    driven = [lamp.driver_add("location", 0), value.outputs[0].driver_add("default_value")]
    for curve in driven:
        variable = curve.driver.variables.new()
        variable.targets[0].id_type, variable.targets[0].id = "SCENE", scene
        variable.targets[0].data_path = f"{LAYERS}[1].opacity"
    extension.properties.arrange.move_layer(picture, 1, 2)
    read = [curve.driver.variables[0].targets[0].data_path for curve in driven]
    assert read == [f"{LAYERS}[2].opacity"] * 2


def test_a_duplicate_s_driver_reads_the_same_node_tree(extension, scene, picture):
    """One that is inside another datablock, and so in no list of the file."""
    fill(extension, picture, "a")
    material = bpy.data.materials.new("Sea")
    if material.node_tree is None:
        material.use_nodes = True
    variable = scene.driver_add(f"{LAYERS}[0].opacity").driver.variables.new()
    variable.targets[0].id_type, variable.targets[0].id = "NODETREE", material.node_tree
    variable.targets[0].data_path = "nodes[0].width"
    extension.properties.arrange.duplicate_layers(picture, [0])
    targets = [curve.driver.variables[0].targets[0] for curve in scene.animation_data.drivers]
    assert [(target.id, target.data_path) for target in targets] == [(material.node_tree, "nodes[0].width")] * 2


def test_removing_a_picture_breaks_what_reads_it_and_nothing_else(extension, scene, picture):
    arrange = extension.properties.arrange
    second = arrange.add_picture(scene, "Second")
    arrange.add_layer(second, "d").opacity = 0.7
    lamp = bpy.data.objects.new("Lamp", None)
    for axis, path in enumerate(("stillwater.pictures[0].wind.speed", "stillwater.pictures[1].layers[0].opacity")):
        variable = lamp.driver_add("location", axis).driver.variables.new()
        variable.targets[0].id_type, variable.targets[0].id, variable.targets[0].data_path = "SCENE", scene, path
    arrange.remove_picture(scene, 0)
    read = [curve.driver.variables[0].targets[0].data_path for curve in lamp.animation_data.drivers]
    assert read == ["", f"{LAYERS}[0].opacity"]


@pytest.mark.parametrize("operator", ["duplicate_layer", "remove_layer", "move_layer"])
def test_undo_and_redo_take_keys_and_drivers_along(extension, layers, operator):
    select("a")
    before = numbers(extension)
    bpy.ops.ed.undo_push(message="before")
    more = {"direction": "BOTTOM"} if operator == "move_layer" else {}
    getattr(bpy.ops.stillwater, operator)("EXEC_DEFAULT", True, **more)
    after = numbers(extension)
    bpy.ops.ed.undo()
    assert numbers(extension) == before and order() == "a b c"
    bpy.ops.ed.redo()
    assert numbers(extension) == after and order() != "a b c"
    assert now().layers[0].id
