"""A role's button: draw mode and back, other roles for strokes, and what becomes of the recipe."""

import importlib
import json
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from drawings import draw, lay_out, on_plane, store
from mathutils import Vector
from panels import Recorder, registered
from panels import draw as show
from pixels import PACKAGE

gp_layers = importlib.import_module(f"{PACKAGE}.strokes.gp_layers")
draw_mode = importlib.import_module(f"{PACKAGE}.strokes.draw_mode")
read = importlib.import_module(f"{PACKAGE}.strokes.read")
roles = importlib.import_module(f"{PACKAGE}.strokes.roles")

SWAY, WATERLINE, HORIZON = (roles.by_key(key) for key in ("sway_line", "waterline", "horizon"))


@pytest.fixture
def layers(scene, picture, extension):
    """Oak sways, Boat bobs; Oak is active. Nothing of them is drawn but their motions."""
    lay_out(scene, picture)
    for name, motion in (("Oak", "sway"), ("Boat", "bob")):
        extension.properties.arrange.add_layer(picture, name).motion.type = motion
    for layer in picture.layers:
        layer.matte.form, layer.matte.file, layer.fill.method = "file", "//matte.png", "none"
    picture.active_layer = 1
    return picture.layers


def settings(scene):
    tools = scene.tool_settings
    return tools.gpencil_stroke_placement_view3d, tools.gpencil_sculpt.lock_axis, tools.use_keyframe_insert_auto


def status() -> str:
    return draw_mode.hint(bpy.context.scene)


def test_its_button_leads_into_draw_mode(scene, picture, layers):
    scene.frame_set(7)
    assert bpy.ops.stillwater.draw_stroke(role="sway_line") == {"FINISHED"}
    gp = picture.strokes.data
    assert bpy.context.mode == "PAINT_GREASE_PENCIL" and bpy.context.object == picture.strokes
    assert gp.layers.active.name == "Oak · Sway Line"
    assert [key.frame_number for key in gp.layers.active.frames] == [scene.frame_start] == [5]
    assert picture.strokes.active_material.name == "Stillwater Sway Line"
    assert settings(scene) == ("ORIGIN", "AXIS_Z", False)
    tool = bpy.context.workspace.tools.from_space_view3d_mode("PAINT_GREASE_PENCIL")
    assert tool.idname == "stillwater.stroke" and tool.use_brushes
    assert status() == f"Sway Line of Oak: {SWAY.hint}" and bpy.app.timers.is_registered(draw_mode.tick)


def test_done_leads_back(scene, picture, layers):
    scene.tool_settings.gpencil_stroke_placement_view3d = "SURFACE"
    scene.tool_settings.gpencil_sculpt.lock_axis = "CURSOR"
    scene.tool_settings.use_keyframe_insert_auto = True
    assert not bpy.ops.stillwater.stop_drawing.poll()
    bpy.ops.stillwater.draw_stroke(role="horizon")
    bpy.ops.stillwater.draw_stroke(role="sway_line")  # from one to the other
    assert settings(scene)[2] is False
    assert bpy.ops.stillwater.stop_drawing() == {"FINISHED"}
    assert bpy.context.mode == "OBJECT" and settings(scene) == ("SURFACE", "CURSOR", True)
    assert status() == "" and draw_mode.tick() is None


class Viewport:
    """Stands for one that was drawn: only then Blender tells whether it shows the shelf of brushes."""

    def __init__(self):
        self.spaces, self.show_region_asset_shelf, self.drawn = SimpleNamespace(active=self), True, True

    def is_property_readonly(self, name) -> bool:
        return not self.drawn


@pytest.fixture
def viewport(monkeypatch):
    viewport = Viewport()
    monkeypatch.setattr(draw_mode, "_viewports", lambda scene: [(None, viewport)])
    return viewport


def draw_sway_line() -> None:
    """Into draw mode, by an undo step, until the timer comes."""
    bpy.ops.stillwater.draw_stroke("EXEC_DEFAULT", True, role="sway_line")
    draw_mode.tick()


@pytest.mark.parametrize("before", [True, False])
def test_brushes_do_not_lie_over_the_picture_meanwhile(scene, picture, layers, viewport, before):
    viewport.show_region_asset_shelf = before
    draw_sway_line()
    assert not viewport.show_region_asset_shelf
    bpy.ops.stillwater.stop_drawing()
    assert viewport.show_region_asset_shelf == before


