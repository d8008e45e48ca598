"""What the artist says reaches the recipe: every property, keys, drivers, strips, layers under any name."""

import json
import math

import bpy
import msgspec
import pytest
import recipes
import stillwater
from msgspec import inspect
from stillwater.recipe import Layer, Output, Recipe, View, Wind
from stillwater.recipe.fluids import Flow
from stillwater.recipe.mattes import FileMatte, LabelMatte
from stillwater.recipe.picture import Follows
from stillwater.recipe.stochastic import Bob, Drift, Ripple, Sway

# Property group -> the recipe's class, and the properties that stand for its fields under another name.
OURS = {"id", "name", "tree", "plane", "camera", "strokes", "picture_size", "active_layer"}  # of a picture, in Blender
OURS |= {"collection", "image", "missing"}
FLOWING = {"refine_width", "refine_amount", "outline_moving", "outline_persistence", "proposal"}  # test_flow.py has them
FLOWING |= {"stroke_speed", "stroke_local", "stroke_alpha"}
GROUPS = {
    "STILLWATER_PG_picture": (Recipe, OURS),
    "STILLWATER_PG_wind": (Wind, set()),
    "STILLWATER_PG_view": (View, {"use_horizon", "horizon_start", "horizon_end"}),
    "STILLWATER_PG_output": (Output, set()),
    "STILLWATER_PG_layer": (Layer, {"id", "selected", "solo"}),
    "STILLWATER_PG_follows": (Follows, {"layer_id"}),
    "STILLWATER_PG_sway": (Sway, {"armature_root", "armature_tip"}),
    "STILLWATER_PG_ripple": (Ripple, set()),
    "STILLWATER_PG_bob": (Bob, {"water_id"}),
    "STILLWATER_PG_drift": (Drift, {"use_velocity"}),
    "STILLWATER_PG_flow": (Flow, FLOWING),
}
# Fields that the scene itself has, or that stand in properties of another name.
ELSEWHERE = {Recipe: {"stillwater", "frames", "fps", "size"}, View: {"horizon"}, Sway: {"armature"}}
ELSEWHERE[Flow] = {"strokes", "refine", "freeze", "outline"}


def class_of(group):
    return bpy.types.PropertyGroup.bl_rna_get_subclass_py(group)


def fields(cls):
    return {field.encode_name: field for field in inspect.type_info(cls).fields}


def numbers(kind):
    """The number types that a field of the recipe may be, with their Metadata's unit."""
    if isinstance(kind, inspect.Metadata):
        for number, unit in numbers(kind.type):
            yield number, (kind.extra or {}).get("unit", unit)
    elif isinstance(kind, inspect.UnionType):
        for part in kind.types:
            yield from numbers(part)
    elif isinstance(kind, inspect.TupleType):
        for part in kind.item_types:
            yield from numbers(part)
    elif isinstance(kind, inspect.IntType | inspect.FloatType):
        yield kind, ""


def is_animated(kind) -> bool:
    kind = kind.type if isinstance(kind, inspect.Metadata) else kind
    parts = kind.types if isinstance(kind, inspect.UnionType) else ()
    structs = [part for part in parts if isinstance(part, inspect.StructType)]
    return any({field.name for field in struct.fields} == {"first", "values"} for struct in structs)


@pytest.mark.parametrize("group", GROUPS)
def test_properties_are_named_as_the_recipe_s_fields(extension, group):
    cls, ours = GROUPS[group]
    properties = set(class_of(group).__annotations__) - ours
    assert properties == set(fields(cls)) - ELSEWHERE.get(cls, set())


PAIRS = [(group, name) for group, (cls, _) in GROUPS.items() for name in fields(cls)]


def rna_of(group, name):
    return next((kind for kind in reversed(class_of(group).bl_rna.properties) if kind.identifier == name), None)


