"""Renders of frames that are out of date warn, bake first, or say nothing; none can hang."""

import threading
import time

import bpy
import numpy as np
import pytest
from pixels import oiio, read_frame


@pytest.fixture
def guard(extension, monkeypatch):
    guard = extension.bake.guard
    yield guard
    guard._wishes.clear()


@pytest.fixture
def prefer(guard, monkeypatch):
    """Sets the preference."""

    def choose(what):
        monkeypatch.setattr(guard, "what_to_do_with_stale", lambda context: what)
        monkeypatch.setattr(guard, "_preference", what)

    return choose


@pytest.fixture
def scene(painted, tmp_path):
    scene = bpy.context.scene
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"
    scene.render.filepath = str(tmp_path / "out" / "####.exr")
    return scene


def still(scene, frame):
    scene.frame_set(frame)
    path, scene.render.filepath = scene.render.filepath, scene.render.frame_path(frame=frame)
    bpy.ops.render.render(write_still=True)
    shown, scene.render.filepath = oiio.ImageBuf(scene.render.filepath).get_pixels("float"), path
    return shown


def test_by_default_it_warns(guard):
    assert guard.what_to_do_with_stale(bpy.context) == "WARN"


def test_a_still_of_a_frame_that_is_not_there_warns(scene, prefer, capfd):
    prefer("WARN")
    still(scene, 6)
    assert "Stillwater: lake: Not baked yet" in capfd.readouterr().out
    bpy.ops.stillwater.bake()
    still(scene, 6)
    assert "Stillwater:" not in capfd.readouterr().out


def test_a_still_asks_about_its_frame_alone_and_an_animation_about_all(scene, prefer, capfd):
    prefer("WARN")
    bpy.ops.stillwater.bake()
    wind = scene.stillwater.pictures[0].wind
    for frame, speed in ((7, 20), (8, 3)):
        wind.speed = speed
        wind.keyframe_insert("speed", frame=frame)
    still(scene, 5)
    assert "Stillwater:" not in capfd.readouterr().out
    bpy.ops.render.render(animation=True)
    told = [line for line in capfd.readouterr().out.splitlines() if line.startswith("Stillwater:")]
    assert told == ["Stillwater: lake: Wind changed: frames 7-8"]


def test_nothing_is_said_where_nothing_is_to_be(scene, prefer, capfd, painted):
    prefer("NOTHING")
    still(scene, 6)
    assert "Stillwater:" not in capfd.readouterr().out and not painted.exists()


def test_a_still_bakes_its_frame_first(scene, prefer, painted):
    prefer("BAKE")
    shown = still(scene, 6)
    assert [path.name for path in painted.iterdir()] == ["frame_0006.exr"]
    np.testing.assert_array_equal(shown, read_frame(painted / "frame_0006.exr")["Image"])


@pytest.mark.parametrize("there", [(), (6,), (5, 7, 8)])
def test_an_animation_bakes_all_frames_first(scene, prefer, painted, there):
    for frame in there:
        scene.frame_set(frame)
        bpy.ops.stillwater.bake(range="CURRENT")
    scene.frame_set(1)
    prefer("BAKE")
    bpy.ops.render.render(animation=True)
    for frame in range(5, 9):
        shown = oiio.ImageBuf(scene.render.frame_path(frame=frame)).get_pixels("float")
        np.testing.assert_array_equal(shown, read_frame(painted / f"frame_{frame:04d}.exr")["Image"])


def test_frames_out_of_date_are_made_anew_first(scene, prefer, painted):
    bpy.ops.stillwater.bake()
    before = read_frame(painted / "frame_0007.exr")["Image"]
    prefer("BAKE")
    scene.stillwater.pictures[0].wind.speed = 8
    shown = still(scene, 7)
    assert (shown != before).any()
    np.testing.assert_array_equal(shown, read_frame(painted / "frame_0007.exr")["Image"])


def test_after_the_render_missing_frames_show_the_nearest_again(scene, prefer, painted):
    prefer("BAKE")
    still(scene, 6)
    tree = scene.stillwater.pictures[0].tree
    assert tree.stillwater.holds and len(tree.animation_data.action.layers[0].strips[0].channelbags[0].fcurves) == 1
    prefer("NOTHING")
    np.testing.assert_array_equal(still(scene, 8), read_frame(painted / "frame_0006.exr")["Image"])


def test_a_bake_that_fails_is_said_and_the_render_goes_on(scene, prefer, capfd):
    prefer("BAKE")
    scene.stillwater.pictures[0].layers[0].motion.type = "bob"
    still(scene, 6)
    assert "Stillwater: lake: tree, motion" in capfd.readouterr().out


def test_driven_numbers_are_said_to_be_unknown(scene, prefer, capfd):
    bpy.ops.stillwater.bake()
    prefer("BAKE")
    scene.stillwater.pictures[0].wind.driver_add("speed")
    still(scene, 6)
    assert "Stillwater: lake: Driven values: Check Frames says what is out of date" in capfd.readouterr().out


