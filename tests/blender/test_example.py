"""The motion Example: its numbers, its clip in the scene, what is cloned from it, its speed, bake and Live."""

import importlib
import json
from types import SimpleNamespace

import bpy
import clips
import msgspec
import numpy as np
import pytest
import stage
import stillwater
from drawings import draw
from layered import now, said
from mathutils import Matrix, Vector
from panels import Recorder, registered
from panels import draw as show
from pictures import paint
from pixels import PACKAGE, read_frame, render
from stillwater.recipe.fluids import Example, Flow, Transfer

room = lambda name: importlib.import_module(f"{PACKAGE}.{name}")  # noqa: E731
clip, gp_layers, roles = (room(name) for name in ("properties.clip", "strokes.gp_layers", "strokes.roles"))
places, pick = room("clips.places"), room("clips.pick")
SIZE = (96, 64)  # px, of the picture
ACROSS = [[10, 20], [50, 22], [86, 20]]


def motion(extension) -> dict:
    return said(extension)["layers"][0]["motion"]


def recipe(**changes) -> dict:
    """A picture all of which looks like the clip beside it."""
    flowing = {
        "type": "example", "clip": "clip.avi", "life": 4, "matching": "laplacian", "repetitions": 1, "grid": [2, 1],
        "transfer": {"patch": 8}, "strokes": [{"points": ACROSS, "kind": "both", "speed": 2, "width": 6}], **changes,
    }  # fmt: skip
    return {"stillwater": 1, "picture": "picture.png", "frames": [5, 6], "layers": [{"name": "river", "motion": flowing}]}


@pytest.fixture
def opened(scene, tmp_path):
    """Opens such a recipe in a saved file; returns the picture."""

    def open_recipe(**changes):
        folder = tmp_path / "lake"
        paint(folder / "picture.png", SIZE)
        clips.write(folder / "clip.avi")
        (folder / "recipe.json").write_text(json.dumps(recipe(**changes)))
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
        assert bpy.ops.stillwater.load_recipe(filepath=str(folder / "recipe.json")) == {"FINISHED"}
        return scene.stillwater.pictures[0]

    return open_recipe


def call(operator: str, **arguments) -> None:
    assert getattr(bpy.ops.stillwater, operator)("EXEC_DEFAULT", True, **arguments) == {"FINISHED"}


def stroke(picture, role: str, *pixels):
    """Draws on the picture, or on the clip, where these pixels lie."""
    layer, role = picture.layers[0], roles.by_key(role)
    part = gp_layers.ensure(picture, layer.id, role)
    to_world = np.array(gp_layers.pixels_to_world(picture, layer.id, role))
    from_world = np.array(room("strokes.read").layer_to_world(picture.strokes, part).inverted())
    spots = np.array([[x, y, 0, 1] for x, y in pixels])
    return draw(part, (spots @ (from_world @ to_world).T)[:, :3], frame=bpy.context.scene.frame_start)


def panel(label: str) -> Recorder:
    return show(next(cls for cls in registered("view_3d") if cls.bl_label == label))


# -- numbers

OURS = {"use_clip_frames", "clip_first", "clip_last", "use_grid", "refine_width", "refine_amount"}
OURS |= {"outline_moving", "outline_persistence", "transfer_patch", "transfer_order"}
WHOLE = {
    "type": "example", "clip": "clip.mp4", "clip_frames": [3, 90], "clip_fps": 25, "clip_scale": 1.5, "life": 12, "speed": 0.5,
    "refine": {"width": 20, "amount": 0.75}, "shutter": 0.125, "average_blur": 4, "matching": "laplacian", "grid": [8, 5],
    "repetitions": 2, "stylize": 0.5, "endless": False, "clip_steady": True, "transfer": {"patch": 24, "order": "best-first"},
    "strokes": [{"points": [[1, 2], [9, 8]], "kind": "both", "speed": 3}], "freeze": [{"points": [[4, 4], [5, 5]], "width": 3}],
}  # fmt: skip


