"""Flows: what is drawn of them and what each stroke keeps, the recipe and back, their presets."""

import importlib

import bpy
import numpy as np
import pytest
import recipes
import stillwater
from drawings import draw, lay_out, on_plane
from layered import key, now, said
from panels import registered
from panels import draw as show
from pixels import PACKAGE
from stillwater.recipe.strokes import FlowStroke, Outline, Refine

room = lambda name: importlib.import_module(f"{PACKAGE}.{name}")  # noqa: E731
brush, draw_mode, gp_layers, roles = (room(f"strokes.{name}") for name in ("brush", "draw_mode", "gp_layers", "roles"))
files = room("layers.preset_files")
translate = room("recipe.flow")
ACROSS, DOWN = ((100, 100), (400, 120), (700, 100)), ((640, 100), (640, 700))


@pytest.fixture
def river(scene, picture):
    lay_out(scene, picture)
    picture.layers[0].name, picture.layers[0].motion.type = "River", "flow"
    return picture.layers[0]


def stroke(picture, layer, role: str, points, frame: int = 1):
    part = gp_layers.ensure(picture, layer.id, roles.by_key(role))
    return draw(part, on_plane(*points), frame=frame)


def motion(extension) -> dict:
    return said(extension)["layers"][0]["motion"]


# -- properties

STANDS_FOR = {  # properties of a flow, for the fields of the recipe's classes that are not called so
    Refine: {"width": "refine_width", "amount": "refine_amount"},
    Outline: {"moving": "outline_moving", "persistence": "outline_persistence"},
    FlowStroke: {"speed": "stroke_speed", "local": "stroke_local", "alpha": "stroke_alpha"},
}
DRAWN = {"points", "width", "kind", "frame"}  # by the stroke itself, its pen, its role and its key


@pytest.mark.parametrize("cls", STANDS_FOR)
def test_every_field_has_a_property_with_its_default_and_limits(extension, river, cls):
    fields = {field.encode_name: field for field in stage_fields(cls)}
    assert set(STANDS_FOR[cls]) == set(fields) - (DRAWN if cls is FlowStroke else set())
    for name, ours in STANDS_FOR[cls].items():
        kind = river.motion.flow.bl_rna.properties[ours]
        assert not kind.is_animatable and kind.default == pytest.approx(fields[name].default)
        if kind.type == "FLOAT":
            limits = [meta(fields[name].type, limit) for limit in ("ge", "le")]
            assert [kind.hard_min, kind.hard_max] == pytest.approx(limits)


def stage_fields(cls):
    from msgspec import inspect

    return inspect.type_info(cls).fields


def meta(kind, name: str):
    while getattr(kind, name, None) is None:
        kind = kind.type
    return getattr(kind, name)


def test_only_its_speed_is_keyed(extension, scene, river):
    assert [name for name, kind in river.motion.flow.bl_rna.properties.items() if kind.is_animatable and name not in ("rna_type", "name")] == ["speed"]
    scene.frame_start, scene.frame_end = 1, 4
    key(extension, "stillwater.pictures[0].layers[0].motion.flow.speed", (1, 1), (3, 2))
    assert motion(extension)["speed"]["values"][:4] == pytest.approx([1, 1.5, 2, 2][:4], abs=0.6)


# -- strokes

KINDS = {"flow": "both", "orientation": "orientation", "speed": "speed"}


@pytest.mark.parametrize("role, kind", KINDS.items())
def test_its_button_leads_into_draw_mode_and_its_strokes_reach_the_recipe(extension, scene, picture, river, role, kind):
    assert bpy.ops.stillwater.draw_stroke("EXEC_DEFAULT", True, role=role) == {"FINISHED"}
    assert bpy.context.mode == "PAINT_GREASE_PENCIL" and roles.by_key(role).hint in draw_mode.hint(scene)
    river.motion.flow.stroke_speed, river.motion.flow.stroke_alpha = 3.5, 0.5
    stroke(picture, river, role, ACROSS)
    assert bpy.ops.stillwater.stop_drawing("EXEC_DEFAULT", True) == {"FINISHED"}
    river.motion.flow.stroke_speed, river.motion.flow.stroke_local = 9, True  # of the next one
    (made,) = motion(extension)["strokes"]
    assert np.allclose(np.array(made.pop("points"))[:, :2], ACROSS, atol=0.01) and made.pop("width") > 0
    assert made == {"kind": kind, "speed": 3.5, "local": False, "alpha": 0.5}


def test_what_is_held_still_is_a_list_of_strokes(extension, picture, river):
    stroke(picture, river, "flow", ACROSS)
    stroke(picture, river, "freeze", DOWN)
    (held,) = motion(extension)["freeze"]
    assert np.allclose(held["points"], DOWN, atol=0.01)
    assert "freeze" not in translate.drawn_of({"strokes": [], "freeze": []}) or stillwater.parse(said(extension) | {"picture": "p.png"})


