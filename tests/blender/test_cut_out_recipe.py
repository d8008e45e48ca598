"""Mattes that are drawn or solved, and what fills the holes: from the recipe to properties and strokes, and back."""

import json

import bpy
import msgspec
import pytest
import recipes
import stillwater
from layered import said
from msgspec import inspect
from pixels import PACKAGE
from stillwater.recipe.mattes import (
    ExemplarFill,
    FileMatte,
    LabelMatte,
    LassoMatte,
    ScribbleMatte,
    TouchUp,
    TrimapMatte,
)
from test_recipe import fields, numbers, rna_of

FORMS = {"file": FileMatte, "labels": LabelMatte, "scribbles": ScribbleMatte, "lasso": LassoMatte, "trimap": TrimapMatte}
DRAWN = {"scribbles", "lasso"}  # fields that strokes are
MATTE = {name: field for cls in FORMS.values() for name, field in fields(cls).items() if name not in DRAWN}
FILL = {name: field for name, field in fields(ExemplarFill).items() if name not in ("method", "source", "touch_up")}
TOUCH_UP = {f"touch_up_{name}": field for name, field in fields(TouchUp).items() if name != "stroke"}
PAIRS = [("STILLWATER_PG_matte", name, field) for name, field in MATTE.items()]
PAIRS += [("STILLWATER_PG_fill", name, field) for name, field in (FILL | TOUCH_UP).items()]
ANYWHERE = {"radius", "touch_up_radius"}  # 0 stands for the recipe's null


@pytest.mark.parametrize("group, name, field", PAIRS, ids=lambda value: value if isinstance(value, str) else "")
def test_a_property_is_limited_and_measured_as_its_field(extension, group, name, field):
    kind = rna_of(group, name)
    assert kind.description and not kind.is_animatable
    if kind.type == "ENUM":
        plain = field.type.type if isinstance(field.type, inspect.Metadata) else field.type
        assert {item.identifier for item in kind.enum_items} == set(plain.values) and kind.default == field.default
    if kind.type not in ("FLOAT", "INT"):
        return
    number, unit = next(numbers(field.type))
    assert kind.hard_min == (0 if name in ANYWHERE else number.ge) <= kind.soft_min
    assert kind.hard_max == number.le >= kind.soft_max or number.le > kind.hard_max == 2**31 - 1
    assert not unit or unit == "label" or f"[{unit}]" in kind.description, kind.description
    if field.default not in (inspect.NODEFAULT, None):
        assert kind.default == field.default


def test_every_form_is_offered(extension):
    forms = {item.identifier for item in rna_of("STILLWATER_PG_matte", "form").enum_items}
    assert forms == {"none", *FORMS}


def close(ours, theirs, place="recipe"):
    """As equal as strokes on a plane can be: within a hundredth of a pixel."""
    if isinstance(theirs, dict):
        assert set(ours) == set(theirs), place
        for name in theirs:
            close(ours[name], theirs[name], f"{place}.{name}")
    elif isinstance(theirs, list | tuple):
        assert len(ours) == len(theirs), place
        for i, (a, b) in enumerate(zip(ours, theirs, strict=True)):
            close(a, b, f"{place}[{i}]")
    elif isinstance(theirs, float):
        assert ours == pytest.approx(theirs, abs=0.01), place
    else:
        assert ours == theirs, place


def normal(recipe) -> list:
    """Its layers with every default, every point with its pressure."""
    return pressed(msgspec.to_builtins(stillwater.parse(recipe).recipe)["layers"])


def pressed(part):
    if isinstance(part, dict):
        full = {name: pressed(value) for name, value in part.items()}
        return full if "points" not in full else {**full, "points": [[*point, 1.0][:3] for point in full["points"]]}
    return [pressed(item) for item in part] if isinstance(part, list) else part


