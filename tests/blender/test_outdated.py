"""The panel says what is out of date and why, and only that is made anew."""

import time
from types import SimpleNamespace

import bpy
import pytest
from panels import draw, registered
from pixels import HEIGHT, WIDTH


@pytest.fixture
def picture(painted):
    """The painted picture, baked."""
    bpy.ops.stillwater.bake()
    return bpy.context.scene.stillwater.pictures[0]


@pytest.fixture
def look(extension):
    """What is found now."""
    return lambda: extension.bake.outdated.look(bpy.context.scene, bpy.context.scene.stillwater.pictures[0]).lines


def key(path, *points):
    for frame, value in points:
        owner, name = path
        setattr(owner, name, value)
        owner.keyframe_insert(name, frame=frame)


def times(folder):
    return {path.name: path.stat().st_mtime_ns for path in folder.glob("*.exr")}


def test_before_and_after_a_bake(painted, look):
    assert look() == ["Not baked yet"]
    bpy.ops.stillwater.bake()
    assert look() == ["All 4 frames are ready"]


def test_a_change_is_named_with_its_frames_and_only_they_are_made_anew(painted, picture, look):
    before = times(painted)
    key((picture.wind, "speed"), (6, 20), (8, 9))
    assert look() == ["Wind changed: frames 6-8"]
    bpy.ops.stillwater.bake()
    kept = {name for name, when in times(painted).items() if before[name] == when}
    assert kept == {"frame_0005.exr"}
    assert picture.tree.stillwater.message == "Baked 3 frames, 1 was right already"
    assert look() == ["All 4 frames are ready"]


@pytest.mark.parametrize(
    "change, line",
    [
        (lambda p: setattr(p.layers[0].motion.sway, "amount", 2), "Motion of tree changed: frames 5-8"),
        (lambda p: setattr(p.layers[0], "feather", 2), "Matte of tree changed: frames 5-8"),
        (lambda p: setattr(p.layers[0], "opacity", 0.5), "Visibility of tree changed: frames 5-8"),
        (lambda p: setattr(p.output, "compression", "piz"), "Output settings changed: frames 5-8"),
        (lambda p: setattr(p, "loop", True), "Frame rate or loop changed: frames 5-8"),
        (lambda p: setattr(p.layers[0].motion.sway, "amount", 3), "All 4 frames are ready"),
    ],
)
def test_each_change_is_named(picture, look, change, line):
    change(picture)
    assert look() == [line]


def test_a_longer_range_misses_frames_and_says_that_the_nearest_is_shown(picture, look):
    bpy.context.scene.frame_end = 10
    assert look() == ["Missing, the nearest is shown: frames 9-10"]


def test_a_layer_more_is_named(extension, picture, look):
    layer = extension.properties.arrange.add_layer(picture, "bush")
    layer.matte.form, layer.matte.file = "file", picture.layers[0].matte.file
    extension.properties.arrange.move_layer(picture, 2, 0)
    assert look() == ["Layer bush was added: frames 5-8"]


def test_a_picture_painted_over_is_named(picture, look):
    from pixels import oiio

    image = oiio.ImageBuf(oiio.ImageSpec(WIDTH, HEIGHT, 3, "float"))
    assert image.write(bpy.path.abspath(picture.picture))
    assert look() == ["Picture changed: frames 5-8"]


def test_what_is_wrong_is_said_instead(picture, look):
    picture.layers[0].matte.file = "//none.png"
    assert "layers[0].matte.file: " in look()[0] and "there is no such file" in look()[0]
    with pytest.raises(RuntimeError, match="there is no such file"):
        bpy.ops.stillwater.check_frames()


def test_driven_numbers_are_looked_at_when_asked(extension, picture, look):
    driver = picture.wind.driver_add("speed").driver
    driver.expression = "20"
    found = extension.bake.outdated.look(bpy.context.scene, picture, play=False)
    assert found.lines == [extension.bake.outdated.PLAYED] and found.words == ""
    assert bpy.ops.stillwater.check_frames() == {"FINISHED"}
    assert look() == ["All 4 frames are ready"]


def watch(extension, seconds=5):
    """Does what the timer does until it knows something new."""
    outdated, scene = extension.bake.outdated, bpy.context.scene
    picture, end = scene.stillwater.pictures[0], time.monotonic() + seconds
    before = outdated.of(scene, picture)
    while outdated.of(scene, picture) == before:
        assert time.monotonic() < end, "waited in vain"
        assert outdated.tick() == outdated.INTERVAL
        time.sleep(0.02)
    return outdated.of(scene, picture).lines