def test_whoever_opens_the_brushes_has_them(scene, picture, layers, viewport):
    draw_sway_line()
    viewport.show_region_asset_shelf = True
    draw_mode.look_after()
    draw_mode.tick()
    assert viewport.show_region_asset_shelf
    bpy.ops.stillwater.stop_drawing()
    assert viewport.show_region_asset_shelf


def test_a_viewport_that_was_not_drawn_yet_is_waited_for(scene, picture, layers, viewport):
    viewport.drawn = False
    draw_sway_line()
    assert viewport.show_region_asset_shelf
    viewport.drawn = True
    draw_mode.tick()
    assert not viewport.show_region_asset_shelf


def test_brushes_come_back_after_undo_and_blender_s_own_ways(scene, picture, layers, viewport, tmp_path):
    bpy.ops.ed.undo_push(message="Before")
    draw_sway_line()
    bpy.ops.ed.undo()
    assert viewport.show_region_asset_shelf
    bpy.ops.ed.redo()
    draw_mode.tick()
    assert not viewport.show_region_asset_shelf
    bpy.ops.object.mode_set(mode="OBJECT")
    draw_mode.tick()
    assert viewport.show_region_asset_shelf
    draw_sway_line()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "meanwhile.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "meanwhile.blend"))
    draw_mode.tick()
    assert not viewport.show_region_asset_shelf
    bpy.ops.stillwater.stop_drawing()
    assert viewport.show_region_asset_shelf


def test_the_status_bar_is_left_to_others(scene, picture, layers, monkeypatch):
    """It gets the hint, is cleared once, and not touched where nothing was drawn."""
    texts = []
    monkeypatch.setattr(bpy.types.WorkSpace, "status_text_set", lambda self, text: texts.append(text))
    draw_mode.look_after()
    assert texts == []
    bpy.ops.stillwater.draw_stroke(role="sway_line")
    bpy.ops.stillwater.stop_drawing()
    draw_mode.look_after()
    assert texts == [f"Sway Line of Oak: {SWAY.hint}", None]


def test_leaving_by_blender_s_own_ways_is_seen(scene, picture, layers):
    before = settings(scene)
    bpy.ops.stillwater.draw_stroke(role="sway_line")
    assert draw_mode.tick() == draw_mode.INTERVAL
    bpy.ops.object.mode_set(mode="OBJECT")
    assert draw_mode.tick() is None
    assert settings(scene) == before and status() == "" and not bpy.ops.stillwater.stop_drawing.poll()


def test_a_removed_picture_ends_drawing(extension, scene, picture, layers):
    bpy.ops.stillwater.draw_stroke(role="sway_line")
    extension.properties.arrange.remove_picture(scene, 0)
    assert draw_mode.tick() is None and scene.stillwater.drawing.role == ""


def test_undo_and_redo_lead_out_and_in_again(scene, picture, layers):
    before = settings(scene)
    bpy.ops.ed.undo_push(message="Before")
    bpy.ops.stillwater.draw_stroke("EXEC_DEFAULT", True, role="sway_line")
    bpy.ops.ed.undo()
    scene = bpy.context.scene
    assert scene.stillwater.drawing.role == "" and bpy.context.mode == "OBJECT" and settings(scene) == before
    assert draw_mode.tick() is None
    bpy.ops.ed.redo()
    scene = bpy.context.scene
    assert scene.stillwater.drawing.role == "sway_line" and bpy.app.timers.is_registered(draw_mode.tick)
    draw_mode.tick()
    bpy.ops.object.mode_set(mode="OBJECT")
    draw_mode.tick()
    assert settings(scene) == before


def test_a_file_saved_while_drawing_is_put_right(scene, picture, layers, tmp_path):
    before = settings(scene)
    bpy.ops.stillwater.draw_stroke(role="sway_line")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "file.blend"))
    assert bpy.app.timers.is_registered(draw_mode.tick)
    scene = bpy.context.scene
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    draw_mode.tick()
    assert settings(scene) == before and scene.stillwater.drawing.role == ""


def test_a_missing_object_is_made_and_a_hidden_one_shown(scene, picture, layers):
    bpy.data.objects.remove(picture.strokes)
    bpy.ops.stillwater.draw_stroke(role="waterline", layer="Boat")
    holder = picture.strokes
    assert holder.type == "GREASEPENCIL" and holder.hide_render and holder.name == "Lake Strokes"
    bpy.ops.stillwater.stop_drawing()
    holder.data.layers[0].hide = holder.data.layers[0].lock = holder.hide_viewport = True
    bpy.ops.stillwater.draw_stroke(role="waterline", layer="Boat")
    assert holder.visible_get() and not holder.data.layers[0].hide and not holder.data.layers[0].lock