def test_every_field_has_a_property_with_its_default(picture):
    group = picture.layers[0].motion.example
    fields = {field.encode_name: field for field in msgspec.inspect.type_info(Example).fields}
    elsewhere = {"strokes", "refine", "outline", "transfer", "clip_frames", "freeze"}
    assert set(type(group).__annotations__) - OURS == set(fields) - elsewhere
    assert {field.encode_name for field in msgspec.inspect.type_info(Transfer).fields} == {"patch", "order", "strokes"}
    for name in set(type(group).__annotations__) & set(fields) - {"clip", "grid", "clip_fps"}:
        assert group.bl_rna.properties[name].default == pytest.approx(fields[name].default), name
    animated = [name for name, kind in group.bl_rna.properties.items() if kind.is_animatable and name not in ("rna_type", "name")]
    assert animated == ["speed"]


def test_the_recipe_that_blender_writes_is_the_one_that_was_opened(extension, opened):
    given = {**{name: value for name, value in WHOLE.items() if name not in ("type", "clip", "clip_frames")}, "clip_frames": [3, 20]}
    opened(**given)
    made = motion(extension)
    assert (now().id_data.path_resolve("stillwater").active() == now()) and made["clip"].endswith("lake/clip.avi")
    made["clip"] = "clip.avi"
    wanted = msgspec.to_builtins(msgspec.convert(recipe(**given)["layers"][0]["motion"], Example | Flow))
    made = msgspec.to_builtins(msgspec.convert(made, Example | Flow))
    for part in ("strokes", "freeze"):
        for ours, theirs in zip(made.pop(part), wanted.pop(part), strict=True):
            np.testing.assert_allclose(np.array(ours.pop("points"))[:, :2], theirs.pop("points"), atol=0.01)
            assert ours.pop("width") == pytest.approx(theirs.pop("width"), abs=0.01) and ours == theirs
    assert made == wanted


def test_the_whole_file_goes_to_a_recipe_and_back(extension, opened, tmp_path):
    opened(**CLONES)
    before = motion(extension)
    call("export_recipe", filepath=str(tmp_path / "lake" / "again.json"))
    assert bpy.ops.stillwater.load_recipe(filepath=str(tmp_path / "lake" / "again.json")) == {"FINISHED"}
    after = motion(extension)
    for each in (before, after):
        each["clip"] = each["clip"].rpartition("/")[2]
    assert after == before


def test_its_panel_shows_every_number_and_what_to_press(picture):
    shown, moved = Recorder(), picture.layers[0].motion
    room("layers.panel_flow").draw_example(shown, moved, set())
    assert "stillwater.choose_clip" in shown.operators and "clip" not in shown.properties
    moved.example.clip = "/clip.mp4"
    moved.example.use_grid = moved.example.use_clip_frames = moved.example.outline_moving = True
    shown = Recorder()
    room("layers.panel_flow").draw_example(shown, moved, set())
    brush = {"stroke_speed", "stroke_local", "stroke_alpha", "proposal"}
    assert set(shown.properties) == set(type(moved.example).__annotations__) | brush
    assert {"stillwater.show_clip", "stillwater.pick_speed", "stillwater.propose_flow"} <= set(shown.operators)


# -- the clip


def test_a_clip_is_chosen_in_the_file_browser(scene, picture, tmp_path):
    picture.layers[0].motion.type = "example"
    kinds = bpy.ops.stillwater.choose_clip.get_rna_type().properties
    assert kinds["filter_movie"].default and kinds["filter_folder"].default
    path = clips.write(tmp_path / "fall.avi")
    call("choose_clip", filepath=str(path))
    assert bpy.path.abspath(now().layers[0].motion.example.clip) == str(path)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    assert now().layers[0].motion.example.clip == "//fall.avi"


@pytest.mark.parametrize("name, sentence", [("", "No clip was chosen"), ("none.mp4", "none.mp4: "), ("text.mp4", "text.mp4: ")])
def test_a_clip_that_can_t_be_read_is_told(picture, tmp_path, name, sentence):
    picture.layers[0].motion.type = "example"
    (tmp_path / "text.mp4").write_text("no film at all")
    with pytest.raises(RuntimeError, match=sentence):
        bpy.ops.stillwater.choose_clip(filepath=str(tmp_path / name) if name else "")
    assert now().layers[0].motion.example.clip == ""