def test_the_timer_finds_it_by_itself(extension, picture):
    assert watch(extension) == ["All 4 frames are ready"]
    picture.wind.speed = 3
    assert watch(extension) == ["Wind changed: frames 5-8"]
    picture.wind.speed = 20
    assert watch(extension) == ["All 4 frames are ready"]
    layer = extension.properties.arrange.add_layer(picture, "bush")
    layer.matte.form, layer.matte.file = "file", picture.layers[0].matte.file
    extension.properties.arrange.move_layer(picture, 2, 1)
    assert watch(extension) == ["Layer bush was added: frames 5-8"]


CURVES = [
    lambda curve: setattr(curve.keyframe_points[1].co, "y", 7),
    lambda curve: setattr(curve.keyframe_points[0], "interpolation", "BOUNCE"),
    lambda curve: setattr(curve.keyframe_points[0], "handle_right", (5.5, 30)),
    lambda curve: setattr(curve.modifiers.new("NOISE"), "strength", 3),
    lambda curve: setattr(curve, "mute", True),
]


@pytest.mark.parametrize("change", CURVES)
def test_a_change_of_a_curve_is_seen_at_a_glance(extension, picture, change):
    key((picture.wind, "speed"), (5, 20), (8, 9))
    bpy.ops.stillwater.bake()
    watch(extension)
    data = bpy.context.scene.animation_data
    change(extension.versions.curves_of(data.action, data.action_slot)[0])
    assert watch(extension)[0].startswith("Wind changed: frames ")


def test_the_timer_leaves_a_picture_alone_for_long_after_a_look(extension, picture, monkeypatch):
    """It takes a twentieth of the time at most."""
    outdated, told = extension.bake.outdated, []
    monkeypatch.setattr(outdated, "PAUSE", 0)
    glance = outdated._glance
    monkeypatch.setattr(outdated, "_glance", lambda *a: told.append(1) or time.sleep(0.01) or glance(*a))
    end = time.monotonic() + 0.5
    while time.monotonic() < end:
        outdated.tick()
    assert 1 <= len(told) <= 3


def test_panels_read_it_and_compute_nothing(extension, picture, monkeypatch):
    extension.bake.outdated.look(bpy.context.scene, picture)
    monkeypatch.setattr(extension.bake.job, "describe", None)
    panel = next(cls for cls in registered("view_3d") if cls.bl_label == "Bake")
    assert "All 4 frames are ready" in draw(panel).texts


def test_after_a_crash_the_state_is_found_from_disk(extension, painted, tmp_path, look):
    """The file was saved before the bake; Blender died while it ran, or after it."""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.stillwater.bake()
    (painted / "frame_0007.exr").unlink()
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "file.blend"))
    tree = bpy.context.scene.stillwater.pictures[0].tree
    assert tree.stillwater.there == "5-6,8" and tree.nodes["Frames"].image is not None
    assert look() == ["Missing, the nearest is shown: frame 7"]
    bpy.ops.stillwater.bake()
    assert tree.stillwater.message == "Baked 1 frame, 3 were right already"


def test_nodes_say_it_and_keep_an_artist_s_label(extension, picture, look):
    scene, node = bpy.context.scene, extension.compositor.tree
    mine = node.add_node(scene, picture.tree)
    mine.label = "my clouds"
    ours = node.nodes_of(scene, picture.id)[0]
    name = picture.tree.name
    look()
    assert ours.label == f"{name} (ready)"
    picture.wind.speed = 3
    look()
    assert ours.label == f"{name} (out of date)"
    scene.frame_start = 1
    look()
    assert ours.label == f"{name} (out of date)" and mine.label == "my clouds"


def test_the_active_node_s_panel_shows_its_own_picture(extension, picture):
    panel = bpy.types.STILLWATER_PT_node
    node = extension.compositor.tree.nodes_of(bpy.context.scene, picture.id)[0]
    editor = SimpleNamespace(space_data=SimpleNamespace(tree_type="CompositorNodeTree"))
    editor.active_node, editor.scene, editor.region = node, bpy.context.scene, None
    editor.preferences = bpy.context.preferences
    assert panel.poll(editor)
    from panels import Recorder

    shown = Recorder()
    extension.bake.outdated.look(bpy.context.scene, picture)
    panel.draw(SimpleNamespace(layout=shown, _picture=panel._picture), editor)
    assert shown.texts[0] == "lake" and "All 4 frames are ready" in shown.texts and "stillwater.bake" in shown.operators
    editor.active_node = None
    assert not panel.poll(editor)


def test_a_look_at_many_frames_goes_in_short_steps(extension, picture):
    """The recipe first, then frame by frame."""
    outdated, scene = extension.bake.outdated, bpy.context.scene
    scene.frame_end = 1004
    known, spent = outdated._Picture(), []
    steps = outdated._steps(known, scene, picture)
    while (start := time.perf_counter()) and next(steps, None) is not None:
        spent.append(time.perf_counter() - start)
    assert known.report.lines == ["Missing, the nearest is shown: frames 9-1004"]
    assert len(spent) == 1001 and sorted(spent)[500] < 0.002