def test_an_object_that_can_t_be_shown_is_told(scene, picture, layers):
    collection = bpy.data.collections.new("Away")
    scene.collection.children.link(collection)
    collection.objects.link(picture.strokes)
    scene.collection.objects.unlink(picture.strokes)
    bpy.context.view_layer.layer_collection.children["Away"].exclude = True
    with pytest.raises(RuntimeError, match="Strokes: is not visible in this view layer; show its collection to draw"):
        bpy.ops.stillwater.draw_stroke(role="sway_line")
    assert scene.stillwater.drawing.role == "" and bpy.context.mode == "OBJECT"


@pytest.mark.parametrize(
    "given, sentence",
    [
        ({"role": "waterline"}, "Oak: only a layer with the motion Bob has a Waterline"),
        ({"role": "waterline", "layer": "Elm"}, "Elm: Lake has no such layer"),
    ],
)
def test_a_layer_without_that_role_is_told(picture, layers, given, sentence):
    with pytest.raises(RuntimeError, match=sentence):
        bpy.ops.stillwater.draw_stroke(**given)


def test_without_an_active_layer_it_is_told(picture, layers):
    picture.active_layer = 9
    with pytest.raises(RuntimeError, match="Active layer: Lake has no such layer"):
        bpy.ops.stillwater.draw_stroke(role="sway_line")


def test_without_a_plane_or_picture_the_button_is_grey(scene, picture):
    with pytest.raises(RuntimeError, match="The picture has no plane in the scene; make it anew with Set Up in Scene"):
        bpy.ops.stillwater.draw_stroke(role="sway_line")
    bpy.ops.stillwater.remove_picture()
    with pytest.raises(RuntimeError, match="The scene has no Stillwater picture yet"):
        bpy.ops.stillwater.draw_stroke(role="sway_line")


def test_the_last_line_stays_when_done(scene, picture, layers):
    bpy.ops.stillwater.draw_stroke(role="sway_line")
    part = gp_layers.of(picture, layers[1].id, SWAY)[0]
    for points in ([(10, 10), (20, 20)], [(30, 30), (40, 40), (50, 50)], [(60, 60)]):
        draw(part, on_plane(*points))
    assert len(read.strokes(scene, picture, layers[1].id, SWAY)) == 3
    bpy.ops.stillwater.stop_drawing()
    (left,) = read.strokes(scene, picture, layers[1].id, SWAY)
    assert left.points.round(2).tolist() == [[30, 30], [40, 40], [50, 50]]


def test_what_is_drawn_on_the_plane_of_the_layer_lies_on_the_picture(scene, picture, layers):
    """Blender's brush draws where the layer's z is 0; from any view, that is the picture's plane."""
    picture.plane.rotation_euler, picture.strokes.location = (1.2, 0.1, 0.4), (3, 1, 2)
    scene.view_layers[0].update()
    bpy.ops.stillwater.draw_stroke(role="sway_line")
    part = gp_layers.of(picture, layers[1].id, SWAY)[0]
    world = read.layer_to_world(picture.strokes, part)
    upright = picture.plane.matrix_world.to_3x3() @ Vector((0, 0, 1))
    assert world.to_3x3().col[2].normalized().dot(upright) == pytest.approx(1, abs=1e-6)
    assert (world.translation - picture.plane.matrix_world.translation).dot(upright) == pytest.approx(0, abs=1e-6)


@pytest.fixture
def selected(scene, picture, layers):
    """Oak's sway line has two strokes, of which the second is selected in edit mode."""
    part = gp_layers.ensure(picture, layers[1].id, SWAY)
    for points in ([(10, 10), (20, 20)], [(30, 30), (40, 45)]):
        drawing = draw(part, on_plane(*points))
    for curve in (0, 1):
        store(drawing, curve, ".selection", np.array(curve == 1))
    bpy.context.view_layer.objects.active = picture.strokes
    bpy.ops.object.mode_set(mode="EDIT")
    return part


