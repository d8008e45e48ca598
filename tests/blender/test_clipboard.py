"""Layers are copied to other pictures, scenes and files, with all that was said, their keys and their drivers."""

import importlib
import json

import bpy
import pytest
from layered import drive, fill, key, keyed, now, order, over_time, said, select, selected
from pixels import PACKAGE, set_up

LAYERS = "stillwater.pictures[0].layers"
clipboard = importlib.import_module(f"{PACKAGE}.layers.clipboard")


@pytest.fixture
def copied(extension, scene, picture, tmp_path):
    """boat (keyed, driven by the water and by a lamp), reflection and water, copied from a saved file."""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "first.blend"))
    scene, picture = bpy.context.scene, now()
    fill(extension, picture, "boat", "reflection", "water", "sky")
    boat, reflection, water, _ = picture.layers
    boat.motion.type, water.motion.type, reflection.follows.layer = "bob", "ripple", "boat"
    boat.motion.bob.water = "water"
    for place in ((1, 2), (30, 4)):
        boat.motion.bob.waterline.add().place = place
    boat.matte.form, boat.matte.file = "file", "//art/boat.png"
    boat.fill.method, boat.fill.file = "file", "//behind.png"
    water.motion.ripple.amplitude, water.motion.ripple.resolution = 0.5, "512"
    key(extension, f"{LAYERS}[0].opacity", (1, 0.1), (4, 0.4))
    drive(f"{LAYERS}[0].motion.bob.amount", "v * frame", f"{LAYERS}[2].motion.ripple.amplitude")
    lamp = bpy.data.objects.new("Lamp 'é\"1", None)
    lamp.location.x, lamp.use_fake_user = 0.25, True
    curve = scene.driver_add(f"{LAYERS}[2].opacity")
    variable = curve.driver.variables.new()
    variable.name, variable.targets[0].id, variable.targets[0].data_path = "x", lamp, "location.x"
    curve.driver.expression = "x"
    select("boat", "reflection", "water")
    assert bpy.ops.stillwater.copy_layers() == {"FINISHED"}
    return picture


def layer(extension, name: str) -> dict:
    return next(layer for layer in said(extension)["layers"] if layer["name"] == name)


def names(extension, boat="boat", water="water", reflection="reflection"):
    return layer(extension, boat)["motion"]["water"], layer(extension, reflection)["follows"]["layer"]


def test_pasted_into_the_same_picture_they_are_copies(extension, copied):
    before = said(extension)["layers"]
    select("sky")
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.stillwater.paste_layers("EXEC_DEFAULT", True) == {"FINISHED"}
    assert order() == "boat reflection water boat.001 reflection.001 water.001 sky"
    assert selected() == "boat.001 reflection.001 water.001"
    assert names(extension, "boat.001", "water.001", "reflection.001") == ("water.001", "boat.001")
    after = said(extension)["layers"]
    assert after[:3] + after[6:] == before
    assert after[3]["opacity"] == before[0]["opacity"] and after[3]["motion"]["amount"] == before[0]["motion"]["amount"]
    bpy.ops.ed.undo()
    assert said(extension)["layers"] == before
    bpy.ops.ed.redo()
    assert said(extension)["layers"] == after
    now().layers[5].motion.ripple.amplitude = 1  # the copy of the water drives the copy of the boat
    assert over_time(extension, "boat.001", "motion", "amount") == pytest.approx([1, 2, 3, 4])
    assert over_time(extension, "boat", "motion", "amount") == pytest.approx([0.5, 1, 1.5, 2])


def test_pasted_into_another_picture_of_another_scene(extension, copied):
    before = layer(extension, "boat")
    bpy.context.window.scene = bpy.data.scenes.new("Second")
    set_up(bpy.context.scene)
    extension.properties.arrange.add_picture(bpy.context.scene, "Empty")
    fill(extension, extension.properties.arrange.add_picture(bpy.context.scene, "Other"), "ground")
    bpy.ops.stillwater.paste_layers()
    assert order() == "boat reflection water ground" and names(extension) == ("water", "boat")
    after = layer(extension, "boat")
    assert {**after, "matte": 0, "fill": 0} == {**before, "matte": 0, "fill": 0}
    assert over_time(extension, "water", "opacity") == pytest.approx(0.25)
    assert {curve.data_path for curve in keyed(extension)} == {"stillwater.pictures[1].layers[0].opacity"}
    originals = bpy.data.scenes["Scene"].stillwater.pictures[0].layers
    assert not {layer.id for layer in now().layers} & {layer.id for layer in originals}


