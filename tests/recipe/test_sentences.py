"""Every way in which a recipe can be wrong has its sentence: the place, what was given, what is allowed."""

import copy
import json
import math

import pytest
from stillwater.recipe import RecipeError, parse

RIGHT = {
    "stillwater": 1,
    "picture": "picture.png",
    "frames": [1, 10],
    "view": {"horizon": [[0, 20], [100, 20]]},
    "layers": [
        {"name": "tree", "matte": {"file": "tree.png"}, "motion": {"type": "sway", "armature": [[5, 60], [5, 10]]}},
        {"name": "boat", "matte": {"labels": "l.png", "value": 2},
         "motion": {"type": "bob", "waterline": [[30, 50], [50, 50]], "water": "sea"}},
        {"name": "cloud", "matte": {"file": "cloud.png"}, "motion": {"type": "drift"}},
        {"name": "sea", "matte": {"file": "sea.png"}, "motion": {"type": "ripple"}},
        {"name": "sky"},
    ],
}
TREE, BOAT, CLOUD, SEA, SKY = (("layers", i) for i in range(5))
MISSING = object()
FLOW = {"type": "flow", "strokes": [{"points": [[1, 1], [9, 9]]}]}
ANIMATED = '{"first": FRAME, "values": [one a frame]}'
LINE = "a line from a point to itself is not a line with two different ends"


def wrong(way, value):
    recipe = copy.deepcopy(RIGHT)
    inside = recipe
    for step in way[:-1]:
        inside = inside.setdefault(step, {}) if isinstance(inside, dict) else inside[step]
    if value is MISSING:
        del inside[way[-1]]
    else:
        inside[way[-1]] = value
    return recipe


