"""What a frame's key depends on: everything that the frame reads, and nothing else.

The table has a line for each field of the recipe that can be rendered; a test holds that none is missing.
"""

import copy

import pytest
from stillwater.recipe import parse
from stillwater.recipe.engines import MOTIONS
from stillwater.recipe.mattes import ExemplarFill, FileFill, Matte, NoFill
from stillwater.recipe.picture import Follows, Layer, Output, Recipe, View, Wind
from stillwater.render import keys as keys_module
from stillwater.render.keys import FrameKeys, stack_key
from stillwater.render.resolve import Timeline

FRAMES = range(1, 13)
ALL, NONE = set(FRAMES), set()
BOAT, REFLECTION, TREE, SEA, CLOUDS = (f"layers.{i}" for i in range(5))
BROOK, FIRE = "layers.6", "layers.7"


SCRIBBLES = {"foreground": [{"points": [[8, 20]]}], "background": [{"points": [[30, 5]]}]}
OUTLINE = [[2, 2], [14, 2], [14, 30], [2, 30]]


def key_list(recipe, digests=None, size=(48, 36), scale=1.0):
    recipe = parse(recipe).recipe
    names = ["picture.png", "labels.png", "tree.png", "other.png", "clip.mp4", "other.mp4"]
    digests = {name: name for name in names} | (digests or {})
    keys = FrameKeys(Timeline(recipe), stack_key(recipe, digests), size, scale, digests)
    return [keys.of(frame) for frame in FRAMES]


def changed(recipe, place, value, before=None):
    """The frames whose key changes when the field at `place` gets `value`."""
    other = copy.deepcopy(recipe)
    inside = other
    *way, last = place.split(".")
    for step in way:
        inside = inside[int(step)] if isinstance(inside, list) else inside.setdefault(step, {})
    if value is None:
        inside.pop(last, None)
    else:
        inside[int(last) if isinstance(inside, list) else last] = value
    pairs = zip(FRAMES, key_list(before or recipe), key_list(other), strict=True)
    return {frame for frame, a, b in pairs if a != b}


def keyed(start, *values):
    return {"first": start, "values": list(values)}