def test_strokes_are_drawn_with_the_numbers_of_their_time(scene, picture, river):
    bpy.ops.stillwater.draw_stroke("EXEC_DEFAULT", True, role="flow")
    first = stroke(picture, river, "flow", ACROSS)
    river.motion.flow.stroke_speed = 4
    draw_mode.tick()
    river.motion.flow.stroke_speed = 7
    stroke(picture, river, "flow", DOWN)
    draw_mode.tick()
    assert [each["speed"] for each in brush.of_curves(first, 2)] == [4, 7]
    bpy.ops.stillwater.stop_drawing("EXEC_DEFAULT", True)
    assert brush.stamp(picture, river) == 0


def test_before_the_pen_s_stroke_is_stamped_it_counts_as_if(extension, picture, river):
    stroke(picture, river, "flow", ACROSS)
    river.motion.flow.stroke_speed, river.motion.flow.stroke_local = 6, True
    made = motion(extension)["strokes"][0]
    assert (made["speed"], made["local"]) == (6, True)


def test_a_dab_says_a_speed_but_no_direction(extension, picture, river):
    stroke(picture, river, "flow", ((5, 5), (5.2, 5.2)))
    stroke(picture, river, "speed", ((5, 5),))
    assert [each["kind"] for each in motion(extension)["strokes"]] == ["speed"]


def test_keys_are_frames(extension, picture, river):
    stroke(picture, river, "flow", ACROSS, frame=1)
    assert "frame" not in motion(extension)["strokes"][0]
    stroke(picture, river, "flow", DOWN, frame=20)
    stroke(picture, river, "speed", ((9, 9),), frame=1)
    stroke(picture, river, "speed", ((9, 9), (20, 20)), frame=10)
    made = [(each["kind"], each["frame"], len(each["points"])) for each in motion(extension)["strokes"]]
    assert made == [("both", 1, 3), ("speed", 1, 1), ("both", 10, 3), ("speed", 10, 2), ("both", 20, 2), ("speed", 20, 2)]
    assert {each["kind"] for each in translate.holding(motion(extension)["strokes"], 12)} == {"both", "speed"}
    assert [each["frame"] for each in translate.holding(motion(extension)["strokes"], -5)] == [1, 1]


def test_the_first_stroke_holds_always_wherever_the_artist_is(scene, picture, river):
    scene.frame_start = 1
    scene.frame_set(50)
    bpy.ops.stillwater.draw_stroke("EXEC_DEFAULT", True, role="flow")
    (part,) = gp_layers.of(picture, river.id, roles.by_key("flow"))
    assert [key.frame_number for key in part.frames] == [1]
    bpy.ops.stillwater.stop_drawing("EXEC_DEFAULT", True)


@pytest.fixture
def selected(scene, picture, river):
    """Two strokes in edit mode, the second of which is selected."""
    bpy.ops.stillwater.draw_stroke("EXEC_DEFAULT", True, role="flow")
    stroke(picture, river, "flow", ACROSS)
    drawing = stroke(picture, river, "flow", DOWN)
    bpy.ops.stillwater.stop_drawing("EXEC_DEFAULT", True)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.grease_pencil.set_selection_mode(mode="STROKE")
    bpy.ops.grease_pencil.select_all(action="DESELECT")
    chosen = drawing.attributes.get(".selection") or drawing.attributes.new(".selection", "BOOLEAN", "CURVE")
    chosen.data[1].value = True
    return drawing


def test_the_speed_of_selected_strokes_can_be_changed(scene, picture, river, selected):
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.stillwater.set_flow("EXEC_DEFAULT", True, speed=8, local=True, alpha=0.25) == {"FINISHED"}
    said = brush.of_curves(selected, 2)
    assert said[1] == {"speed": 8, "local": True, "alpha": 0.25} and said[0]["speed"] == 2


def test_where_nothing_that_flows_is_selected_it_says_so(scene, picture, river, selected):
    selected.attributes[".selection"].data[1].value = False
    with pytest.raises(RuntimeError, match="No selected stroke says how something flows"):
        bpy.ops.stillwater.set_flow()
    bpy.ops.object.mode_set(mode="OBJECT")
    with pytest.raises(RuntimeError, match="Select strokes of the picture in edit mode first"):
        bpy.ops.stillwater.set_flow()


def test_speeds_go_with_the_picture_s_size(extension, picture, river):
    drawing = stroke(picture, river, "flow", ACROSS)
    brush.stamp(picture, river)
    extension.strokes.scale_speeds(picture, 2.5)
    assert brush.of_curves(drawing, 1)[0]["speed"] == 5


