"""What a layer misses is said before the engine has to: every sentence, and none where the engine is content."""

import importlib

import bpy
import pytest
import recipes
import stillwater
from layered import now, said
from pixels import PACKAGE

missing = importlib.import_module(f"{PACKAGE}.layers.missing")


@pytest.fixture
def whole(extension, scene, tmp_path):
    """A picture that the engine accepts: one layer of each motion."""
    recipes.write(tmp_path, recipes.whole())
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.stillwater.load_recipe(filepath=str(tmp_path / "recipe.json"))
    return now()


def named(name: str):
    return next(layer for layer in now().layers if layer.name == name)


def everything() -> list[str]:
    return [sentence for i in range(len(now().layers)) for sentence in missing.of(now(), i, set())]


def test_nothing_is_missing_in_a_whole_picture(extension, whole):
    assert everything() == []
    assert stillwater.parse(said(extension))


def no_line():
    named("tree").motion.sway.armature_tip = named("tree").motion.sway.armature_root


def no_points():
    for _ in range(2):
        named("boat").motion.bob.waterline.remove(0)


def no_matte():
    named("tree").matte.form = "none"


def no_matte_file():
    named("tree").matte.file = ""


def no_labels():
    named("lake").matte.labels = ""


def no_background():
    named("tree").fill.file = ""


def no_horizon():
    now().view.use_horizon = False


def degenerate_horizon():
    now().view.horizon_end = now().view.horizon_start


def no_water():
    named("boat").motion.bob.water = ""


def wrong_water():
    named("boat").motion.bob.water = "tree"


def no_water_at_all():
    named("lake").motion.type = "still"


SENTENCES = {
    no_line: "Draw its sway line, from where it is held to its tip",
    no_points: "Draw its waterline, along the hull where it meets the water",
    no_matte: "Draw on it with Foreground, or choose its matte: which part of the picture it is",
    no_matte_file: "Choose the file of its matte",
    no_labels: "Choose the file of its matte",
    no_background: "Choose the file that is painted behind it",
    no_horizon: "Draw the horizon, or turn it on in View",
    degenerate_horizon: "Draw the horizon, or place its two ends in View",
    no_water: "Choose the water it floats on",
    wrong_water: "Choose the water it floats on",
    no_water_at_all: "Add a layer with Ripple: the water it floats on",
}


@pytest.mark.parametrize("take", SENTENCES, ids=lambda take: take.__name__)
def test_what_is_missing_is_said_where_the_engine_would_refuse(extension, whole, take):
    take()
    assert everything() == [SENTENCES[take]]
    if "file" in SENTENCES[take]:
        return  # an empty path is the recipe's folder: found only when the engine opens it
    with pytest.raises(stillwater.RecipeError):
        stillwater.parse(said(extension))


CIRCLE = ["Choose another layer to follow: that one follows this one"]


@pytest.mark.parametrize("other, sentences", [("clouds", CIRCLE * 2),
                                              ("boat", ["Choose other water: that one follows this layer", *CIRCLE])])
def test_layers_that_move_with_each_other_are_told(extension, whole, other, sentences):
    named("lake").follows.layer = other
    if other == "clouds":
        named("clouds").follows.layer, named("boat").motion.type = "lake", "still"
    assert everything() == sentences
    with pytest.raises(stillwater.RecipeError, match="circle"):
        stillwater.parse(said(extension))


def test_a_horizon_that_is_turned_on_lies_in_the_middle_until_it_is_placed(picture):
    view, picture.picture_size = picture.view, (640, 400)
    view.use_horizon = True
    assert (tuple(view.horizon_start), tuple(view.horizon_end)) == ((0, 200), (640, 200))
    view.horizon_start, view.use_horizon = (0, 100), False
    view.use_horizon = True
    assert tuple(view.horizon_start) == (0, 100)


def test_the_view_says_that_water_needs_a_horizon(picture):
    from panels import draw, registered

    view = next(cls for cls in registered("view_3d") if cls.bl_label == "View")
    assert draw(view).texts == []
    picture.layers[0].motion.type = "ripple"
    assert " ".join(draw(view).texts) == "Draw the horizon, or turn it on"