def test_a_scene_that_does_not_show_it_is_left_alone(scene, prefer, painted):
    prefer("BAKE")
    scene.render.use_compositing = False
    bpy.data.cameras.new("c")
    scene.camera = bpy.data.objects.new("c", bpy.data.cameras["c"])
    scene.collection.objects.link(scene.camera)
    scene.render.engine = "BLENDER_WORKBENCH"
    still(scene, 6)
    assert not painted.exists()


@pytest.mark.parametrize("kind", ["LINK_COPY", "FULL_COPY"])
@pytest.mark.parametrize("first", ["BAKE", "NOTHING"])
def test_a_copied_scene_baked_by_a_render_survives_undo(scene, prefer, painted, kind, first, tmp_path):
    """The render gives the copy a tree of its own, which no step before the render holds."""
    prefer(first)
    still(scene, 5)
    bpy.ops.ed.undo_push(message="Before")
    bpy.ops.scene.new("EXEC_DEFAULT", True, type=kind)
    name = bpy.context.scene.name
    prefer("BAKE")
    bpy.data.scenes[name].stillwater.pictures[0].wind.speed = 9
    bpy.ops.ed.undo_push(message="Wind")
    bpy.data.materials.new("Bark").use_fake_user = True
    bpy.ops.ed.undo_push(message="Of something else: the scene is the same before and after")
    shown = still(bpy.data.scenes[name], 6)
    for there in (True, True, True, False):
        bpy.ops.ed.undo()
        assert (name in bpy.data.scenes) == there
        whole(tmp_path)
    for _ in range(4):
        bpy.ops.ed.redo()
        whole(tmp_path)
    np.testing.assert_array_equal(still(bpy.data.scenes[name], 6), shown)


def whole(folder):
    """All that pictures and compositors point at is there, and can be written."""
    for scene in bpy.data.scenes:
        for picture in scene.stillwater.pictures:
            for thing in (picture.tree, picture.plane, picture.camera, picture.image):
                assert thing is None or thing.name in [item.name for item in (*bpy.data.node_groups, *bpy.data.objects, *bpy.data.images)]
        tree = getattr(scene, "compositing_node_group", None) or getattr(scene, "node_tree", None)
        for node in tree.nodes if tree else ():
            assert getattr(node, "node_tree", None) is None or node.node_tree.name in bpy.data.node_groups
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "copy.blend"), copy=True)


class Render(threading.Thread):
    """The thread in which a Blender with a window renders; the test is the main one, with its timers."""

    def __init__(self, guard, scene, frames):
        super().__init__(daemon=True)
        self.guard, self.scene, self.frames, self.at = guard, scene, frames, None

    def run(self):
        self.guard.render_begins(self.scene)
        for frame in self.frames:
            self.at = frame
            self.guard.frame_begins(self.scene)
        self.at = "done"


def timers(extension, render, seconds=30):
    """Blender's main loop, until the render is over."""
    end = time.monotonic() + seconds
    while render.is_alive():
        assert time.monotonic() < end, "the render hangs"
        extension.bake.guard.attend()
        extension.bake.job.tick()
        time.sleep(0.01)


def test_a_render_in_its_own_thread_waits_for_the_bake(extension, guard, scene, prefer, painted):
    prefer("BAKE")
    scene.frame_set(6)
    guard.attend()
    render = Render(guard, scene, [6])
    render.start()
    timers(extension, render)
    assert render.at == "done" and [path.name for path in painted.iterdir()] == ["frame_0006.exr"]
    render = Render(guard, scene, [5, 6, 7, 8])
    render.start()
    timers(extension, render)
    assert render.at == "done" and len(list(painted.glob("frame_*.exr"))) == 4


def test_a_bake_that_is_cancelled_lets_the_render_go_on(extension, guard, scene, prefer, painted):
    prefer("BAKE")
    scene.frame_set(6)
    scene.stillwater.pictures[0].output.scale = 16
    guard.attend()
    render = Render(guard, scene, [5, 6])
    render.start()
    end = time.monotonic() + 30
    while render.is_alive():
        assert time.monotonic() < end
        guard.attend()
        extension.bake.job.tick()
        for tree in extension.bake.job.running_trees():
            bpy.ops.stillwater.cancel(tree=tree.name)
        time.sleep(0.01)
    assert render.at == "done" and not guard._wishes


def test_a_warning_does_not_stop_the_render(extension, guard, scene, prefer, capfd):
    prefer("WARN")
    scene.frame_set(6)
    guard.attend()
    render = Render(guard, scene, [6])
    render.start()
    render.join(5)
    assert render.at == "done"
    guard.attend()
    assert "Stillwater: lake: Not baked yet" in capfd.readouterr().out and not guard._wishes


def test_where_the_main_thread_waits_for_the_render_it_does_not_wait_back(guard, scene, prefer, monkeypatch, capfd):
    """Its timers are silent: the render goes on."""
    prefer("BAKE")
    monkeypatch.setattr(guard, "SILENT", 0.3)
    guard.attend()
    render = Render(guard, scene, [6])
    render.start()
    render.join(5)
    assert render.at == "done"
    assert "Blender waits for this render; it goes on with the frames that there are" in capfd.readouterr().out
