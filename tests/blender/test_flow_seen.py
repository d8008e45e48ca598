"""Flows in the viewport: the sketch that is seen while one is drawn, live frames, and the proposal as strokes."""

import importlib

import bpy
import numpy as np
import pytest
import recipes
import stage
import stillwater
from layered import now, said
from panels import Recorder
from pixels import PACKAGE

room = lambda name: importlib.import_module(f"{PACKAGE}.{name}")  # noqa: E731
gp_layers, roles = room("strokes.gp_layers"), room("strokes.roles")
flow_field, overlay = room("overlay.flow_field"), room("overlay.flow")
STROKES = recipes.FLOW_STROKES


def motion(extension) -> dict:
    return said(extension)["layers"][0]["motion"]


def test_a_sketch_is_small_and_keeps_what_strokes_say():
    pixels, scale = flow_field.small(np.random.default_rng(1).random((720, 1280, 4), np.float32))
    assert max(pixels.shape) <= flow_field.LARGEST and scale == 1 / 4 and abs(pixels.mean() - 0.5) < 0.01
    tiny, one = flow_field.small(np.zeros((3, 5, 4), np.float32))
    assert tiny.shape == (3, 5, 4) and one == 1
    made = flow_field.reduced({"strokes": STROKES, "refine": {"width": 8, "amount": 0.5}, "freeze": []}, 0.5, 5)
    assert [each["speed"] for each in made["strokes"]] == [0.75, 0] and made["refine"]["width"] == 4
    assert made["strokes"][0]["points"] == [[2, 2, 0.5], [4.5, 2.5, 1]] and "frame" not in made["strokes"][0]
    assert STROKES[1]["speed"] == 1.5  # as it was
    bound = flow_field.bound_of(np.pad(np.ones((40, 40), np.float32), ((0, 0), (0, 40))), (20, 32))
    assert bound.shape == (20, 32) and bound[:, :16].all() and not bound[:, 16:].any()


def test_colours_tell_direction_and_speed():
    flow = np.zeros((2, 3, 2), np.float32)
    flow[0, 0], flow[0, 1], flow[1, 0] = (2, 0), (-2, 0), (1, 0)
    made = flow_field.colours(flow, 0.5)
    assert made[0, 0].tolist() == [1, 0, 0, 0.5] and made[0, 1, :3] == pytest.approx([0, 1, 1])
    assert 0 < made[1, 0, 3] < 0.5 and made[1, 2, 3] == 0
    wheel = flow_field.wheel()
    middle, side = flow_field.WHEEL // 2, flow_field.WHEEL - 4
    assert wheel[middle, side, :3] == pytest.approx([1, 0, 0], abs=0.05) and wheel[0, 0, 3] == 0
    assert wheel[middle, 4, :3] == pytest.approx([0, 1, 1], abs=0.05)


def test_lines_follow_a_flow_evenly_apart():
    y, x = np.mgrid[:200, :320].astype(np.float32)
    flow = np.stack([100 - y, x - 160], axis=-1) / 50  # turns about the middle
    inside = (np.hypot(x - 160, y - 100) < 90).astype(np.float32)
    found = flow_field.lines_of(flow, inside)
    assert 4 <= len(found) <= flow_field.MOST_LINES
    for line, speed in found:
        radius = np.hypot(*(line - (160, 100)).T)
        assert np.ptp(radius) < 4 and radius.max() < 92 and speed == pytest.approx(radius.mean() / 50, rel=0.1)
        (ax, ay), (bx, by) = line[0] - (160, 100), line[1] - (160, 100)
        assert ax * by - ay * bx > 0  # turns the way of the flow
    assert flow_field.lines_of(np.zeros((50, 80, 2), np.float32)) == []


@pytest.fixture
def live(extension, scene, tmp_path, monkeypatch):
    """A recipe's river in a viewport that somebody looks at."""
    monkeypatch.setattr(extension.play.show, "seen", True)
    path = stage.write(tmp_path / "lake", layers=[{"name": "river", "motion": recipes.flowing()["layers"][0]["motion"]}])
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.stillwater.load_recipe(filepath=str(path))
    picture = scene.stillwater.pictures[0]
    scene.frame_set(5)
    extension.play.show.scene(scene)
    stage.wait(extension)
    yield picture
    overlay.forget()
    extension.play.server.end()
    extension.play.show.forget()


def test_the_flow_is_seen_while_it_is_drawn(extension, scene, live):
    assert overlay.of(scene, live) is None  # it has strokes, and none is being drawn
    drawing = scene.stillwater.drawing
    drawing.role, drawing.picture_id, drawing.layer_id = "flow", live.id, live.layers[0].id
    sight = overlay.of(scene, live)
    assert sight is not None and not sight.proposed and overlay.sentence(sight, live.layers[0]) == ""
    scene.frame_set(6)
    live.wind.speed = 3  # neither says anything of the flow: from frame 4 on the same strokes hold
    extension.play.show.scene(scene)
    assert overlay.of(scene, live) is sight and bpy.app.timers.is_registered(overlay.go_on)
    streaks, colours = overlay.pixels_of(sight, False), overlay.pixels_of(sight, True)
    assert streaks.shape == colours.shape and streaks.shape[2] == 4 and np.isfinite(streaks).all()
    scene.stillwater_overlay.flow = False
    assert overlay.of(scene, live) is None
    scene.stillwater_overlay.flow_colors = True
    assert overlay.of(scene, live) is not None
    drawing.role = "horizon"
    assert overlay.of(scene, live) is None
    drawing.role = ""