def test_without_a_clip_or_such_a_layer_the_buttons_say_so(opened):
    picture = opened()
    picture.layers[0].motion.example.clip = ""
    for name in ("show_clip", "pick_speed", "draw_clone_source"):
        with pytest.raises(RuntimeError, match="The layer has no clip yet; press Choose Clip first"):
            getattr(bpy.ops.stillwater, name)()
    assert "Press Choose Clip: a film of such a fluid, from a camera that stands still" in " ".join(panel("Layers").texts)
    picture.layers[0].motion.type = "flow"
    for name in ("choose_clip", "show_clip", "pick_speed", "draw_clone_source"):
        with pytest.raises(RuntimeError, match="Select a layer with the motion Example first"):
            getattr(bpy.ops.stillwater, name)()


def test_what_it_misses_is_a_sentence(picture):
    example = SimpleNamespace(type="example", example=SimpleNamespace(clip=""))
    told = room("layers.missing")._motion(picture, SimpleNamespace(motion=example), set())
    assert [sentence.split()[1] for sentence in told] == ["Choose", "Flow"]


def test_the_clip_is_shown_below_the_picture(opened):
    picture = opened()
    call("show_clip")
    shown = clip.plane_of(now(), now().layers[0].id)
    assert shown.data.source == "MOVIE" and clip.size_of(shown) == clips.SIZE and shown.visible_get()
    assert (shown.image_user.frame_duration, shown.image_user.use_cyclic) == (clips.FRAMES, True)
    ours = np.array(clip.pixels_to_world(picture, picture.layers[0].id))
    theirs = np.array(room("properties.plane").pixels_to_world(picture))
    corners = lambda matrix, size: np.array([matrix @ (x, y, 0, 1) for x in (0, size[0]) for y in (0, size[1])])[:, :3]  # noqa: E731
    below, above = corners(ours, clips.SIZE), corners(theirs, SIZE)
    assert below[:, 2].max() < above[:, 2].min() and np.ptp(below[:, 1]) < 1e-6  # upright, as the picture
    assert below[:, 0].mean() == pytest.approx(above[:, 0].mean(), abs=1e-5)
    call("show_clip")
    assert len(clip.planes_of(now())) == 1


def test_another_clip_takes_its_place(opened, tmp_path):
    picture = opened()
    call("show_clip")
    clips.write(tmp_path / "other.avi", clips.passing((48, 64)))
    call("choose_clip", filepath=str(tmp_path / "other.avi"))
    shown = clip.plane_of(now(), now().layers[0].id)
    assert clip.size_of(shown) == (48, 64) and len(clip.planes_of(now())) == 1
    assert [image.name for image in bpy.data.images if image.source == "MOVIE"] == [shown.data.name]
    picture.layers[0].motion.example.clip = "//gone.avi"
    assert clip.size_of(clip.plane_of(now(), now().layers[0].id)) == (48, 64)
    with pytest.raises(RuntimeError, match="gone.avi"):
        bpy.ops.stillwater.show_clip()


def test_a_file_that_is_saved_elsewhere_keeps_its_clip(extension, opened, tmp_path):
    opened(**CLONES)
    before, shown = motion(extension)["transfer"], clip.plane_of(now(), now().layers[0].id)
    (tmp_path / "deep" / "er").mkdir(parents=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "deep" / "er" / "file.blend"))
    here = now().layers[0].motion.example.clip
    assert here == "//../../lake/clip.avi" and bpy.path.abspath(shown.data.filepath) == bpy.path.abspath(here)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "deep" / "er" / "file.blend"))
    call("show_clip")
    assert len(clip.planes_of(now())) == 1 == len([image for image in bpy.data.images if image.source == "MOVIE"])
    assert motion(extension)["transfer"] == before


def test_copies_and_removals_take_the_clip_along(opened):
    opened(**CLONES)
    call("duplicate_layer")
    assert len({item[clip.LAYER] for item in clip.planes_of(now())}) == 2 == len(now().layers)
    call("remove_layer")
    assert [item[clip.LAYER] for item in clip.planes_of(now())] == [now().layers[0].id]
    call("remove_picture")
    assert not [item for item in bpy.data.objects if clip.LAYER in item]
    assert not [image for image in bpy.data.images if image.source == "MOVIE"]


# -- clones

SOURCES = [[[12.5, 30], [40, 31.25], [70, 30]], [[20, 10], [60, 50]]]
TARGETS = [[[5, 50.5], [80, 52]], [[9, 9], [30, 20], [60, 12.125]]]
CLONES = {
    "transfer": {"patch": 8, "strokes": [
        {"source": SOURCES[0], "target": TARGETS[0], "width": 12, "alpha": 0.5},
        {"source": SOURCES[1], "target": TARGETS[1], "width": 7.5, "alpha": 1},
    ]},
}  # fmt: skip


