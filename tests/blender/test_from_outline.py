"""A layer from one line around it: named, cut out, moving."""

import importlib

import bpy
import cutting
import numpy as np
import pytest
import stillwater
from layered import now, said
from pixels import PACKAGE

draw_mode = importlib.import_module(f"{PACKAGE}.strokes.draw_mode")
missing = importlib.import_module(f"{PACKAGE}.layers.missing")
placing = importlib.import_module(f"{PACKAGE}.layers.placing")
preset_files = importlib.import_module(f"{PACKAGE}.layers.preset_files")
SQUARE = [[10.0, 20.0], [50.0, 20.0], [50.0, 60.0], [10.0, 60.0]]


@pytest.fixture
def picture(scene, tmp_path):
    picture = cutting.open_picture(scene, tmp_path)
    bpy.ops.stillwater.remove_layer()
    return picture


def preset(kind: str) -> str:
    return str(preset_files.paths(kind)[0])


def begin(kind: str) -> None:
    called = bpy.ops.stillwater.layer_from_outline("EXEC_DEFAULT", True, motion=kind, preset=preset(kind))
    assert called == {"FINISHED"}


def draw_outline() -> None:
    picture = now()
    cutting.lay(bpy.context.scene, picture, picture.layers[picture.active_layer], outline=cutting.corners(picture, 1.02))


@pytest.mark.parametrize("kind", ["sway", "ripple", "drift"])
def test_one_line_makes_a_layer_that_moves(extension, picture, kind):
    begin(kind)
    assert bpy.context.mode == "PAINT_GREASE_PENCIL" and draw_mode.tick() == draw_mode.INTERVAL
    draw_outline()
    assert draw_mode.tick() is None and bpy.context.mode == "OBJECT"
    layer = now().layers[0]
    assert (layer.name, layer.matte.form, layer.motion.type) == (preset_files.name_of(preset(kind)), "lasso", kind)
    drawn = extension.strokes.replaced(bpy.context.scene, now(), layer)
    assert missing.of(now(), 0, drawn) == [] and stillwater.parse(said(extension))
    assert [each.name for each in now().layers] == [layer.name, "Background"]


def test_a_boat_gets_its_waterline_and_says_that_it_needs_water(extension, picture):
    begin("bob")
    draw_outline()
    assert bpy.ops.stillwater.stop_drawing("EXEC_DEFAULT", True) == {"FINISHED"}  # or by the button
    layer = now().layers[0]
    (x0, y0), (x1, y1) = (point.place for point in layer.motion.bob.waterline)
    assert y0 == y1 > 90 and x0 < 160 < x1
    drawn = extension.strokes.replaced(bpy.context.scene, now(), layer)
    assert missing.of(now(), 0, drawn) == ["Add a layer with Ripple: the water it floats on"]


def test_what_is_there_already_stays(extension, picture):
    picture.view.use_horizon, picture.view.horizon_start, picture.view.horizon_end = True, (0, 7), (320, 9)
    begin("ripple")
    draw_outline()
    draw_mode.tick()
    assert (*now().view.horizon_start, *now().view.horizon_end) == (0, 7, 320, 9)


def test_undo_takes_it_away_step_by_step(picture):
    bpy.ops.ed.undo_push(message="before")
    begin("sway")
    draw_outline()
    bpy.ops.ed.undo_push(message="stroke")
    draw_mode.tick()
    assert now().layers[0].motion.sway.armature_tip[1] < now().layers[0].motion.sway.armature_root[1]
    for _ in range(3):
        bpy.ops.ed.undo()
    assert [layer.name for layer in now().layers] == ["Background"] and bpy.context.mode == "OBJECT"
    assert draw_mode.tick() is None


def test_left_without_a_line_the_panel_asks_for_one(extension, picture):
    begin("sway")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert draw_mode.tick() is None
    assert missing.of(now(), 0, set())[0] == "Press Outline and draw once around it"


def test_a_picture_without_a_place_says_so(extension, scene, tmp_path):
    with pytest.raises(RuntimeError, match="has no Stillwater picture yet"):
        bpy.ops.stillwater.layer_from_outline()
    extension.properties.arrange.add_picture(scene, "Bare")
    with pytest.raises(RuntimeError, match="has no plane in the scene"):
        bpy.ops.stillwater.layer_from_outline()


def test_a_preset_that_is_not_there_is_a_sentence(picture):
    with pytest.raises(RuntimeError, match="there is no such preset"):
        bpy.ops.stillwater.layer_from_outline(preset="/none.json")
    assert len(now().layers) == 1


def test_hidden_strokes_leave_no_layer_behind(picture):
    bpy.context.view_layer.layer_collection.children[0].exclude = True
    with pytest.raises(RuntimeError, match="show its collection to draw"):
        bpy.ops.stillwater.layer_from_outline(motion="sway")
    assert len(now().layers) == 1


def test_where_a_motion_would_be():
    assert placing.sway_line(SQUARE) == ([30, 60], [30, 20])
    assert placing.waterline(SQUARE) == [[10, 54], [50, 54]]
    assert placing.horizon(SQUARE, 320) == [[0, 20], [320, 20]]
    turns = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    leaning = [[100 + 20 * np.cos(a) - 0.5 * 60 * np.sin(a), 100 + 60 * np.sin(a)] for a in turns]  # upper end to the right
    (root_x, root_y), (tip_x, tip_y) = placing.sway_line(leaning)
    assert root_x < 90 and tip_x > 110 and root_y > 155 and tip_y < 45