TABLE = [
    # place, value, frames that change
    ("picture", "other.png", ALL),
    ("colour_space", "linear", ALL),
    ("size", [48, 36], NONE),
    ("frames", [1, 200], NONE),
    ("fps", 25, ALL),
    ("seed", 8, ALL),
    ("loop", True, ALL),
    ("wind.speed", 9, ALL),
    ("wind.direction", 30, ALL),
    ("wind.gusts", 0.5, ALL),
    ("wind.gust_size", 0.5, ALL),
    ("wind.seed", 1, ALL),
    ("view.horizon", [[0, 16], [48, 18]], ALL),
    ("view.fov", 51, ALL),
    ("view.height", 2, ALL),
    ("output.folder", "elsewhere", NONE),
    ("output.name", "other", NONE),
    ("output.depth", "float", ALL),
    ("output.compression", "piz", ALL),
    ("output.layers", True, ALL),
    ("output.scale", 2, NONE),  # what counts is the scale that is rendered: another test
    # a layer
    (f"{TREE}.name", "bush", ALL),  # has noise
    (f"{CLOUDS}.name", "sky", NONE),  # has none
    (f"{TREE}.visible", False, ALL),
    (f"{TREE}.opacity", 0.5, ALL),
    (f"{TREE}.feather", 2, ALL),
    (f"{TREE}.follows", {"layer": "boat"}, ALL),
    (f"{REFLECTION}.follows.layer", "tree", ALL),
    (f"{REFLECTION}.follows.mirror", False, ALL),
    (f"{TREE}.matte", {"labels": "labels.png", "value": 0}, ALL),
    (f"{TREE}.matte.file", "other.png", ALL),
    (f"{TREE}.matte.channel", "R", ALL),
    (f"{TREE}.matte", {"trimap": "other.png"}, ALL),
    (f"{TREE}.matte", {"scribbles": SCRIBBLES}, ALL),
    (f"{TREE}.matte", {"lasso": OUTLINE}, ALL),
    (f"{BOAT}.matte.labels", "other.png", ALL),
    (f"{BOAT}.matte.value", 5, ALL),
    (f"{TREE}.fill", {"method": "none"}, ALL),
    (f"{TREE}.fill", {"file": "other.png"}, ALL),
    (f"{TREE}.fill", {"method": "exemplar"}, NONE),  # it is what it was
    (f"{TREE}.fill", {"method": "exemplar", "patch": 11}, ALL),
    (f"{TREE}.fill", {"method": "exemplar", "radius": 5}, ALL),
    (f"{TREE}.fill", {"method": "exemplar", "grow": 1}, ALL),
    (f"{TREE}.fill", {"method": "exemplar", "source": {"file": "other.png"}}, ALL),
    (f"{TREE}.fill", {"method": "exemplar", "touch_up": [{"stroke": {"points": [[1, 1]]}}]}, ALL),
    (f"{CLOUDS}.fill", {"method": "none"}, NONE),  # nothing is behind the last layer
    # motions
    (f"{TREE}.motion", {"type": "still"}, ALL),
    (f"{TREE}.motion.armature", [[8, 34], [8, 5]], ALL),
    (f"{TREE}.motion.frequency", 0.7, ALL),
    (f"{TREE}.motion.mass", 2, ALL),
    (f"{TREE}.motion.damping", 0.5, ALL),
    (f"{TREE}.motion.amount", 2, ALL),
    (f"{TREE}.motion.foreshortening", 0.5, ALL),
    (f"{TREE}.motion.shimmer", 0.5, ALL),
    (f"{TREE}.motion.seed", 3, ALL),
    (f"{SEA}.motion.amplitude", 2, ALL),
    (f"{SEA}.motion.roughness", 2, ALL),
    (f"{SEA}.motion.tile", 61, ALL),
    (f"{SEA}.motion.resolution", 32, ALL),
    (f"{SEA}.motion.mode", "normal", ALL),
    (f"{SEA}.motion.spectrum", "tma", ALL),
    (f"{SEA}.motion.fetch", 10, ALL),
    (f"{SEA}.motion.depth", 10, ALL),
    (f"{SEA}.motion.seed", 3, ALL),
    (f"{BOAT}.motion.waterline", [[20, 25], [31, 25]], ALL),
    (f"{BOAT}.motion.water", "pond", ALL),
    (f"{BOAT}.motion.amount", 2, ALL),
    (f"{CLOUDS}.motion.velocity", [0.7, 0.3], ALL),
    (f"{CLOUDS}.motion", {"type": "drift", "wind": 0.3}, ALL),
    (f"{BROOK}.motion.strokes", [{"points": [[9, 9], [1, 1]]}], ALL),
    (f"{BROOK}.motion.refine", {"width": 13}, ALL),
    (f"{BROOK}.motion.speed", 1.1, ALL),
    (f"{BROOK}.motion.period", 50, ALL),
    (f"{BROOK}.motion.freeze", [{"points": [[1, 1]]}], ALL),
    (f"{BROOK}.motion.outline", {"persistence": 0.5}, NONE),  # it stands still, whatever it would do
    (f"{BROOK}.motion.outline", {"moving": True}, ALL),
    (f"{FIRE}.motion.clip", "other.mp4", ALL),
    (f"{FIRE}.motion.clip_frames", [1, 20], ALL),
    (f"{FIRE}.motion.strokes", [{"points": [[9, 9], [1, 1]]}], ALL),
    (f"{FIRE}.motion.refine", {"width": 13}, ALL),
    (f"{FIRE}.motion.speed", 1.1, ALL),
    (f"{FIRE}.motion.freeze", [{"points": [[1, 1]]}], ALL),
    (f"{FIRE}.motion.outline", {"persistence": 0.5}, NONE),
    (f"{FIRE}.motion.outline", {"moving": True}, ALL),
    (f"{FIRE}.motion.life", 12, ALL),
    (f"{FIRE}.motion.shutter", 0.3, ALL),
    (f"{FIRE}.motion.average_blur", 4, ALL),
    (f"{FIRE}.motion.grid", [4, 4], ALL),
    (f"{FIRE}.motion.repetitions", 1, ALL),
    (f"{FIRE}.motion.matching", "laplacian", ALL),
    (f"{FIRE}.motion.transfer", {"patch": 24}, ALL),
    (f"{FIRE}.motion.clip_scale", 2, ALL),
    (f"{FIRE}.motion.clip_fps", 30, ALL),
    (f"{FIRE}.motion.clip_steady", True, ALL),
    (f"{FIRE}.motion.endless", False, ALL),
    (f"{FIRE}.motion.stylize", 0.5, ALL),
    (f"{FIRE}.motion.speed", keyed(8, 1, 2), {7, 8, 9, 10, 11, 12}),
    # keys: only where they change, and in the frame before, whose flow looks ahead
    ("wind.gusts", keyed(6, 0.4, 0.4, 0.9), {7, 8, 9, 10, 11, 12}),
    ("wind.speed", keyed(1, *[8] * 8, 9), {8, 9, 10, 11, 12}),
    (f"{TREE}.motion.amount", keyed(5, 3, 4, 3), {5, 6}),
    (f"{TREE}.opacity", keyed(4, 1, 0, 1), {4, 5}),
    (f"{CLOUDS}.motion.velocity", keyed(1, [0.7, 0.2], [0.7, 0.2], [0, 0], [0.7, 0.2]), ALL - {1}),
    (f"{BROOK}.motion.strokes.0.frame", 5, ALL),
    (f"{BROOK}.motion.period", 1e6, ALL),
]