def test_what_is_drawn_on_clip_and_picture_is_a_pair(extension, opened):
    picture = opened(clip_scale=0.5)
    picture.layers[0].motion.flow.stroke_alpha = 0.25
    for lines, role in ((SOURCES, "clone_source"), (TARGETS, "clone_target")):
        for line in lines:
            stroke(picture, role, *line)
    pairs = motion(extension)["transfer"]["strokes"]
    for pair, source, target in zip(pairs, SOURCES, TARGETS, strict=True):
        np.testing.assert_allclose(pair["source"], source, atol=0.01)
        np.testing.assert_allclose(pair["target"], target, atol=0.01)
        assert pair["alpha"] == 0.25 and pair["width"] > 0
    assert stillwater.parse(said(extension), ".")


def test_a_recipe_s_clones_are_drawn_again(extension, opened):
    picture = opened(**CLONES)
    assert picture.layers[0].motion.example.transfer_patch == 8
    for pair, wanted in zip(motion(extension)["transfer"]["strokes"], CLONES["transfer"]["strokes"], strict=True):
        for end in ("source", "target"):
            np.testing.assert_allclose(pair[end], wanted[end], atol=0.01)
        assert (pair["width"], pair["alpha"]) == pytest.approx((wanted["width"], wanted["alpha"]), abs=0.01)


def path(line) -> list[dict]:
    return [{"name": "", "loc": place, "time": 0.0} for place in line]


def test_sources_are_drawn_on_the_clip_without_draw_mode_too(extension, opened):
    picture = opened(clip_scale=0.5)
    for line in SOURCES:
        call("draw_clone_source", path=path(line))
    stroke(picture, "clone_source", *SOURCES[0])
    assert bpy.context.mode == "OBJECT"
    for line in TARGETS:
        stroke(now(), "clone_target", *line)
    for pair, source in zip(motion(extension)["transfer"]["strokes"], SOURCES, strict=True):
        np.testing.assert_allclose(pair["source"], source, atol=0.01)
    drawn = room("clips.editor").sources(bpy.context.scene, now(), now().layers[0])
    assert len(drawn) == 3 and np.allclose(drawn[1], SOURCES[1], atol=0.01)


@pytest.mark.parametrize("line", [[], [(5, 5)], [(5, 5), (5, 5)]])
def test_a_source_of_one_point_takes_nothing(opened, line):
    opened()
    with pytest.raises(RuntimeError, match="Draw a line on the clip: a single point takes nothing"):
        bpy.ops.stillwater.draw_clone_source(path=path(line))


def test_an_image_editor_of_the_clip_has_its_buttons(opened):
    picture = opened()
    (part,) = registered("image_editor")
    space = SimpleNamespace(image=None)
    context = SimpleNamespace(scene=bpy.context.scene, space_data=space, region=None, preferences=bpy.context.preferences)
    assert not part.poll(context)
    call("show_clip")
    space.image = clip.plane_of(picture, picture.layers[0].id).data
    assert part.poll(context)

    def shown() -> Recorder:
        recorder = Recorder()
        part.draw(SimpleNamespace(layout=recorder), context)
        return recorder

    assert shown().operators == ["stillwater.pick_speed", "stillwater.draw_clone_source"]
    call("draw_clone_source", path=path(SOURCES[0]))
    assert shown().operators[-1] == "stillwater.delete_strokes" and "A Clone Source has no Clone Target" in " ".join(shown().texts)
    picture.layers[0].motion.type = "flow"
    assert not part.poll(context)


def test_one_without_the_other_is_told(extension, opened):
    picture = opened()
    assert extension.strokes.unpaired(bpy.context.scene, picture, picture.layers[0]) == []
    stroke(picture, "clone_source", *SOURCES[0])
    assert "A Clone Source has no Clone Target: draw on the picture where it goes" in " ".join(panel("Layers").texts)
    assert "strokes" not in motion(extension)["transfer"]
    stroke(picture, "clone_target", *TARGETS[0])
    assert extension.strokes.unpaired(bpy.context.scene, picture, picture.layers[0]) == []
    stroke(picture, "clone_target", *TARGETS[1])
    (told,) = extension.strokes.unpaired(bpy.context.scene, picture, picture.layers[0])
    assert told == "A Clone Target has no Clone Source: draw on the clip what goes there"
    assert len(motion(extension)["transfer"]["strokes"]) == 1


