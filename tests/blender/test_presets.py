"""Presets: ours are accepted by the engine, an artist's own are files; they set a look and never a place."""

import importlib
import json

import bpy
import pytest
import recipes
import stillwater
from layered import fill, key, now, order, said, select
from pixels import PACKAGE

files = importlib.import_module(f"{PACKAGE}.layers.preset_files")
OTHERS = ("flow", "example")  # test_flow.py and test_example.py have those
SHIPPED = [(kind, path) for kind in files.KINDS if kind not in OTHERS for path in files.paths(kind)]
NAMES = {
    "sway": {"Still Tree", "Tree", "Tree in a Storm", "Reeds and Grass"},
    "ripple": {"Pond", "Lake", "Sea"},
    "bob": {"Boat", "Ship"},
    "drift": {"Clouds", "Clouds in a Storm"},
    "flow": {"River", "Rapids", "Waterfall", "Sea", "Smoke", "Fire", "Passing Clouds"},
    "example": {"River", "Campfire", "Water Surface", "Brook", "Waterfall", "Wide Waterfall", "Smoke", "Thin Smoke"},
    "wind": {"Calm", "Breeze", "Wind", "Storm"},
}


@pytest.fixture
def whole(extension, scene, tmp_path):
    """A picture on disk whose recipe the engine accepts: one layer of each motion, nothing keyed."""
    recipe = held(recipes.whole())
    recipes.write(tmp_path, recipe)
    for file in ("matte.png", "behind.png", "labels.png"):
        (tmp_path / file).write_bytes((tmp_path / "picture.png").read_bytes())
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.stillwater.load_recipe(filepath=str(tmp_path / "recipe.json"))
    return now()


def held(part):
    """A recipe with the first value of each animated number."""
    if isinstance(part, dict) and "values" in part:
        return part["values"][0]
    if isinstance(part, dict):
        return {name: held(value) for name, value in part.items()}
    return [held(value) for value in part] if isinstance(part, list) else part


def test_each_motion_and_the_wind_has_presets():
    for kind, names in NAMES.items():
        assert {files.name_of(path) for path in files.paths(kind)} >= names
        assert all(files.read(path).kind == kind and files.read(path).description for path in files.paths(kind))


@pytest.mark.parametrize("kind, path", SHIPPED, ids=[path.stem for _, path in SHIPPED])
def test_the_engine_accepts_a_recipe_with_it(extension, whole, kind, path):
    layer = {"sway": "tree", "ripple": "lake", "bob": "boat", "drift": "clouds", "wind": "tree"}[kind]
    before = next(one for one in said(extension)["layers"] if one["name"] == layer)
    select(layer)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.stillwater.apply_preset("EXEC_DEFAULT", True, filepath=str(path))
    recipe = said(extension)
    assert stillwater.parse(recipe)
    numbers = dict(files.read(path).numbers)
    motions = {one["name"]: one["motion"] for one in recipe["layers"]}
    part = recipe["wind"] if kind == "wind" else motions[layer]
    if not numbers.pop("use_velocity", True):
        assert "velocity" not in part
    assert {name: part[name] for name in numbers} == numbers
    for place in {"armature", "waterline", "water", "seed"} & set(before["motion"]):
        assert kind == "wind" or part[place] == before["motion"][place]
    bpy.ops.ed.undo()
    assert next(one for one in said(extension)["layers"] if one["name"] == layer) == before
    bpy.ops.ed.redo()
    assert said(extension) == recipe


def test_a_layer_is_added_with_a_preset(scene, picture):
    path = next(path for path in files.paths("sway") if path.stem == "Tree_in_a_Storm")
    bpy.ops.stillwater.add_layer(preset=str(path))
    assert order() == "Tree in a Storm all"
    layer = picture.layers[0]
    assert layer.motion.type == "sway"
    assert layer.motion.sway.shimmer == pytest.approx(files.read(path).numbers["shimmer"])
    with pytest.raises(RuntimeError, match="there is no such preset"):
        bpy.ops.stillwater.add_layer(preset="/nowhere/Tree.json")
    assert order() == "Tree in a Storm all"