SENTENCES = [
    # the forms of a field
    (("stillwater",), 2, "stillwater: 2 is not 1"),
    (("stillwater",), MISSING, "stillwater: missing"),
    (("frames",), MISSING, "frames: missing"),
    (("picture",), MISSING, "picture: missing (only a recipe of nothing but keyframes layers needs none)"),
    (("picture",), 7, "picture: 7 is not a text or null"),
    (("picture",), "", "picture: 0 characters are not 1 or more"),
    (("pictur",), "a", "pictur: no such field (did you mean picture? allowed: stillwater, picture, colour_space, size,"
                       " frames, fps, seed, loop, wind, view, layers, output)"),
    (("wind", "zzz"), 1, "wind.zzz: no such field (allowed: speed, direction, gusts, gust_size, seed)"),
    (("loop",), 1, "loop: 1 is not true or false"),
    (("wind",), 3, "wind: 3 is not an object"),
    (("colour_space",), "rgb", 'colour_space: "rgb" is not "auto", "linear" or "srgb"'),
    # numbers
    ((*TREE, "motion", "frequency"), 0, "layers[0].motion.frequency: 0 is not above 0 (Hz)"),
    ((*TREE, "motion", "frequency"), 1000, "layers[0].motion.frequency: 1000 is not at most 100 (Hz)"),
    ((*TREE, "motion", "frequency"), "fast",
     f'layers[0].motion.frequency: "fast" is not a number or {ANIMATED} (Hz)'),
    ((*TREE, "motion", "frequency"), math.nan, "layers[0].motion.frequency: NaN is not a finite number (Hz)"),
    ((*TREE, "motion", "frequency"), math.inf, "layers[0].motion.frequency: Infinity is not a finite number (Hz)"),
    ((*TREE, "motion", "frequency"), {"first": 1, "values": [1, -1]},
     "layers[0].motion.frequency.values[1]: -1 is not above 0 (Hz)"),
    ((*TREE, "motion", "frequency"), {"first": 1, "values": []},
     "layers[0].motion.frequency.values: 0 entries are not 1 or more"),
    ((*TREE, "motion", "frequency"), {"first": 1}, "layers[0].motion.frequency.values: missing"),
    (("wind", "speed"), 41, "wind.speed: 41 is not between 0 and 40 (m/s)"),
    (("wind", "speed"), True, f"wind.speed: true is not a number or {ANIMATED} (m/s)"),
    (("seed",), -1, "seed: -1 is not between 0 and 9007199254740992"),
    (("seed",), 1.5, "seed: 1.5 is not a whole number"),
    (("fps",), 0, "fps: 0 is not above 0 (1/s)"),
    (("size",), [0, 10], "size[0]: 0 is not between 1 and 16384 (px)"),
    (("size",), [30000, 30000], "size[0]: 30000 is not between 1 and 16384 (px)\n"
                                "size[1]: 30000 is not between 1 and 16384 (px)"),
    (("output", "scale"), 0, "output.scale: 0 is not between 0.001 and 16"),
    ((*TREE, "motion", "armature", 1, 0), 1e99,
     "layers[0].motion.armature[1][0]: 1e+99 is not between -1000000 and 1000000 (px)"),
    # lists and places
    (("frames",), [1], "frames: [1] is not a list of 2"),
    (("frames",), [10, 1], "frames: [10, 1] runs backwards (the first is not above the last)"),
    (("layers",), [], "layers: 0 entries are not 1 or more"),
    (("layers",), {}, "layers: {} is not a list"),
    ((*TREE, "motion", "armature"), [[5, 5], [5, 5]], f"layers[0].motion.armature: {LINE}"),
    ((*TREE, "motion", "armature"), [[5, 5]], "layers[0].motion.armature: [[5, 5]] is not a list of 2"),
    (("view", "horizon"), [[1, 1], [1, 1]], f"view.horizon: {LINE}"),
    (("view", "horizon"), MISSING, "view.horizon: missing (layers[3].motion, a ripple, needs it)"),
    ((*BOAT, "motion", "waterline"), [[30, 50]], "layers[1].motion.waterline: 1 entry is not 2 or more"),
    ((*BOAT, "motion", "waterline"), [[30, 50], [30, 50]],
     "layers[1].motion.waterline: one point is not a line with two different ends"),
    # layers and what they need
    ((*TREE, "name"), "boat", 'layers[1].name: "boat" is the name of layers[0] already (names are unique)'),
    ((*TREE, "matte"), MISSING, "layers[0].matte: missing (only the last layer needs none)"),
    ((*TREE, "follows"), {"layer": "bush"}, 'layers[0].follows.layer: "bush" is not a layer (there are tree, boat, cloud, sea, sky)'),
    ((*TREE, "follows"), {"layer": "tree"}, "layers[0]: depends on itself in a circle (tree -> tree)"),
    ((*SEA, "follows"), {"layer": "boat"}, "layers[1]: depends on itself in a circle (boat -> sea -> boat)"),
    ((*BOAT, "motion", "water"), "sky", 'layers[1].motion.water: "sky" is not a ripple layer (there is sea)'),
    ((*BOAT, "motion", "water"), "pond", 'layers[1].motion.water: "pond" is not a ripple layer (there is sea)'),
    ((*BOAT, "motion", "water"), MISSING, "layers[1].motion.water: missing"),
    ((*CLOUD, "motion"), {"type": "drift", "velocity": [1, 0], "wind": 1},
     "layers[2].motion: velocity and wind are both given (only one of them can hold)"),
    ((*CLOUD, "motion"), {"type": "drift", "velocity": 3},
     f"layers[2].motion.velocity: 3 is not a list of 2 or {ANIMATED} or null (px/frame)"),
    ((*SEA, "motion", "resolution"), 100,
     "layers[3].motion.resolution: 100 is not 16, 32, 64, 128, 256, 512, 1024 or 2048"),
    ((*SEA, "motion", "tile"), 5, "layers[3].motion.tile: 5 is not between 10 and 2000 (m)"),
    # forms
    ((*SKY, "motion"), {"type": "fly"}, 'layers[4].motion.type: "fly" is not "bob", "drift", "example", "flow",'
                                        ' "keyframes", "library", "ripple", "still" or "sway"'),
    ((*SKY, "motion"), {}, 'layers[4].motion.type: missing (one of "still", "sway", "ripple", "bob", "drift", "flow",'
                           ' "example", "library", "keyframes")'),
    ((*SKY, "motion"), 3, "layers[4].motion: 3 is not an object"),
    ((*TREE, "matte"), {"paint": 1}, "layers[0].matte: has none of the fields file, labels, trimap, scribbles, lasso,"
                                     " one of which says its form"),
    ((*TREE, "matte"), "tree.png", 'layers[0].matte: "tree.png" is not an object or null'),
    ((*TREE, "matte"), {"labels": "l.png"}, "layers[0].matte.value: missing"),
    ((*TREE, "matte"), {"labels": "l.png", "value": 0.5}, "layers[0].matte.value: 0.5 is not a whole number"),
    ((*TREE, "fill"), {"method": "magic"}, 'layers[0].fill.method: "magic" is not "exemplar" or "none"'),
    ((*TREE, "fill"), {"method": "exemplar", "patch": 8}, "layers[0].fill.patch: 8 is not odd (px)"),
    ((*TREE, "matte"), {"trimap": "t.png", "method": "knn"},
     'layers[0].matte.method: "knn" is not "bayesian" or "closed-form"'),
    ((*TREE, "matte"), {"lasso": [[0, 0], [9, 0]]}, "layers[0].matte.lasso: 2 entries are not 3 or more"),
    ((*TREE, "fill"), {"method": "exemplar", "source": {"file": 3}}, "layers[0].fill.source.file: 3 is not a text"),
    (("output", "name"), "a/b", 'output.name: "a/b" is not a file name'),
    # flows
    ((*SKY, "motion"), {"type": "flow"},
     "layers[4].motion.strokes: none; where does the layer flow? (at least one is needed)"),
    ((*SKY, "motion"), {"type": "flow", "strokes": [{"points": [[1, 1]], "kind": "speed"}]},
     'layers[4].motion.strokes: none says where the layer flows (kind "orientation" or "both", alpha above 0)'),
    ((*SKY, "motion"), {"type": "flow", "strokes": [{"points": [[1, 1], [9, 9]], "frame": 1}, {"points": [[1, 1], [9, 9]], "alpha": 0, "frame": 7}]},
     'layers[4].motion.strokes: none at frame 7 says where the layer flows (kind "orientation" or "both", alpha above 0)'),
    ((*SKY, "motion"), {**FLOW, "period": 0}, "layers[4].motion.period: 0 is not above 0 (frames)"),
    # what has no engine yet
    ((*SKY, "motion"), {"type": "example", "clip": "c.mp4"},
     "layers[4].motion.strokes: none; where does the layer flow? (at least one is needed)"),
    ((*SKY, "motion"), {"type": "library", "library": "l"},
     'layers[4].motion.type: "library" has no engine yet (these have: still, sway, ripple, bob, drift, flow, example)'),
    ((*SKY, "motion"), {"type": "keyframes", "keys": [{"frame": 1, "file": "k.png"}], "guide": {"strokes": []}},
     'layers[4].motion.type: "keyframes" has no engine yet (these have: still, sway, ripple, bob, drift, flow, example)'),
]