@pytest.fixture
def wide(recipe):
    """The scene with more frames and a second sea."""
    recipe["frames"] = [1, 12]
    pond = {"name": "pond", "matte": {"labels": "labels.png", "value": 9}, "motion": {"type": "ripple", "seed": 4}}
    recipe["layers"].insert(5 - 1, pond)
    recipe["layers"][4], recipe["layers"][5] = recipe["layers"][5], recipe["layers"][4]
    recipe["layers"][4]["matte"] = {"labels": "labels.png", "value": 0}
    strokes = [{"points": [[1, 1], [9, 9]]}]
    brook = {"name": "brook", "matte": {"labels": "labels.png", "value": 8}, "motion": {"type": "flow", "strokes": strokes}}
    fire = {"name": "fire", "motion": {"type": "example", "clip": "clip.mp4", "strokes": strokes}}
    recipe["layers"] += [brook, fire]
    return recipe


@pytest.mark.parametrize("place, value, frames", TABLE, ids=[f"{place}={str(value)[:30]}" for place, value, _ in TABLE])
def test_a_field_changes_the_frames_that_read_it(wide, place, value, frames):
    if place == f"{CLOUDS}.fill":
        wide["layers"] = wide["layers"][:5]
        wide["layers"][0]["motion"]["water"] = "sea"
    assert changed(wide, place, value) == frames


@pytest.mark.parametrize(
    "matte, field, value",
    [
        ({"trimap": "tree.png"}, "trimap", "other.png"),
        ({"trimap": "tree.png"}, "method", "bayesian"),
        ({"scribbles": SCRIBBLES}, "scribbles", {**SCRIBBLES, "background": [{"points": [[31, 5]]}]}),
        ({"scribbles": SCRIBBLES}, "method", "bayesian"),
        ({"lasso": OUTLINE}, "lasso", [*OUTLINE, [1, 8]]),
        ({"lasso": OUTLINE}, "feather", 3),
        ({"lasso": OUTLINE}, "snap", 3),
        ({"lasso": OUTLINE}, "method", "bayesian"),
    ],
)
def test_a_field_of_a_matte_that_is_solved_changes_all_frames(wide, matte, field, value):
    wide["layers"][2]["matte"] = matte
    assert changed(wide, f"{TREE}.matte.{field}", value) == ALL


def test_the_table_names_every_field():
    wanted = {f"{name}" for name in Recipe.__struct_fields__} - {"stillwater", "wind", "view", "output", "layers"}
    for place, kind in (("wind", Wind), ("view", View), ("output", Output), ("layer", Layer), ("follows", Follows)):
        wanted |= {f"{place}.{name}" for name in kind.__struct_fields__}
    wanted |= {f"motion.{name}" for kind in MOTIONS for name in kind.__struct_fields__}
    wanted |= {f"matte.{name}" for kind in Matte.forms.values() for name in kind.__struct_fields__}
    named = set()
    for place, value, _ in TABLE:
        steps = [step for step in place.split(".") if not step.isdigit()]
        steps[0] = "layer" if steps[0] == "layers" else steps[0]
        named |= {".".join(steps[-2:]), steps[-1]}
        if steps[-1] in ("motion", "fill", "matte") and isinstance(value, dict):
            named |= {f"{steps[-1]}.{name}" for name in value}
    named |= {f"matte.{name}" for name in ("feather", "snap", "method")}  # in the test above
    assert wanted - named == set()
    fills = {name for kind in (ExemplarFill, FileFill, NoFill) for name in kind.__struct_fields__}
    assert {f"fill.{name}" for name in fills} - named == set()