def test_a_preset_goes_to_the_selected_layers_of_its_motion(extension, scene, picture):
    fill(extension, picture, "a", "b", "c", "d")
    for index, kind in enumerate(("sway", "sway", "ripple", "still")):
        picture.layers[index].motion.type = kind
    select("d", "b", "c")
    path = next(path for path in files.paths("sway") if path.stem == "Tree_in_a_Storm")
    bpy.ops.stillwater.apply_preset(filepath=str(path))
    shimmer = files.read(path).numbers["shimmer"]
    assert [layer.motion.type for layer in picture.layers] == ["sway", "sway", "ripple", "sway"]
    stormy = [layer.motion.sway.shimmer == pytest.approx(shimmer) for layer in picture.layers]
    assert stormy == [False, True, False, True]


def test_what_a_preset_does_not_name_gets_its_default(scene, picture):
    sway = picture.layers[0].motion.sway
    sway.mass, sway.armature_tip, sway.seed = 5, (1, 2), 8
    bpy.ops.stillwater.apply_preset(filepath=str(files.paths("sway")[0]))
    assert sway.mass == 1 and tuple(sway.armature_tip) == (1, 2) and sway.seed == 8


def test_a_wind_preset_leaves_its_direction(scene, picture):
    picture.wind.direction, picture.wind.seed = 1, 4
    bpy.ops.stillwater.apply_preset(filepath=str(next(p for p in files.paths("wind") if p.stem == "Storm")))
    assert picture.wind.speed > 10 and picture.wind.direction == 1 and picture.wind.seed == 4


def test_a_keyed_number_stays_and_that_is_said(extension, scene, picture, capfd):
    """Of any layer that the preset goes to, and of the wind."""
    fill(extension, picture, "a", "b")
    for layer in picture.layers:
        layer.motion.type, layer.selected = "sway", True
    key(extension, "stillwater.pictures[0].layers[1].motion.sway.amount", (1, 3), (9, 4))
    key(extension, "stillwater.pictures[0].wind.speed", (1, 3), (9, 4))
    bpy.ops.stillwater.apply_preset(filepath=str(files.paths("sway")[0]))
    assert "Amount: keyed or driven, which stays as it was" in capfd.readouterr().out
    bpy.ops.stillwater.apply_preset(filepath=str(files.paths("wind")[0]))
    assert "Speed: keyed or driven, which stays as it was" in capfd.readouterr().out


@pytest.mark.parametrize("kind", files.KINDS)
def test_an_own_preset_is_saved_as_a_file_and_brings_every_number_back(extension, scene, picture, kind):
    of = "WIND" if kind == "wind" else "MOTION"
    layer = picture.layers[0]
    layer.motion.type = kind if kind != "wind" else "still"
    group = picture.wind if kind == "wind" else layer.motion.numbers()
    changed = {}
    for name in (name for name in type(group).__annotations__ if name not in files.APART):
        rna = group.bl_rna.properties[name]
        if rna.type == "ENUM":
            value = rna.enum_items[-1].identifier
        elif rna.type == "BOOLEAN":
            value = not rna.default
        else:
            value = [1.25, -2.5] if rna.is_array else rna.default * 0.5 + 0.125
            if rna.type == "INT":
                value = [7, 9] if rna.is_array else rna.default + 1
        setattr(group, name, value)
        changed[name] = getattr(group, name) if not getattr(rna, "is_array", False) else tuple(getattr(group, name))
    assert bpy.ops.stillwater.save_preset(name="My Own: été", of=of) == {"FINISHED"}
    path = next(path for path in files.paths(kind) if not files.is_shipped(path))
    assert path.parent.parts[-3:] == ("presets", "stillwater", kind) and "My_Own" in path.stem
    numbers = json.loads(path.read_text(encoding="utf-8"))["numbers"]
    assert set(numbers) == set(changed)
    bpy.ops.stillwater.apply_preset(filepath=str(files.paths(kind)[0]))
    bpy.ops.stillwater.apply_preset(filepath=str(path))
    group = now().wind if kind == "wind" else now().layers[0].motion.numbers()
    for name, value in changed.items():
        back = getattr(group, name)
        assert (tuple(back) if isinstance(value, tuple) else back) == value, name
    with pytest.raises(RuntimeError, match="exists already"):
        bpy.ops.stillwater.save_preset(name="my own: été", of=of)
    assert bpy.ops.stillwater.remove_preset(filepath=str(path)) == {"FINISHED"}
    assert not path.exists() and not [path for path in files.paths(kind) if not files.is_shipped(path)]