@pytest.mark.parametrize("moved", [False, True], ids=["in place", "moved"])
def test_selected_strokes_get_another_role(scene, picture, layers, selected, moved):
    if moved:
        other = gp_layers.ensure(picture, layers[2].id, WATERLINE)
        other.translation = Vector(other.translation) + Vector((1, 0.5, 0))
        scene.view_layers[0].update()
    assert bpy.ops.stillwater.change_role(role="waterline", layer="Boat") == {"FINISHED"}
    (left,) = read.strokes(scene, picture, layers[1].id, SWAY)
    (gone,) = read.strokes(scene, picture, layers[2].id, WATERLINE)
    assert left.points.round(2).tolist() == [[10, 10], [20, 20]]
    assert gone.points.round(2).tolist() == [[30, 30], [40, 45]]
    drawing = gp_layers.of(picture, layers[2].id, WATERLINE)[0].frames[0].drawing
    slot = drawing.attributes["material_index"].data[0].value
    assert picture.strokes.data.materials[slot].name == "Stillwater Waterline"


def test_only_selected_strokes_of_the_picture_get_one(scene, picture, layers):
    with pytest.raises(RuntimeError, match="Select strokes of the picture in edit mode first"):
        bpy.ops.stillwater.change_role(role="horizon")


def test_a_hidden_layer_takes_no_strokes(scene, picture, layers, selected):
    gp_layers.ensure(picture, "", HORIZON).hide = True
    with pytest.raises(RuntimeError, match="Horizon: is hidden or locked; show and unlock it first"):
        bpy.ops.stillwater.change_role(role="horizon")
    assert len(read.strokes(scene, picture, layers[1].id, SWAY)) == 2


def test_strokes_of_a_role_are_deleted(scene, picture, layers):
    for identifier, role in ((layers[1].id, SWAY), ("", HORIZON)):
        draw(gp_layers.ensure(picture, identifier, role), on_plane((10, 10), (20, 20)))
    assert bpy.ops.stillwater.delete_strokes(role="sway_line") == {"FINISHED"}
    assert read.strokes(scene, picture, layers[1].id, SWAY) == [] != read.strokes(scene, picture, "", HORIZON)
    assert bpy.ops.stillwater.delete_strokes(role="sway_line") == {"CANCELLED"}


def shown() -> dict:
    parts = [show(cls) for cls in registered("view_3d") if cls.poll(bpy.context)]
    kinds = ("texts", "properties", "operators")
    return {kind: [entry for part in parts for entry in getattr(part, kind)] for kind in kinds}


def test_the_panel_offers_the_roles_that_there_are(scene, picture, layers):
    picture.active_layer = 2  # the last one, which needs no matte
    assert shown()["operators"].count("stillwater.draw_stroke") == 2  # Boat's and the horizon
    picture.active_layer = 0
    picture.layers[0].matte.form, picture.layers[0].fill.method = "scribbles", "none"
    assert shown()["operators"].count("stillwater.draw_stroke") == 3  # foreground, background, the horizon
    picture.active_layer = 1
    bpy.ops.stillwater.draw_stroke(role="horizon")
    said = shown()
    assert "stillwater.stop_drawing" in said["operators"] and "stillwater.delete_strokes" not in said["operators"]
    assert HORIZON.hint[:20] in " ".join(said["texts"])
    draw(gp_layers.of(picture, "", HORIZON)[0], on_plane((10, 10), (20, 20)))
    assert "stillwater.delete_strokes" in shown()["operators"]


@pytest.mark.parametrize("place", ["TOOL_HEADER", "UI"])
def test_the_tool_says_what_a_stroke_does(scene, picture, layers, place):
    tools = bpy.types.WorkSpaceTool.__subclasses__()
    tool = next(cls for cls in tools if getattr(cls, "bl_idname", "") == draw_mode.TOOL)
    preferences = SimpleNamespace(system=SimpleNamespace(ui_scale=1))  # Blender's own is 0 without a window
    context = SimpleNamespace(scene=scene, preferences=preferences, region=SimpleNamespace(type=place, width=280))
    idle, busy = Recorder(), Recorder()
    tool.draw_settings(context, idle, None)
    assert " ".join(idle.texts) == "Choose what to draw in the sidebar, tab Stillwater" and idle.operators == []
    bpy.ops.stillwater.draw_stroke(role="sway_line")
    tool.draw_settings(context, busy, None)
    assert " ".join(busy.texts) == status() and busy.operators == ["stillwater.stop_drawing"]


def test_the_panel_in_edit_mode_changes_roles(picture, layers, selected):
    assert "stillwater.change_role" in shown()["operators"]


def icons() -> dict[str, str]:
    """What the buttons of the roles show."""
    (panel,) = [cls for cls in registered("view_3d") if cls.bl_label == "Strokes"]
    lines = {SWAY.name, WATERLINE.name, HORIZON.name}
    return {text: icon for text, icon in show(panel).icons if text in lines}