@pytest.mark.parametrize("group, name", [pair for pair in PAIRS if rna_of(*pair)])
def test_a_property_is_keyed_limited_and_measured_as_its_field(extension, group, name):
    kind, field = rna_of(group, name), fields(GROUPS[group][0])[name]
    if kind.type in ("POINTER", "COLLECTION"):
        return
    assert kind.is_animatable == is_animated(field.type)
    assert kind.description and kind.description == kind.description.rstrip(".")
    if kind.type not in ("FLOAT", "INT"):
        return
    scale = 180 / math.pi if kind.subtype == "ANGLE" else 1
    number, unit = next(numbers(field.type))
    low = (1, number.ge, number.gt, kind.hard_min, kind.soft_min)
    high = (-1, number.le, number.lt, kind.hard_max, kind.soft_max)
    for sign, closed, opened, hard, soft in (low, high):
        limit = closed if closed is not None else opened
        if limit is not None and name != "seed":
            assert sign * hard * scale >= sign * limit - 1e-4 * abs(limit), (hard, limit)
            assert opened is None or hard * scale != opened
        assert sign * soft >= sign * hard
    assert not unit or unit in kind.description, f"{kind.description} does not tell its unit, {unit}"


@pytest.mark.parametrize("group, name", [pair for pair in PAIRS if rna_of(*pair)])
def test_a_property_s_default_is_its_field_s(extension, group, name):
    kind, field = rna_of(group, name), fields(GROUPS[group][0])[name]
    if field.default in (inspect.NODEFAULT, None) or kind.type in ("POINTER", "COLLECTION"):
        return
    scale = 180 / math.pi if kind.subtype == "ANGLE" else 1
    if kind.type in ("FLOAT", "INT"):
        assert kind.default * scale == pytest.approx(field.default)
    else:
        assert kind.default == (str(field.default) if kind.type == "ENUM" else field.default)


@pytest.mark.parametrize("group, name", [pair for pair in PAIRS if rna_of(*pair) and rna_of(*pair).type == "ENUM"])
def test_a_menu_offers_what_the_recipe_allows(extension, group, name):
    kind = fields(GROUPS[group][0])[name].type
    kind = kind.type if isinstance(kind, inspect.Metadata) else kind
    assert {item.identifier for item in rna_of(group, name).enum_items} == set(map(str, kind.values))


def test_new_properties_make_the_recipe_s_defaults(extension, scene, picture, written):
    """An untouched layer of each motion is written as if nothing had been said."""
    picture.picture = "/picture.png"
    for kind in ("sway", "ripple", "bob", "drift", "flow"):
        extension.properties.arrange.add_layer(picture, kind).motion.type = kind
    said = written()
    for layer in said["layers"]:
        motion = dict(layer["motion"])
        cls = {"sway": Sway, "ripple": Ripple, "bob": Bob, "drift": Drift, "flow": Flow}.get(motion.pop("type"))
        for name, value in motion.items():
            default = fields(cls)[name].default if cls else None
            if default not in (inspect.NODEFAULT, None):
                assert value == msgspec.to_builtins(default), (layer["name"], name)


@pytest.fixture
def written(extension, tmp_path):
    """Writes the first picture's recipe and returns it."""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))

    def write():
        scene = bpy.context.scene
        with open(extension.bake.job.write_recipe(scene, scene.stillwater.pictures[0])) as file:
            return json.load(file)

    return write


def animated(extension, path, index, keys):
    extension.versions.set_curve(bpy.context.scene, path, index, keys)


def test_keys_are_sampled_at_every_frame_from_1(extension, scene, picture, written):
    """From frame 1, where rates are summed from, to one past the last, which the flow looks at."""
    animated(extension, "stillwater.pictures[0].wind.speed", 0, [(1, 2), (11, 12)])
    assert written()["wind"]["speed"] == {"first": 1, "values": [2, 3, 4, 5, 6, 7, 8, 9, 10]}


def test_frames_before_1_are_sampled_too(extension, scene, picture, written):
    scene.frame_start, scene.frame_end = 0, 1
    animated(extension, "stillwater.pictures[0].wind.speed", 0, [(0, 2), (10, 12)])
    assert written()["wind"]["speed"] == {"first": 0, "values": [2, 3, 4]}


def test_angles_are_degrees(extension, scene, picture, written):
    picture.view.fov = math.radians(65)
    animated(extension, "stillwater.pictures[0].wind.direction", 0, [(1, math.radians(30)), (10, math.radians(120))])
    said = written()
    assert said["view"]["fov"] == 65
    assert said["wind"]["direction"]["values"] == pytest.approx([30, 40, 50, 60, 70, 80, 90, 100, 110])