def test_the_buttons_lead_to_clip_and_picture(opened):
    picture = opened()
    buttons = panel("Strokes")
    offered = [made.role for name, made in zip(buttons.operators, buttons.made, strict=True) if name == "stillwater.draw_stroke"]
    assert offered[:6] == ["flow", "orientation", "speed", "freeze", "clone_source", "clone_target"]
    call("draw_stroke", role="clone_source")  # shows the clip
    shown = clip.plane_of(now(), now().layers[0].id)
    assert picture.strokes.data.layers.active.parent == shown and bpy.context.mode == "PAINT_GREASE_PENCIL"
    call("draw_stroke", role="clone_target")
    drawing = panel("Strokes")
    assert picture.strokes.data.layers.active.parent == picture.plane and "stroke_alpha" in drawing.properties
    assert "stroke_speed" not in drawing.properties
    call("stop_drawing")


def test_a_deleted_clip_comes_back_under_its_strokes(extension, opened):
    opened(**CLONES)
    before = motion(extension)["transfer"]
    bpy.data.objects.remove(clip.plane_of(now(), now().layers[0].id))
    with pytest.raises(ValueError, match="its clip is not in the scene; press Show Clip"):
        said(extension)
    call("show_clip")
    assert motion(extension)["transfer"] == before


def test_pasted_layers_bring_their_clones(extension, opened):
    opened(**CLONES)
    call("copy_layers")
    call("paste_layers")
    first, second = (each["motion"]["transfer"] for each in said(extension)["layers"])
    assert first == second and len(clip.planes_of(now())) == 2


def test_a_recipe_whose_clip_is_gone_opens_only_where_nothing_is_drawn_on_it(scene, opened, tmp_path):
    opened()
    for changes, fits in (({}, True), (CLONES, False)):
        (tmp_path / "lake" / "next.json").write_text(json.dumps(recipe(clip="gone.avi", **changes)))
        count = len(scene.stillwater.pictures)
        if fits:
            assert bpy.ops.stillwater.load_recipe(filepath=str(tmp_path / "lake" / "next.json")) == {"FINISHED"}
        else:
            with pytest.raises(RuntimeError, match="gone.avi"):
                bpy.ops.stillwater.load_recipe(filepath=str(tmp_path / "lake" / "next.json"))
        assert len(scene.stillwater.pictures) == count + fits


# -- its speed


def test_a_click_on_the_clip_gives_its_speed(scene, opened):
    picture = opened(clip_scale=2)
    scene.render.fps, scene.render.fps_base = 50, 1
    call("pick_speed", place=(48, 32))
    wanted = clips.STEP * 2 * clips.FPS / 50
    assert now().layers[0].motion.flow.stroke_speed == pytest.approx(wanted, rel=0.1)
    now().layers[0].motion.example.clip_fps = 50
    call("pick_speed", place=(48, 32))
    assert now().layers[0].motion.flow.stroke_speed == pytest.approx(2 * wanted, rel=0.1)
    with pytest.raises(RuntimeError, match="Click on the clip: that place is beside it"):
        bpy.ops.stillwater.pick_speed(place=(500, 32))
    picture.layers[0].motion.example.clip = "//gone.avi"
    with pytest.raises(RuntimeError, match="gone.avi"):
        bpy.ops.stillwater.pick_speed(place=(48, 32))


def test_a_clip_of_one_frame_has_no_speed(opened, tmp_path):
    opened()
    clips.write(tmp_path / "one.avi", clips.passing(frames=1))
    call("choose_clip", filepath=str(tmp_path / "one.avi"))
    with pytest.raises(RuntimeError, match="The clip has one frame only, in which nothing moves"):
        bpy.ops.stillwater.pick_speed(place=(48, 32))