def test_pasted_into_another_file_paths_lead_to_the_same_files(extension, copied, tmp_path):
    (tmp_path / "sub").mkdir()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    set_up(bpy.context.scene)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "sub" / "second.blend"))
    extension.properties.arrange.add_picture(bpy.context.scene, "Other")
    assert bpy.ops.stillwater.paste_layers() == {"FINISHED"}
    boat = now().layers[0]
    assert (boat.matte.file, boat.fill.file) == ("//../art/boat.png", "//../behind.png")
    assert over_time(extension, "boat", "opacity") == pytest.approx([0.1, 0.2, 0.3, 0.4])
    assert over_time(extension, "boat", "motion", "amount") == pytest.approx([0.5, 1, 1.5, 2])


def test_what_can_t_come_along_is_said(extension, copied):
    """The lamp is not in the other file, nor is the water when the boat comes alone."""
    text = clipboard.place().read_text()
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    picture = extension.properties.arrange.add_picture(bpy.context.scene, "Other")
    lost = clipboard.from_text(picture, text, 0)
    assert lost == ["water: a driver reads Lamp 'é\"1, which is not in this file"]
    alone = json.loads(text)
    alone["layers"] = alone["layers"][:1]
    second = extension.properties.arrange.add_picture(bpy.context.scene, "Second")
    assert clipboard.from_text(second, json.dumps(alone), 0) == [
        "boat: water is not in Second",
        "boat: a driver reads motion.ripple.amplitude of a layer that is not in Second",
    ]
    assert second.layers[0].motion.bob.water == ""
    assert bpy.ops.stillwater.paste_layers() == {"FINISHED"}  # warnings, no error


def test_a_boat_that_comes_alone_takes_the_water_of_that_name(extension, copied):
    select("boat")
    bpy.ops.stillwater.copy_layers()
    fill(extension, extension.properties.arrange.add_picture(bpy.context.scene, "Other"), "water")
    now().layers[0].motion.type = "ripple"
    bpy.ops.stillwater.paste_layers()
    assert now().layers[0].motion.bob.water == "water"


def broken(change):
    said = json.loads(clipboard.place().read_text())
    change(said)
    return json.dumps(said)


@pytest.mark.parametrize(
    "change, sentence",
    [
        (lambda said: said.update(stillwater_layers=2), "The layers were copied by another version of Stillwater"),
        (lambda said: said.pop("layers"), "There are no copied layers"),
        (lambda said: said["layers"][2]["values"].update(colour=1), "can't be read: \"colour\" is not known"),
        (lambda said: said["layers"][2]["values"]["motion"].update(type="swim"), "type: 'swim' is not a value"),
        (lambda said: said["layers"][2]["values"].update(opacity="x"), "can't be read: opacity: 'x' is not a value"),
        (lambda said: said["layers"][1].pop("keys"), "The copied layers can't be read: 'keys'"),
        (lambda said: said["layers"][1].pop("name"), "The copied layers can't be read: 'name'"),
        (lambda said: said["layers"][1].update(values=[]), "The copied layers can't be read"),
    ],
)
def test_broken_copies_are_said_and_change_nothing(extension, copied, change, sentence):
    before, curves = said(extension), sorted(curve.data_path for curve in keyed(extension))
    clipboard.place().write_text(broken(change))
    with pytest.raises(RuntimeError, match=sentence):
        bpy.ops.stillwater.paste_layers()
    assert said(extension) == before and sorted(curve.data_path for curve in keyed(extension)) == curves


def test_with_nothing_copied_that_is_said(scene, picture):
    clipboard.place().unlink(missing_ok=True)
    with pytest.raises(RuntimeError, match="There are no copied layers"):
        bpy.ops.stillwater.paste_layers()


def test_a_folder_that_can_t_be_written_is_said(extension, copied, monkeypatch):
    monkeypatch.setattr(bpy.utils, "extension_path_user", lambda *args, **more: "/proc/nowhere")
    with pytest.raises(RuntimeError, match="The layers can't be copied"):
        bpy.ops.stillwater.copy_layers()
