"""Baking: what the worker says reaches the artist, whatever the worker does."""

import json
import os
import subprocess
import sys
import time
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import bpy
import pytest
from panels import Recorder
from pixels import render, same, write_frame

FAKE = Path(__file__).with_name("fake_worker.py")


@pytest.fixture
def saved(scene, picture, tmp_path):
    """The picture in a saved file; its folder is made by the first bake."""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    return tmp_path / "stillwater" / "Lake"


@pytest.fixture
def worker(extension, scene, saved, tmp_path, monkeypatch):
    """Makes bakes start the fake worker in a mode; returns the frames that it delivers."""
    frames = {number: write_frame(tmp_path / "made" / f"frame_{number:04d}.exr", number) for number in range(5, 9)}

    monkeypatch.setattr(extension.bake.job, "TELLING", 0)

    def use(mode):
        command = [sys.executable, str(FAKE), mode, str(tmp_path / "made")]
        monkeypatch.setattr(extension.engine, "worker_command", lambda python="": list(command))
        return frames

    yield use
    extension.bake.job.end_all()


@pytest.fixture
def state(scene):
    return lambda: bpy.context.scene.stillwater.pictures[0].tree.stillwater


def until(extension, condition, seconds=10):
    """Does what the timer does until `condition` holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        extension.bake.job.tick()
        time.sleep(0.01)


def test_a_bake_writes_the_recipe_and_shows_the_frames(extension, scene, saved, worker, state, tmp_path):
    frames = worker("plain")
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    assert (state().state, state().share, state().message) == ("done", 1, "Baked 4 frames")
    assert state().warning == "picture: 3 pixels are not numbers (read as 0)"
    assert json.loads((saved / "recipe.json").read_text())["frames"] == [5, 8]
    assert sorted(path.name for path in saved.iterdir()) == ["frames", "options.txt", "recipe.json"]
    assert state().folder == "//stillwater/Lake/frames"
    extension.compositor.tree.wire(scene, state().id_data)
    for frame, wanted in frames.items():
        same(render(scene, frame, tmp_path), wanted)


def test_it_goes_on_while_the_artist_works(extension, worker, state):
    worker("slow")
    tree = extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    assert state().state == "running" and bpy.app.timers.is_registered(extension.bake.job.tick)
    until(extension, lambda: state().share > 0)
    assert state().message.startswith("Frame ") and state().message.endswith(" of 4")
    until(extension, lambda: not extension.bake.job.running(tree))
    assert state().state == "done"
    assert extension.bake.job.tick() is None  # the timer ends


def test_a_second_bake_shows_the_new_frames(extension, scene, worker, state, tmp_path):
    worker("plain")
    bpy.ops.stillwater.bake()
    extension.compositor.tree.wire(scene, state().id_data)
    render(scene, 6, tmp_path)
    new = write_frame(tmp_path / "made" / "frame_0006.exr", 66)
    bpy.ops.stillwater.bake()
    same(render(scene, 6, tmp_path), new)


@pytest.mark.parametrize(
    "mode, sentence",
    [
        ("refuse", "all, motion.frequency: 0 is not above 0 (Hz)"),
        ("give up", "no space left"),
        ("crash", "The worker was ended by SIGSEGV: Segfault ahead"),
        ("leave", "The worker ended with code 3 and gave no reason"),
    ],
)
def test_the_worker_s_sentence_is_reported(worker, state, mode, sentence):
    worker(mode)
    with pytest.raises(RuntimeError, match=r".*") as error:
        bpy.ops.stillwater.bake()
    assert sentence in str(error.value)
    assert state().state == "failed" and sentence in state().message


def test_frames_made_before_a_failure_are_shown(extension, scene, worker, state, tmp_path):
    frames = worker("crash")
    with pytest.raises(RuntimeError):
        bpy.ops.stillwater.bake()
    extension.compositor.tree.wire(scene, state().id_data)
    same(render(scene, 7, tmp_path), frames[7])
    same(render(scene, 8, tmp_path), frames[7])  # the nearest


def test_lines_that_are_no_events_do_no_harm(worker, state):
    worker("garbage")
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    assert (state().state, state().message) == ("done", "Baked 4 frames")


def test_the_time_left_is_told_in_panel_and_status_bar(extension, worker, state):
    worker("hang")
    tree = extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    until(extension, lambda: state().left)
    assert state().left == "1 s left"
    bar = Recorder()
    extension.bake.status_bar.draw(SimpleNamespace(layout=bar), bpy.context)
    assert bar.texts == [f"{state().message}, 1 s left"] and bar.operators == ["stillwater.cancel"]
    assert bpy.ops.stillwater.cancel(tree=tree.name) == {"FINISHED"}
    until(extension, lambda: not extension.bake.job.running(tree))
    empty = Recorder()
    extension.bake.status_bar.draw(SimpleNamespace(layout=empty), bpy.context)
    assert state().left == "" and empty.texts == []


def test_nothing_is_told_that_is_not_new(extension, worker, state, monkeypatch):
    """Each change of what panels show draws them anew."""
    worker("hang")
    job, told = extension.bake.job, []
    tree = job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    until(extension, lambda: "nothing at all" in state().message)
    monkeypatch.setattr(job, "TELLING", 60)
    monkeypatch.setattr(job, "_tell", lambda *_: told.append(1))
    for _ in range(5):
        job.tick()
    assert told == [] and job.running(tree)


@pytest.mark.parametrize(
    "kind, options",
    [
        ("ALL", ""),
        ("PREVIEW", " --frames 6-8"),  # cut at the scene's last
        ("CURRENT", " --frames 7-7"),
    ],
)
def test_a_part_of_the_frames_can_be_baked(scene, worker, saved, kind, options):
    worker("plain")
    scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, 6, 20
    scene.frame_set(7)
    assert bpy.ops.stillwater.bake(range=kind) == {"FINISHED"}
    assert (saved / "options.txt").read_text() == f"--progress json --parent --cache-limit 4{options}"
    assert json.loads((saved / "recipe.json").read_text())["frames"] == [5, 8]  # a loop's period stays


def test_visible_frames_are_those_of_a_timeline(extension, scene):
    """The window of a Blender without one has areas, and a timeline among them."""
    view = SimpleNamespace(region_to_view=lambda x, y: (5.6 + x / 50, y))
    region = SimpleNamespace(type="WINDOW", width=100, view2d=view)
    area = SimpleNamespace(type="DOPESHEET_EDITOR", regions=[region])
    context = SimpleNamespace(scene=scene, window=SimpleNamespace(screen=SimpleNamespace(areas=[area])))
    assert extension.bake.ranges.frames_of(context, "VISIBLE") == (6, 8)
    context.window.screen.areas.clear()
    with pytest.raises(ValueError, match="No timeline or dope sheet is open"):
        extension.bake.ranges.frames_of(context, "VISIBLE")


def test_ranges_that_are_none_are_sentences(scene, worker):
    worker("plain")
    with pytest.raises(RuntimeError, match="The timeline has no preview range; set one with P"):
        bpy.ops.stillwater.bake(range="PREVIEW")
    scene.frame_set(30)
    with pytest.raises(RuntimeError, match="Frame 30 is not within the scene's frames, 5 to 8"):
        bpy.ops.stillwater.bake(range="CURRENT")
    scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, 50, 60
    with pytest.raises(RuntimeError, match="Frames 50 to 60 are not within"):
        bpy.ops.stillwater.bake(range="PREVIEW")


def test_a_picture_is_baked_by_its_name(extension, scene, picture, worker, saved):
    worker("plain")
    extension.properties.arrange.add_picture(scene, "Other")
    assert bpy.ops.stillwater.bake(picture="Lake") == {"FINISHED"}
    assert scene.stillwater.pictures[0].tree is not None and scene.stillwater.pictures[1].tree is None
    with pytest.raises(RuntimeError, match="Sea: the scene has no picture of this name"):
        bpy.ops.stillwater.bake(picture="Sea")


def test_sidebars_and_status_bars_are_drawn_anew(extension, monkeypatch):
    """A tool that is at work may have set the status text: it stays."""
    drawn = []
    region = lambda kind: SimpleNamespace(type=kind, tag_redraw=lambda: drawn.append(kind))  # noqa: E731
    areas = [SimpleNamespace(type=kind, regions=[region("UI"), region("WINDOW")]) for kind in ("VIEW_3D", "PROPERTIES")]
    clear = SimpleNamespace(status_text_set=drawn.append)
    screen = SimpleNamespace(areas=areas)
    windows = [SimpleNamespace(screen=screen, workspace=clear, modal_operators=modal) for modal in ([], [1])]
    context = SimpleNamespace(window_manager=SimpleNamespace(windows=windows), temp_override=lambda **_: nullcontext())
    monkeypatch.setattr(extension.ui.redraw, "bpy", SimpleNamespace(context=context))
    extension.ui.redraw.panels()
    assert drawn == ["UI", "UI"]
    extension.ui.redraw.status_bars()
    assert drawn == ["UI", "UI", None]


@pytest.mark.parametrize("mode", ["hang", "deaf"])
def test_cancel_ends_the_worker_and_keeps_the_frames(extension, saved, worker, state, mode):
    worker(mode)
    tree = extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    until(extension, lambda: "nothing at all" in state().message)
    assert state().message == "Preparing nothing at all, 90%"
    bpy.ops.stillwater.cancel()
    until(extension, lambda: not extension.bake.job.running(tree))
    assert (state().state, state().message) == ("cancelled", "Cancelled after 3 frames")
    assert len(list((saved / "frames").iterdir())) == 3
    assert not bpy.ops.stillwater.cancel.poll()


def test_one_picture_is_baked_once_at_a_time(extension, worker, state):
    worker("hang")
    extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    with pytest.raises(RuntimeError, match="Lake: is being baked already"):
        bpy.ops.stillwater.bake()


def test_fresh_is_passed_on(worker, saved):
    worker("plain")
    bpy.ops.stillwater.bake(fresh=True)
    assert (saved / "options.txt").read_text() == "--progress json --parent --cache-limit 4 --fresh"
    bpy.ops.stillwater.bake()
    assert (saved / "options.txt").read_text() == "--progress json --parent --cache-limit 4"


def test_another_file_ends_the_worker(extension, worker):
    worker("hang")
    extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    process = next(iter(extension.bake.job._jobs.values()))[0]._process
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert process.poll() is not None


def test_a_file_saved_during_a_bake_says_that_it_was_interrupted(extension, worker, state, tmp_path):
    worker("hang")
    extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    until(extension, lambda: state().share > 0)
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "file.blend"))
    assert (state().state, state().message) == ("cancelled", "Interrupted; the frames made so far are kept")


def test_undo_during_a_bake_loses_nothing(extension, worker, state):
    worker("slow")
    bpy.ops.ed.undo_push(message="before")
    extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    bpy.ops.ed.undo_push(message="bake")  # as the operator does
    bpy.context.scene.stillwater.pictures[0].wind.speed = 9
    bpy.ops.ed.undo_push(message="wind")
    until(extension, lambda: state().share > 0)
    bpy.ops.ed.undo()
    until(extension, lambda: not extension.bake.job._jobs)
    assert bpy.context.scene.stillwater.pictures[0].wind.speed == 5
    assert (state().state, state().message) == ("done", "Baked 4 frames")


def test_undo_and_redo_during_a_bake_end_with_the_frames(extension, worker, state):
    worker("slow")
    bpy.ops.ed.undo_push(message="before")
    extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    bpy.ops.ed.undo_push(message="bake")
    for speed in (9, 10, 11):
        bpy.context.scene.stillwater.pictures[0].wind.speed = speed
        bpy.ops.ed.undo_push(message="wind")
    for step in (bpy.ops.ed.undo, bpy.ops.ed.undo, bpy.ops.ed.redo, bpy.ops.ed.undo, bpy.ops.ed.redo):
        step()
        extension.bake.job.tick()
    until(extension, lambda: not extension.bake.job._jobs)
    assert bpy.context.scene.stillwater.pictures[0].wind.speed == 10
    assert (state().state, state().there) == ("done", "5-8")


def test_undo_after_a_bake_shows_what_lies_on_disk(extension, scene, worker, state, tmp_path):
    """The step before knew of no frames; they are there all the same."""
    frames = worker("plain")
    extension.compositor.tree.ensure(scene, scene.stillwater.pictures[0])
    extension.compositor.tree.wire(scene, state().id_data)
    state().folder = "//stillwater/Lake/frames"
    state().first, state().last = 5, 8
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.stillwater.bake()
    bpy.ops.ed.undo_push(message="bake")
    bpy.ops.ed.undo()
    assert state().there == "5-8"
    same(render(bpy.context.scene, 6, tmp_path), frames[6])


def test_undo_after_a_bake_that_ended_later_keeps_its_frames(extension, scene, worker, state):
    """The image of the frames came after the last step: Blender frees it, and keeps the tree, the same in both steps."""
    worker("plain")
    extension.bake.job.start(scene, scene.stillwater.pictures[0])
    for speed in (9, 8, 7, 6):
        scene.stillwater.pictures[0].wind.speed = speed
        bpy.ops.ed.undo_push(message="wind")
    until(extension, lambda: not extension.bake.job._jobs)
    for step in (bpy.ops.ed.undo, bpy.ops.ed.redo):
        step()
        assert state().id_data.nodes["Frames"].image in list(bpy.data.images)
        shown = [link.to_socket.name for link in state().id_data.links if link.to_node.bl_idname == "NodeGroupOutput"]
        assert state().there == "5-8" and sorted(shown) == ["Alpha", "Flow", "Image", "Matte"]
        assert state().state == "done" and "Interrupted" not in state().message


def test_undoing_the_bake_itself_ends_the_worker(extension, worker):
    worker("hang")
    bpy.ops.ed.undo_push(message="before")
    extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    bpy.ops.ed.undo_push(message="bake")
    process = next(iter(extension.bake.job._jobs.values()))[0]._process
    bpy.ops.ed.undo()
    until(extension, lambda: not extension.bake.job._jobs)
    assert process.poll() is not None and bpy.context.scene.stillwater.pictures[0].tree is None


def test_the_worker_ends_with_blender(tmp_path):
    """A Blender that is killed leaves no worker behind."""
    parent = f"""