def test_copies_have_strokes_of_their_own(extension, picture, river):
    river.motion.flow.stroke_speed = 5
    stroke(picture, river, "flow", ACROSS)
    brush.stamp(picture, river)
    bpy.ops.stillwater.duplicate_layer()
    assert [each["motion"]["strokes"][0]["speed"] for each in said(extension)["layers"]] == [5, 5]
    bpy.ops.stillwater.copy_layers()
    bpy.ops.stillwater.paste_layers()
    assert [each["motion"]["strokes"][0]["speed"] for each in said(extension)["layers"]] == [5, 5, 5]


def test_panels_show_the_roles_and_the_brush(picture, river):
    shown = show(next(cls for cls in registered("view_3d") if cls.bl_label == "Strokes"))
    buttons = zip(shown.operators, shown.made, strict=True)
    offered = [made.role for name, made in buttons if name == "stillwater.draw_stroke"]
    assert offered == ["flow", "orientation", "speed", "freeze", "horizon"] and "stroke_speed" not in shown.properties
    bpy.ops.stillwater.draw_stroke("EXEC_DEFAULT", True, role="flow")
    drawing = show(next(cls for cls in registered("view_3d") if cls.bl_label == "Strokes"))
    assert {"stroke_speed", "stroke_local", "stroke_alpha"} <= set(drawing.properties)
    bpy.ops.stillwater.stop_drawing("EXEC_DEFAULT", True)


def test_what_is_missing_is_a_sentence(extension, scene, picture, river):
    missing = room("layers.missing")
    drawn = lambda: extension.strokes.replaced(scene, picture, river)  # noqa: E731
    assert missing.of(picture, 0, drawn()) == ["Press Flow and draw the way that it flows, or Propose Flow"]
    stroke(picture, river, "speed", ACROSS)
    assert missing.of(picture, 0, drawn()) != []
    stroke(picture, river, "orientation", ACROSS)
    assert missing.of(picture, 0, drawn()) == []


# -- recipes

STROKES = recipes.FLOW_STROKES


def test_a_recipe_comes_back_from_the_scene(extension, scene, tmp_path):
    path = recipes.write(tmp_path, recipes.flowing())
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    assert bpy.ops.stillwater.load_recipe(filepath=str(path)) == {"FINISHED"}
    assert stillwater.parse(said(extension))
    wanted, made = recipes.flowing()["layers"][0]["motion"], motion(extension)
    for name in ("refine", "period", "type"):
        assert made[name] == wanted[name]
    assert made["speed"]["first"] == 1 and made["speed"]["values"][:3] == [2, 1.5, 3]
    order = lambda strokes: sorted(strokes, key=lambda each: (each["kind"], each.get("frame") or 0))  # noqa: E731
    for ours, theirs in zip(order(made["strokes"]), order(wanted["strokes"]), strict=True):
        assert np.allclose(ours.pop("points"), theirs["points"], atol=0.01)
        assert ours.pop("width") == pytest.approx(theirs["width"], abs=0.01)
        assert ours.pop("frame", None) == theirs["frame"]
        assert ours == {name: theirs[name] for name in ours} and len(ours) == 4
    assert np.allclose(made["freeze"][0]["points"], wanted["freeze"][0]["points"], atol=0.01)
    numbers = now().layers[0].motion.flow
    assert (numbers.stroke_speed, numbers.stroke_alpha) == (0, 0.25)  # the next stroke goes on as the last


def test_strokes_that_hold_always_lie_on_each_key():
    strokes = [{**STROKES[0], "frame": None}, STROKES[1], {**STROKES[0], "frame": 9}]
    found = translate.drawn_of({"strokes": strokes, "freeze": []})["flow"]
    assert [(each["frame"], each["speed"]) for each in found] == [(4, 0.5), (4, 1.5), (9, 0.5), (9, 0.5)]


@pytest.mark.parametrize("path", files.paths("flow"), ids=lambda path: path.stem)
def test_presets_set_the_look_and_the_engine_takes_it(extension, scene, tmp_path, path):
    recipe = recipes.write(tmp_path, recipes.flowing())
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.stillwater.load_recipe(filepath=str(recipe))
    before = motion(extension)["strokes"]
    bpy.ops.stillwater.apply_preset("EXEC_DEFAULT", True, filepath=str(path))
    made, numbers, flow = motion(extension), files.read(path).numbers, now().layers[0].motion.flow
    assert stillwater.parse(said(extension)) and made["strokes"] == before  # strokes keep what they say
    assert made["period"] == numbers["period"] and made["refine"]["width"] == numbers["refine_width"]
    assert flow.stroke_speed == pytest.approx(numbers["stroke_speed"]) and flow.proposal == numbers["proposal"]


def test_every_kind_of_proposal_is_the_engine_s(river):
    from stillwater.flow_painting import KINDS

    offered = [item.identifier for item in river.motion.flow.bl_rna.properties["proposal"].enum_items]
    assert offered == list(KINDS)