def test_what_is_no_own_preset_is_never_deleted(scene, tmp_path):
    other = tmp_path / "picture.json"
    other.touch()
    for path in (other, files.paths("sway")[0]):
        with pytest.raises(RuntimeError, match="is no preset of your own"):
            bpy.ops.stillwater.remove_preset(filepath=str(path))
        assert path.exists()


@pytest.mark.parametrize(
    "text, sentence",
    [
        ("", "is not a preset of Stillwater"),
        ("[]", "is not a preset of Stillwater"),
        ('{"stillwater_preset": 1, "kind": "sway"}', "is not a preset of Stillwater"),
        ('{"stillwater_preset": 1, "kind": "sway", "numbers": {}, "size": [0, 5]}', "is not a preset of Stillwater"),
        ('{"stillwater_preset": 1, "kind": "sway", "numbers": {}, "size": 5}', "is not a preset of Stillwater"),
        ('{"stillwater_preset": 2, "kind": "sway", "numbers": {}}', "is a preset of another version of Stillwater"),
        ('{"stillwater_preset": 1, "kind": "swim", "numbers": {}}', "is a preset of another version of Stillwater"),
        ('{"stillwater_preset": 1, "kind": "sway", "numbers": {"speed": 1}}', "has no speed that a preset could set"),
        ('{"stillwater_preset": 1, "kind": "sway", "numbers": {"seed": 1}}', "has no seed that a preset could set"),
        ('{"stillwater_preset": 1, "kind": "sway", "numbers": {"mass": 3, "shimmer": 2}}', "shimmer can't be 2"),
        ('{"stillwater_preset": 1, "kind": "sway", "numbers": {"shimmer": "x"}}', "shimmer can't be 'x'"),
        ('{"stillwater_preset": 1, "kind": "sway", "numbers": {"shimmer": true}}', "shimmer can't be True"),
        ('{"stillwater_preset": 1, "kind": "drift", "numbers": {"velocity": 1}}', "velocity can't be 1"),
        ('{"stillwater_preset": 1, "kind": "drift", "numbers": {"velocity": [1, 2, 3]}}', "velocity can't be"),
        ('{"stillwater_preset": 1, "kind": "ripple", "numbers": {"resolution": 100}}', "resolution can't be 100"),
        ('{"stillwater_preset": 1, "kind": "drift", "numbers": {"use_velocity": 1}}', "use_velocity can't be 1"),
    ],
)
def test_a_broken_preset_is_said_and_changes_nothing(extension, scene, picture, tmp_path, text, sentence):
    picture.picture = "/picture.png"
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    before = said(extension)
    path = tmp_path / "Broken.json"
    path.write_text(text)
    with pytest.raises(RuntimeError, match=sentence):
        bpy.ops.stillwater.apply_preset(filepath=str(path))
    assert said(extension) == before and files.description_of(str(path)) == ""


def test_a_still_layer_has_nothing_to_save(scene, picture):
    with pytest.raises(RuntimeError, match="a still layer has no numbers to save"):
        bpy.ops.stillwater.save_preset(name="x")
    picture.layers[0].motion.type = "sway"
    with pytest.raises(RuntimeError, match="Give the preset a name first"):
        bpy.ops.stillwater.save_preset(name=" . ")
    picture.layers.clear()
    for operator, more in (("save_preset", {"name": "x"}), ("apply_preset", {"filepath": str(files.paths("sway")[0])})):
        with pytest.raises(RuntimeError, match="Select a layer first"):
            getattr(bpy.ops.stillwater, operator)(**more)


def test_no_folder_for_own_presets_is_said(scene, picture, monkeypatch):
    picture.layers[0].motion.type = "sway"
    monkeypatch.setattr(bpy.utils, "user_resource", lambda *args, **more: "")
    with pytest.raises(RuntimeError, match="The folder of your presets can't be made"):
        bpy.ops.stillwater.save_preset(name="x")