@pytest.fixture
def opened(extension, scene, tmp_path):
    """The recipe with every form, opened in a saved file."""
    path = recipes.write(tmp_path / "made", recipes.cut_out())
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "made" / "file.blend"))
    assert bpy.ops.stillwater.load_recipe("EXEC_DEFAULT", True, filepath=str(path)) == {"FINISHED"}


def written(extension) -> list:
    return normal(json.loads(json.dumps(said(extension)).replace("../../", "")))


def test_a_recipe_that_was_opened_is_written_as_it_was(extension, opened):
    close(written(extension), normal(recipes.cut_out()))


def test_it_outlives_saving_undo_and_another_name(extension, opened, tmp_path):
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)
    close(written(extension), normal(recipes.cut_out()))
    bpy.ops.ed.undo_push(message="before")
    bpy.context.scene.stillwater.active().layers[0].name = "oak"
    bpy.ops.stillwater.duplicate_layer("EXEC_DEFAULT", True)
    bpy.ops.ed.undo()
    close(written(extension), normal(recipes.cut_out()))


def test_a_duplicate_has_all_of_it(extension, opened):
    bpy.context.scene.stillwater.active().active_layer = 1
    bpy.ops.stillwater.duplicate_layer("EXEC_DEFAULT", True)
    _, boat, copy, *_ = written(extension)
    assert boat.pop("name") != copy.pop("name")
    close(copy, boat)


def test_copied_layers_bring_their_strokes_to_another_picture(extension, opened, tmp_path):
    before = written(extension)
    picture = bpy.context.scene.stillwater.active()
    for i, layer in enumerate(picture.layers):
        layer.selected = i < 3
    picture.active_layer = 0
    assert bpy.ops.stillwater.copy_layers() == {"FINISHED"}
    path = recipes.write(tmp_path / "other", recipes.whole())
    bpy.ops.stillwater.load_recipe(filepath=str(path))
    bpy.context.scene.stillwater.active().active_layer = 0
    assert bpy.ops.stillwater.paste_layers("EXEC_DEFAULT", True) == {"FINISHED"}
    after = json.loads(json.dumps(said(extension)["layers"][:3]))
    assert [layer["name"] for layer in after] == ["tree.001", "boat.001", "hill"] or len(after) == 3
    for mine, theirs in zip(after, before[:3], strict=True):
        mine = normal({**said(extension), "layers": [{**mine, "name": "a"}, {"name": "b"}]})[0]
        for part in (mine, theirs):
            for group in (part["matte"], part["fill"].get("source") or {}):
                group.pop("trimap", None)  # the same file, seen from another folder
        close({name: mine[name] for name in ("matte", "fill")}, {name: theirs[name] for name in ("matte", "fill")})


def test_layers_without_a_drawing_to_go_to_say_what_did_not_come_along(extension, opened):
    import importlib

    clipboard = importlib.import_module(f"{PACKAGE}.layers.clipboard")
    text = clipboard.to_text(bpy.context.scene.stillwater.active(), [1])
    bare = extension.properties.arrange.add_picture(bpy.context.scene, "Bare")
    (sentence,) = clipboard.from_text(bare, text, 0)
    assert sentence.startswith("boat: its strokes did not come along: Bare: has no drawing for strokes")


def test_a_value_that_blender_can_t_hold_is_refused(extension, scene, tmp_path):
    recipe = recipes.cut_out()
    recipe["layers"][0]["fill"]["touch_up"][0]["seed"] = 2**31 - 1
    with pytest.raises(RuntimeError, match="layers.0..fill.touch_up.0..seed: 2147483648 is above"):
        bpy.ops.stillwater.load_recipe(filepath=str(recipes.write(tmp_path, recipe)))
    assert len(bpy.context.scene.stillwater.pictures) == 0


def test_a_patch_is_odd(picture):
    fill = picture.layers[0].fill
    for given, kept in ((12, 13), (13, 13), (62, 63), (3, 3)):
        fill.patch = given
        assert fill.patch == kept