def test_without_strokes_the_proposal_is_seen_faintly(extension, scene, live):
    for role in ("flow", "speed"):
        bpy.ops.stillwater.delete_strokes("EXEC_DEFAULT", True, role=role)
    extension.play.show.scene(scene)
    sight = overlay.of(scene, live)
    assert sight is not None and sight.proposed
    sentence = overlay.sentence(sight, live.layers[0])
    assert sentence == "Proposed for Water: Propose Flow makes it strokes, or draw your own"
    assert np.median(sight.field[..., 0]) > 0  # water runs to the right
    live.layers[0].motion.flow.proposal = "smoke"
    assert np.median(overlay.of(scene, live).field[..., 1]) < 0  # smoke up


def test_a_proposal_keeps_to_a_matte_from_a_file(extension, scene, tmp_path, monkeypatch):
    monkeypatch.setattr(extension.play.show, "seen", True)
    layers = [{"name": "river", "matte": {"file": "matte.png"}, "motion": recipes.flowing()["layers"][0]["motion"]}, {"name": "sky"}]
    path = stage.write(tmp_path / "lake", layers=layers)
    bpy.ops.stillwater.load_recipe(filepath=str(path))
    for role in ("flow", "speed"):
        bpy.ops.stillwater.delete_strokes("EXEC_DEFAULT", True, role=role)
    extension.play.show.forget()
    extension.play.show.scene(scene)
    sight = overlay.of(scene, scene.stillwater.active())
    speed = np.hypot(*np.moveaxis(sight.field, 2, 0))
    assert sight.proposed and speed[:, :9].max() > 0 and not speed[:, 11:].any()
    overlay.forget()
    extension.play.server.end()
    extension.play.show.forget()


def test_the_flow_plays_and_the_rest_does_not(extension, scene, live):
    show, seen = extension.play.show, []
    for frame in (5, 6, 8):
        scene.frame_set(frame)
        show.scene(scene)
        stage.wait(extension)
        assert show.stage_of(scene, live).problem == "" and extension.play.plane.shows(live)
        seen.append(stage.pixels_of(live.plane.data))
    assert np.abs(seen[1] - seen[0]).max() > 1e-3 and np.abs(seen[2] - seen[1]).max() > 1e-3


def test_while_another_field_is_prepared_the_last_one_stays(extension, scene, live):
    show = extension.play.show
    show.scene(scene)
    stage.wait(extension)
    shown, known = stage.pixels_of(live.plane.data), show.stage_of(scene, live)
    live.layers[0].motion.flow.refine_amount = 0.125
    show.scene(scene)
    assert known.share is not None and extension.play.plane.shows(live)
    np.testing.assert_array_equal(stage.pixels_of(live.plane.data), shown)
    stage.wait(extension)
    assert known.share is None and known.recipe["layers"][0]["motion"]["refine"]["amount"] == 0.125


@pytest.fixture
def streaky(extension, scene, tmp_path):
    """A picture of slanted streaks, opened, with one layer that flows."""
    y, x = np.mgrid[:120, :192]
    value = 0.5 + 0.4 * np.sin((y - 0.5 * x) / 3)
    image = bpy.data.images.new("streaks", 192, 120)
    image.pixels = np.dstack([value[::-1]] * 3 + [np.ones_like(value)]).astype(np.float32).ravel()
    image.filepath_raw, image.file_format = str(tmp_path / "streaks.png"), "PNG"
    image.save()
    bpy.data.images.remove(image)
    bpy.ops.stillwater.open_picture(filepath=str(tmp_path / "streaks.png"))
    layer = now().layers[0]
    layer.motion.type, layer.motion.flow.stroke_speed = "flow", 3
    return layer


def test_the_proposal_becomes_strokes(extension, scene, streaky):
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.stillwater.propose_flow("EXEC_DEFAULT", True, kind="water") == {"FINISHED"}
    made = motion(extension)["strokes"]
    assert 3 <= len(made) <= 30 and {each["kind"] for each in made} == {"both"}
    assert max(each["speed"] for each in made) == pytest.approx(3)
    for each in made:
        (x0, y0), (x1, y1) = (np.array(each["points"][i])[:2] for i in (0, -1))
        assert x1 > x0 and (y1 - y0) / (x1 - x0) == pytest.approx(0.5, abs=0.2)  # along the streaks, to the right
    assert stillwater.parse(said(extension))
    bpy.ops.ed.undo()
    assert motion(extension)["strokes"] == []
    bpy.ops.ed.redo()
    assert motion(extension)["strokes"] == made


def test_it_asks_for_a_layer_that_flows(scene, streaky):
    streaky.motion.type = "still"
    with pytest.raises(RuntimeError, match="Select a layer with the motion Flow or Example first"):
        bpy.ops.stillwater.propose_flow()
    streaky.motion.type = "flow"
    shown = Recorder()
    room("layers.panel_flow").draw(shown, streaky.motion.flow, set())
    assert "stillwater.propose_flow" in shown.operators and "proposal" in shown.properties
    drawn = Recorder()
    room("layers.panel_flow").draw(drawn, streaky.motion.flow, {"strokes"})
    assert drawn.operators == []


def test_a_picture_without_streaks_says_so(scene, tmp_path):
    recipes.write(tmp_path, recipes.whole())
    bpy.ops.stillwater.open_picture(filepath=str(tmp_path / "picture.png"))
    now().layers[0].motion.type = "flow"
    before = len(gp_layers.of(now(), now().layers[0].id, roles.by_key("flow")))
    try:
        bpy.ops.stillwater.propose_flow()
    except RuntimeError as error:
        assert "the picture shows no streaks there; draw with Flow" in str(error)
        assert len(gp_layers.of(now(), now().layers[0].id, roles.by_key("flow"))) == before
