"""Why a frame is out of date: each field of the recipe is named by the part that it stands in."""

import copy

import pytest
from stillwater.recipe import load, parse
from stillwater.render.keys import ENGINES, FrameKeys, stack_key
from stillwater.render.loop import Order, render
from stillwater.render.reads import Reads, mark, read_mark, reasons
from stillwater.render.resolve import Timeline

BOAT, REFLECTION, TREE, SEA, CLOUDS = (f"layers.{i}" for i in range(5))
FILES = {name: name for name in ("picture.png", "labels.png", "tree.png", "other.png")}


def reads_of(recipe, scale=1.0):
    timeline = Timeline(parse(recipe).recipe)
    return Reads(timeline, FILES, FrameKeys(timeline, stack_key(timeline.recipe, FILES), (48, 36), scale, FILES).fixed)


def set_at(recipe, place, value):
    other = copy.deepcopy(recipe)
    inside = other
    *way, last = place.split(".")
    for step in way:
        inside = inside[int(step)] if isinstance(inside, list) else inside.setdefault(step, {})
    inside[last] = value
    return other


def why(before, now, frame=3, **how):
    return reasons(reads_of(before).of(frame), reads_of(now, **how).of(frame))


TABLE = [
    ("picture", "other.png", ["picture changed"]),
    ("colour_space", "linear", ["picture changed"]),
    ("fps", 25, ["frame rate or loop changed"]),
    ("loop", True, ["frame rate or loop changed"]),
    ("seed", 8, ["seed changed"]),
    ("wind.speed", 9, ["wind changed"]),
    ("wind.direction", 30, ["wind changed"]),
    ("wind.gusts", 0.5, ["wind changed"]),
    ("wind.gust_size", 0.5, ["wind changed"]),
    ("wind.seed", 1, ["wind changed"]),
    ("view.fov", 51, ["view changed"]),
    ("output.depth", "float", ["output settings changed"]),
    ("output.layers", True, ["output settings changed"]),
    ("output.folder", "elsewhere", ["something it reads changed"]),
    (f"{TREE}.feather", 2, ["matte of tree changed"]),
    (f"{TREE}.matte.file", "other.png", ["matte of tree changed"]),
    (f"{BOAT}.matte.value", 5, ["matte of boat changed"]),
    (f"{TREE}.fill", {"method": "none"}, ["fill of tree changed"]),
    (f"{TREE}.opacity", 0.5, ["visibility of tree changed"]),
    (f"{TREE}.visible", False, ["visibility of tree changed"]),
    (f"{TREE}.motion.amount", 2, ["motion of tree changed"]),
    (f"{TREE}.motion.seed", 2, ["motion of tree changed"]),
    (f"{SEA}.motion.tile", 61, ["motion of sea changed"]),
    (f"{BOAT}.motion.amount", 2, ["motion of boat changed"]),
    (f"{REFLECTION}.follows.mirror", False, ["motion of reflection changed"]),
    (f"{CLOUDS}.motion.velocity", [0.7, 0.3], ["motion of clouds changed"]),
    (f"{TREE}.name", "bush", ["layer bush was added", "layer tree was removed"]),
]


@pytest.mark.parametrize("place, value, clauses", TABLE, ids=[f"{place}={str(value)[:20]}" for place, value, _ in TABLE])
def test_a_field_is_named_by_its_part(recipe, place, value, clauses):
    assert why(recipe, set_at(recipe, place, value)) == clauses


def test_clouds_that_go_with_the_wind_name_the_wind(recipe):
    recipe["layers"] = [{"name": "clouds", "motion": {"type": "drift", "wind": 0.5}}]
    assert why(recipe, set_at(recipe, "wind.speed", 3)) == ["wind changed"]
    assert why(recipe, set_at(recipe, "layers.0.motion.wind", 0.6)) == ["motion of clouds changed"]


def test_a_layer_in_front_does_not_make_the_others_look_changed(recipe):
    front = {**copy.deepcopy(recipe["layers"][2]), "name": "bush"}
    assert why(recipe, {**recipe, "layers": [front, *recipe["layers"]]}) == ["layer bush was added"]
    swapped = [*recipe["layers"][1:3], recipe["layers"][0], *recipe["layers"][3:]]
    assert why(recipe, {**recipe, "layers": swapped}) == ["order of the layers changed"]


def test_size_scale_and_engine_are_named(recipe, monkeypatch):
    assert why(recipe, recipe, scale=2.0) == ["output settings changed"]
    before = reads_of(recipe).of(3)
    monkeypatch.setitem(ENGINES, "sway", 99)
    assert reasons(before, reads_of(recipe).of(3)) == ["the engine is another version"]


def test_a_frame_that_says_nothing_was_made_by_something_else(recipe):
    assert reasons({}, reads_of(recipe).of(3)) == ["made by something else"]


def test_a_frame_on_disk_says_what_it_read(scene, tmp_path):
    document = load(scene())
    list(render(document, Order(frames=(2, 2))))
    key, parts = read_mark(tmp_path / "frames" / "frame_0002.exr")
    assert len(key) == 32 and parts["layers"].keys() == {"boat", "reflection", "tree", "sea", "clouds"}
    assert read_mark(tmp_path / "frames" / "frame_0003.exr") == ("", {})
    assert mark(key, parts).startswith(f"{key} {{")