def test_a_role_that_was_drawn_or_typed_has_a_check_mark(scene, picture, layers):
    assert icons() == {"Sway Line": "GREASEPENCIL", "Horizon": "GREASEPENCIL"}
    picture.layers[1].motion.sway.armature_root = 5, 5
    picture.view.use_horizon, picture.view.horizon_end = True, (9, 9)
    assert icons() == {"Sway Line": "CHECKMARK", "Horizon": "CHECKMARK"}
    picture.view.use_horizon = False
    draw(gp_layers.ensure(picture, layers[2].id, WATERLINE), on_plane((10, 10), (20, 20)))
    assert icons()["Horizon"] == "GREASEPENCIL"
    picture.active_layer = 2
    assert icons() == {"Waterline": "CHECKMARK", "Horizon": "GREASEPENCIL"}
    bpy.ops.stillwater.delete_strokes(role="waterline")
    assert icons()["Waterline"] == "GREASEPENCIL"
    for _ in range(2):
        picture.layers[2].motion.bob.waterline.add()
    assert icons()["Waterline"] == "CHECKMARK"


def test_numbers_that_strokes_stand_for_are_not_shown(scene, picture, layers):
    names = {"armature_root", "armature_tip", "horizon_start", "horizon_end", "use_horizon"}
    picture.view.use_horizon = True
    assert names <= set(shown()["properties"])
    for identifier, role in ((layers[1].id, SWAY), ("", HORIZON)):
        draw(gp_layers.ensure(picture, identifier, role), on_plane((10, 10), (20, 20)))
    assert not names & set(shown()["properties"]) and {"frequency", "fov"} <= set(shown()["properties"])
    picture.active_layer = 2
    assert "Waterline of 0 points" in shown()["texts"]


@pytest.fixture
def written(extension, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))

    def write():
        scene = bpy.context.scene
        return json.loads(open(extension.bake.job.write_recipe(scene, scene.stillwater.pictures[0])).read())

    return write


def test_strokes_go_before_numbers_in_the_recipe(scene, picture, layers, written):
    sway, bob = picture.layers[1].motion.sway, picture.layers[2].motion.bob
    sway.armature_root, sway.armature_tip = (1, 2), (3, 4)
    for place in ((5, 6), (7, 8)):
        bob.waterline.add().place = place
    picture.view.use_horizon, picture.view.horizon_start, picture.view.horizon_end = True, (0, 9), (10, 9)
    typed = written()
    assert [layer["motion"].get("armature") for layer in typed["layers"]] == [None, [[1, 2], [3, 4]], None]
    assert typed["layers"][2]["motion"]["waterline"] == [[5, 6], [7, 8]]
    assert typed["view"]["horizon"] == [[0, 9], [10, 9]]
    for identifier, role, line in (
        (picture.layers[1].id, SWAY, [(100, 700), (90, 300), (120, 20)]),
        (picture.layers[2].id, WATERLINE, [(500, 500), (600, 510)]),
        ("", HORIZON, [(900, 210), (0, 200)]),
    ):
        draw(gp_layers.ensure(picture, identifier, role), on_plane(*line))
    drawn = written()
    for found, wanted in (
        (drawn["layers"][1]["motion"]["armature"], [(100, 700), (120, 20)]),
        (drawn["layers"][2]["motion"]["waterline"], [(500, 500), (600, 510)]),
        (drawn["view"]["horizon"], [(0, 200), (900, 210)]),
    ):
        assert len(found) == 2
        for place, other in zip(found, wanted, strict=True):
            assert place == pytest.approx(other, abs=2e-3)
    rest = lambda said: {**said, "view": None, "layers": None}  # noqa: E731
    assert rest(drawn) == rest(typed)


def test_a_recipe_from_a_script_sees_what_was_just_moved(scene, picture, layers, written):
    draw(gp_layers.ensure(picture, "", HORIZON), on_plane((0, 200), (900, 210)))
    part = gp_layers.of(picture, "", HORIZON)[0]
    part.parent = None
    part.translation = (0, 0, 0)
    picture.strokes.location.x = 1  # 160 px
    assert written()["view"]["horizon"][0][0] == pytest.approx(160, abs=0.01)


def test_strokes_that_can_t_be_read_stop_the_bake_with_a_sentence(scene, picture, layers):
    part = gp_layers.ensure(picture, "", HORIZON)
    draw(part, on_plane((0, 200), (900, 210)))
    picture.picture_size = 0, 0
    with pytest.raises(RuntimeError, match="Lake: has no plane in the scene; make it anew with Set Up in Scene"):
        bpy.ops.stillwater.bake()