def test_a_flow_reads_its_period_of_the_speed_and_no_more(wide):
    """A speed that changes later than half a period, and the two frames ahead, after the last frame changes nothing."""
    wide["layers"][6]["motion"]["period"] = 4
    steady = keyed(1, *[1.0] * 40)
    wide["layers"][6]["motion"]["speed"] = steady
    assert changed(wide, f"{BROOK}.motion.speed", keyed(1, *[1.0] * 20, 0.5)) == NONE
    assert changed(wide, f"{BROOK}.motion.speed", keyed(1, *[1.0] * 8, *[0.5] * 20)) == {6, 7, 8, 9, 10, 11, 12}


def test_strokes_keyed_in_time_change_the_frames_between_them(wide):
    def strokes(end):
        return [{"points": [[1, 1], [9, 9]], "frame": 4}, {"points": [[1, 1], [9, end]], "frame": 8}]

    wide["layers"][6]["motion"]["strokes"] = strokes(3)
    assert changed(wide, f"{BROOK}.motion.strokes", strokes(5)) == ALL - {1, 2, 3}


def test_the_contents_of_files_count_and_not_their_names(wide):
    renamed = copy.deepcopy(wide)
    renamed["picture"] = "other.png"
    assert key_list(wide) == key_list(renamed, {"other.png": "picture.png"})
    assert not set(key_list(wide)) & set(key_list(wide, {"picture.png": "painted over"}))


def test_size_and_scale_of_the_frames_count(wide):
    assert not set(key_list(wide)) & set(key_list(wide, scale=2.0))
    assert not set(key_list(wide)) & set(key_list(wide, size=(49, 36)))


def test_a_longer_range_keeps_its_frames_but_not_in_a_loop(wide):
    assert key_list(wide) == key_list({**wide, "frames": [1, 500]}) == key_list({**wide, "frames": [-20, 12]})
    assert not set(key_list({**wide, "loop": True})) & set(key_list({**wide, "loop": True, "frames": [1, 500]}))


def test_what_is_hidden_is_not_read(wide):
    hidden = copy.deepcopy(wide)
    hidden["layers"][2]["visible"] = False
    for field, value in (("frequency", 0.9), ("seed", 9), ("amount", keyed(1, 2, 3))):
        assert changed(hidden, f"{TREE}.motion.{field}", value) == NONE
    assert changed(hidden, f"{TREE}.name", "bush") == NONE
    assert changed(hidden, f"{TREE}.opacity", 0.2) == NONE


def test_what_a_seen_layer_stands_on_is_read_though_it_is_hidden(wide):
    wide["layers"][3]["visible"] = wide["layers"][0]["visible"] = False
    assert changed(wide, f"{SEA}.motion.amplitude", 2) == ALL  # through the boat, through its reflection
    assert changed(wide, f"{SEA}.opacity", 0.5) == NONE


def test_without_gusts_nothing_of_them_is_read(wide):
    wide["wind"] = {"speed": 8}
    assert changed(wide, "wind.gust_size", 0.7) == changed(wide, "wind.seed", 3) == NONE


def test_a_scene_without_wind_does_not_read_it(wide):
    still = {**wide, "layers": [{"name": "all", "motion": {"type": "drift", "velocity": [1, 0]}}]}
    for place, value in (("wind.speed", 3), ("fps", 12), ("seed", 2), ("view.fov", 90), ("wind.gusts", 1)):
        assert changed(still, place, value) == NONE


def test_a_reflection_reads_the_horizon_and_no_more_of_the_view(wide):
    tree = {**wide["layers"][2], "name": "tree"}
    mirror = {"name": "mirror", "matte": {"file": "other.png"}, "follows": {"layer": "tree", "mirror": True}}
    pond = {**wide, "layers": [tree, mirror, {"name": "wall"}]}
    assert changed(pond, "view.horizon", [[0, 10], [48, 12]]) == ALL
    assert changed(pond, "view.fov", 90) == changed(pond, "view.height", 9) == NONE


def test_names_count_where_they_are_written(wide):
    wide["output"] = {"layers": True}
    assert changed(wide, f"{REFLECTION}.name", "mirrored") == ALL


@pytest.mark.parametrize("engine", keys_module.ENGINES)
def test_a_new_version_of_an_engine_makes_its_frames_anew(wide, monkeypatch, engine):
    before = key_list(wide)
    monkeypatch.setitem(keys_module.ENGINES, engine, 99)
    assert not set(before) & set(key_list(wide))


def test_a_new_version_of_an_engine_that_is_not_used_changes_nothing(wide, monkeypatch):
    wide["layers"] = wide["layers"][2:3] + wide["layers"][6:7]
    before = key_list(wide)
    for engine in ("ripple", "bob", "drift"):
        monkeypatch.setitem(keys_module.ENGINES, engine, 99)
    assert key_list(wide) == before