def ids(case):
    return "-".join(map(str, case[0])) + f"={str(case[1])[:30]}"


def test_the_right_one_is_right():
    assert [layer.name for layer in parse(RIGHT).recipe.layers] == ["tree", "boat", "cloud", "sea", "sky"]


@pytest.mark.parametrize("way, value, sentence", SENTENCES, ids=map(ids, SENTENCES))
def test_sentence(way, value, sentence):
    with pytest.raises(RecipeError) as raised:
        parse(json.dumps(wrong(way, value)))
    assert str(raised.value) == sentence


def test_a_flow_neither_follows_nor_is_followed():
    recipe = wrong((*CLOUD, "motion"), FLOW)
    recipe["layers"][2]["follows"] = {"layer": "tree"}
    recipe["layers"][0]["follows"] = {"layer": "cloud"}
    with pytest.raises(RecipeError) as raised:
        parse(recipe)
    assert list(raised.value.problems[:2]) == [
        'layers[0].follows.layer: "cloud" is not a layer that can be followed (it flows)',
        "layers[2].follows: a layer that flows follows no other",
    ]


@pytest.mark.parametrize(
    "text, sentence",
    [
        ("", "recipe: the file is empty"),
        (" \n", "recipe: the file is empty"),
        ("{", "recipe: not JSON (line 1, column 2: Expecting property name enclosed in double quotes)"),
        ('{\n "a": }', "recipe: not JSON (line 2, column 7: Expecting value)"),
        (b"\xff\xfe{", "recipe: not JSON (not UTF-8)"),
        ("[]", "recipe: [] is not an object"),
        ("[" * 100_000, "recipe: not JSON (nested too deep)"),
    ],
)
def test_not_a_recipe_at_all(text, sentence):
    with pytest.raises(RecipeError) as raised:
        parse(text)
    assert str(raised.value) == sentence


def test_a_dictionary_is_checked_like_a_file():
    with pytest.raises(RecipeError, match="NaN is not a finite number"):
        parse(wrong((*TREE, "motion", "frequency"), math.nan))


def test_all_problems_come_at_once():
    recipe = wrong(("wind", "speed"), -1)
    recipe["layers"][0]["motion"]["mass"] = 0
    with pytest.raises(RecipeError) as raised:
        parse(recipe)
    assert len(raised.value.problems) == 2