import subprocess, sys, time
worker = subprocess.Popen([sys.executable, "-c", "import sys; sys.stdin.read()"], stdin=subprocess.PIPE)
print(worker.pid, flush=True)
time.sleep(60)
"""
    with subprocess.Popen([sys.executable, "-c", parent], stdout=subprocess.PIPE, text=True) as blender:
        pid = int(blender.stdout.readline())
        blender.kill()
    end = time.monotonic() + 5
    while Path(f"/proc/{pid}").exists() and Path(f"/proc/{pid}/stat").read_text().split()[2] != "Z":
        assert time.monotonic() < end, "the worker lives on"
        time.sleep(0.02)


def test_a_worker_that_can_t_be_started_is_a_sentence(extension, saved, monkeypatch):
    monkeypatch.setattr(extension.engine, "worker_command", lambda python: ["/nowhere/python"])
    with pytest.raises(RuntimeError, match="/nowhere/python: No such file or directory"):
        bpy.ops.stillwater.bake()
    assert not extension.bake.job._jobs


def test_a_folder_that_can_t_be_made_is_a_sentence(scene, saved, worker):
    worker("plain")
    saved.parent.write_text("a file where the folder is to be")
    with pytest.raises(RuntimeError, match="stillwater.*; save the file where a folder can be made beside it"):
        bpy.ops.stillwater.bake()


def test_an_unsaved_file_bakes_into_the_user_s_folder(extension, scene, picture, worker, state):
    worker("plain")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 5, 6
    extension.properties.arrange.add_picture(scene, "Lake")
    bpy.ops.stillwater.bake()
    assert Path(state().folder).is_relative_to(os.environ["BLENDER_USER_RESOURCES"])
    assert len(list(Path(state().folder).iterdir())) == 2


def test_the_real_worker_s_command_finds_the_engine(extension):
    command = [*extension.engine.worker_command(), "schema"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert json.loads(done.stdout)["title"] == "Stillwater recipe", done.stderr