def test_a_vector_is_sampled_whole_where_one_part_is_keyed(extension, scene, picture, written):
    drift = picture.layers[0].motion
    drift.type, drift.drift.use_velocity, drift.drift.velocity = "drift", True, (3, 4)
    animated(extension, "stillwater.pictures[0].layers[0].motion.drift.velocity", 1, [(1, 0), (9, 8)])
    assert written()["layers"][0]["motion"]["velocity"]["values"] == [[3, y] for y in range(9)]


def test_keys_that_change_nothing_are_one_number(extension, scene, picture, written):
    animated(extension, "stillwater.pictures[0].wind.speed", 0, [(1, 7), (10, 7)])
    assert written()["wind"]["speed"] == 7


def test_a_muted_curve_does_not_count(extension, scene, picture, written):
    animated(extension, "stillwater.pictures[0].wind.speed", 0, [(1, 2), (10, 12)])
    data = scene.animation_data
    extension.versions.curves_of(data.action, data.action_slot)[0].mute = True
    assert written()["wind"]["speed"] == 5


def test_a_curve_beyond_the_limits_is_clamped_as_blender_does(extension, scene, picture, written):
    animated(extension, "stillwater.pictures[0].wind.gusts", 0, [(1, -1), (9, 3)])
    values = written()["wind"]["gusts"]["values"]
    assert values == [0, 0, 0, 0.5, 1, 1, 1, 1, 1]


def test_a_driver_is_followed_through_the_frames(scene, picture, written):
    driver = scene.driver_add("stillwater.pictures[0].wind.speed").driver
    driver.type, driver.expression = "SCRIPTED", "frame * 2"
    scene.frame_set(6)
    assert written()["wind"]["speed"]["values"] == [2, 4, 6, 8, 10, 12, 14, 16, 18]
    assert scene.frame_current == 6


def test_strips_are_followed_through_the_frames(extension, scene, picture, written):
    animated(extension, "stillwater.pictures[0].wind.speed", 0, [(1, 2), (9, 10)])
    data = scene.animation_data
    strip = data.nla_tracks.new().strips.new("gust", 3, data.action)
    strip.action_slot = data.action_slot
    data.action = None
    assert written()["wind"]["speed"]["values"] == [2, 2, 2, 3, 4, 5, 6, 7, 8]


def test_renaming_a_layer_breaks_nothing(extension, scene, picture, written):
    water = extension.properties.arrange.add_layer(picture, "water")
    picture.layers[0].motion.type = "bob"
    picture.layers[0].motion.bob.water = "water"
    picture.layers[0].follows.layer = "water"
    water.name = "lake"
    said = written()["layers"][0]
    assert (said["motion"]["water"], said["follows"]) == ("lake", {"layer": "lake", "mirror": False})


def test_names_are_unique(extension, scene, picture):
    for _ in range(2):
        extension.properties.arrange.add_layer(picture, "all")
    assert [layer.name for layer in picture.layers] == ["all", "all.001", "all.002"]
    picture.layers[2].name = "all.001"
    assert picture.layers[2].name == "all.002"
    assert len({layer.id for layer in picture.layers}) == 3
    assert extension.properties.arrange.add_picture(scene, "Lake").name == "Lake.001"


def test_names_as_long_as_they_may_be_are_unique_too(extension, scene, picture):
    arrange = extension.properties.arrange
    names = [arrange.add_picture(scene, "Ü" * 80).name for _ in range(3)]
    names += [extension.properties.arrange.add_layer(picture, "a" * 300).name for _ in range(3)]
    assert len(set(names)) == 6 and names[1].endswith(".001") and names[5].endswith(".002")


def test_keys_go_with_their_picture(extension, scene, picture, written):
    arrange = extension.properties.arrange
    second = arrange.add_picture(scene, "Second")
    animated(extension, "stillwater.pictures[0].wind.speed", 0, [(1, 2), (9, 3)])
    animated(extension, "stillwater.pictures[1].wind.speed", 0, [(1, 7), (9, 8)])
    assert second.name == "Second"
    arrange.remove_picture(scene, 0)
    assert written()["wind"]["speed"]["values"][0] == 7
    assert scene.stillwater.active() == scene.stillwater.pictures[0]