def test_the_place_under_the_mouse():
    to_world = Matrix.Translation((3, 0, 1)) @ Matrix.Diagonal((0.1, -0.1, 0.1, 1))
    seen = places.on_plane(to_world, Vector((5, -2, 9)), Vector((0, 0, -1)))
    assert seen == pytest.approx((20, 20), abs=1e-4)
    aslant = places.on_plane(to_world, Vector((5, -2, 2)), Vector((1, 0, -1)))
    assert aslant == pytest.approx((30, 20), abs=1e-4)
    assert places.on_plane(to_world, Vector((5, -2, 9)), Vector((1, 0, 0))) is None
    assert places.in_editor((0.25, 0.75), (96, 64)) == (24, 16)
    assert places.inside((95.9, 63.9), (96, 64)) and places.inside((96, 3), (96, 64)) is None and places.inside(None, (1, 1)) is None


def test_the_picture_and_the_clip_below_share_a_viewport(extension):
    fit = extension.pictures.fit
    assert fit.above((400, 400), (400, 400)) == (1, 0.5)
    assert fit.above((400, 200), (400, 200), 0.1) == pytest.approx((1, 0.5 / 1.2))
    share = fit.above((200, 400), (400, 200))
    assert share == pytest.approx((0.5, 2 / 3))
    upper = fit.upper(fit.Box(10, 20, 800, 600), share)
    assert (upper.x, upper.y, upper.width, upper.height) == pytest.approx((210, 220, 400, 400))


# -- frames


def test_the_node_gives_what_the_engine_made(scene, opened, tmp_path):
    opened()
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    state = now().tree.stillwater
    assert (state.state, state.message) == ("done", "Baked 2 frames")
    seen = [render(scene, frame, tmp_path) for frame in (5, 6)]
    for frame, shown in zip((5, 6), seen, strict=True):
        (path,) = tmp_path.glob(f"stillwater/*/frames/frame_{frame:04d}.exr")
        for name, wanted in read_frame(path).items():
            np.testing.assert_array_equal(shown[name], wanted, name)
    assert np.abs(seen[0]["Image"] - seen[1]["Image"]).max() > 0.01


def test_a_clip_that_is_gone_is_told_by_bake_and_live(extension, scene, opened, monkeypatch):
    picture = opened()
    picture.layers[0].motion.example.clip = "//gone.avi"
    with pytest.raises(RuntimeError, match="gone.avi"):
        bpy.ops.stillwater.bake()
    monkeypatch.setattr(extension.play.show, "seen", True)
    extension.play.show.scene(scene)
    stage.wait(extension)
    assert "gone.avi" in extension.play.show.stage_of(scene, picture).problem
    extension.play.server.end()
    extension.play.show.forget()


def test_live_says_what_it_prepares_and_shows_the_last_meanwhile(extension, scene, opened, monkeypatch):
    told = []
    monkeypatch.setattr(extension.play.show, "seen", True)
    picture = opened()
    scene.frame_set(5)
    extension.play.show.scene(scene)
    here = extension.play.show.stage_of(scene, picture)
    follow = here._changed
    here._changed = lambda: (told.append(here.what), follow())
    stage.wait(extension, 60)
    assert here.problem == "" and here.live is not None and any("river" in each for each in told), told
    frames = []
    for frame in (5, 9, 5):
        scene.frame_set(frame)
        extension.play.show.scene(scene)
        frames.append(stage.pixels_of(picture.plane.data))
    assert np.abs(frames[0] - frames[1]).max() > 0.01 and np.array_equal(frames[0], frames[2])
    picture.layers[0].motion.example.life = 3
    extension.play.show.scene(scene)
    assert here.share is not None and np.array_equal(stage.pixels_of(picture.plane.data), frames[2])
    assert panel("Live").texts[0].startswith("Preparing")
    stage.wait(extension, 60)
    assert here.share is None and here.problem == ""
    extension.play.server.end()
    extension.play.show.forget()


def test_its_flow_is_seen_while_it_is_drawn(extension, scene, opened, monkeypatch):
    monkeypatch.setattr(extension.play.show, "seen", True)
    picture, overlay = opened(), room("overlay.flow")
    extension.play.show.scene(scene)
    stage.wait(extension, 60)
    assert overlay.of(scene, picture) is None  # at rest, with strokes
    call("draw_stroke", role="flow")
    sight = overlay.of(scene, picture)
    assert sight is not None and not sight.proposed and np.median(sight.field[..., 0]) == pytest.approx(2, rel=0.2), overlay.problem
    call("stop_drawing")
    overlay.forget()
    extension.play.server.end()
    extension.play.show.forget()