def test_a_path_is_relative_to_the_recipe(scene, picture, written, tmp_path):
    picture.picture = "//art/lake.png"
    assert written()["picture"] == "../../art/lake.png"
    picture.picture = str(tmp_path / "elsewhere.png")
    assert written()["picture"] == "../../elsewhere.png"


@pytest.mark.parametrize("value", [0.1, 0.6, 1 / 3, 1e-7, 123456.789, 40.0, 2**24 + 2.0])
def test_numbers_are_written_as_short_as_blender_keeps_them(picture, written, value):
    picture.layers[0].motion.type = "drift"
    drift = picture.layers[0].motion.drift
    drift.wind = min(value, 1000)
    said = written()["layers"][0]["motion"]["wind"]
    kept = drift.wind
    drift.wind = said
    assert drift.wind == kept and len(str(said)) <= 12


def test_the_frame_rate_is_the_scene_s(scene, picture, written):
    scene.render.fps, scene.render.fps_base = 24, 1.001
    assert written()["fps"] == pytest.approx(24 / 1.001, abs=1e-6)


def normal(recipe) -> dict:
    return msgspec.to_builtins(stillwater.parse(recipe).recipe)


def close(ours, theirs, place="recipe"):
    """Equal, numbers within what 32 bits hold; every difference names its place."""
    if isinstance(theirs, dict) and set(theirs) == {"first", "values"}:
        frames = range(-2, 20)
        held = lambda keys, f: keys["values"][min(max(f - keys["first"], 0), len(keys["values"]) - 1)]  # noqa: E731
        ours = ours if isinstance(ours, dict) else {"first": 0, "values": [ours]}
        close([held(ours, f) for f in frames[3:10]], [held(theirs, f) for f in frames[3:10]], place)
    elif isinstance(theirs, dict):
        assert set(ours) == set(theirs), place
        for name in theirs:
            close(ours[name], theirs[name], f"{place}.{name}")
    elif isinstance(theirs, list | tuple):
        assert len(ours) == len(theirs), place
        for i, (a, b) in enumerate(zip(ours, theirs, strict=True)):
            close(a, b, f"{place}[{i}]")
    elif isinstance(theirs, float):
        assert ours == pytest.approx(theirs, rel=1e-6), place
    else:
        assert ours == theirs, place


def test_a_recipe_that_was_opened_is_written_as_it_was(extension, scene, tmp_path):
    """Every field of the recipe reaches its property, and every property its field."""
    path = recipes.write(tmp_path / "made", recipes.whole())
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "made" / "file.blend"))
    bpy.ops.stillwater.load_recipe(filepath=str(path))
    picture = bpy.context.scene.stillwater.pictures[0]
    said = json.loads(open(extension.bake.job.write_recipe(bpy.context.scene, picture)).read())
    text = json.dumps(said).replace("../../", "")
    close(normal(json.loads(text)), normal(recipes.whole()))


def test_the_whole_recipe_uses_every_field_and_no_default():
    """What the test above rests on."""
    said = recipes.whole()
    for part, cls in (("wind", Wind), ("view", View), ("output", Output)):
        assert set(said[part]) == set(fields(cls))
    motions = {layer["motion"]["type"]: layer["motion"] for layer in said["layers"] if "motion" in layer}
    for name, cls in (("sway", Sway), ("ripple", Ripple), ("bob", Bob)):
        assert set(motions[name]) - {"type"} == set(fields(cls))
    assert set(said) == set(fields(Recipe))
    assert set().union(*said["layers"]) == set(fields(Layer))
    assert {"file", "channel"} == set(fields(FileMatte)) and {"labels", "value"} == set(fields(LabelMatte))
    plain = [value for cls in (Wind, View, Output, Sway, Ripple, Bob) for value in fields(cls).values()]
    spoken = [said["wind"], said["view"], said["output"], motions["sway"], motions["ripple"], motions["bob"]]
    assert [f.name for f in plain for part in spoken if f.name in part and part[f.name] == f.default] == []
