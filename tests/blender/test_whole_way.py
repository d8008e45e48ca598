"""The whole way: the installed engine bakes a small recipe, and the node gives what its frames hold."""

import os
import shutil
import signal
import subprocess
import time

import bpy
import pytest
from pixels import read_frame, render, same


def test_the_node_gives_what_the_engine_made(painted, tmp_path):
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    state = bpy.context.scene.stillwater.pictures[0].tree.stillwater
    assert (state.state, state.message) == ("done", "Baked 4 frames")
    for frame in range(5, 9):
        same(render(bpy.context.scene, frame, tmp_path), read_frame(painted / f"frame_{frame:04d}.exr"))


def test_frames_that_are_right_are_kept_and_others_made_anew(painted):
    bpy.ops.stillwater.bake()
    times = lambda: {path.name: path.stat().st_mtime_ns for path in painted.glob("*.exr")}  # noqa: E731
    before = times()
    bpy.ops.stillwater.bake()
    assert times() == before and len(before) == 4
    bpy.context.scene.stillwater.pictures[0].wind.speed = 10
    bpy.ops.stillwater.bake()
    assert not set(times().items()) & set(before.items())


def test_the_engine_s_sentence_reaches_the_artist(painted):
    bpy.context.scene.stillwater.pictures[0].layers[0].matte.form = "none"
    with pytest.raises(RuntimeError, match=r"tree, matte: missing \(only the last layer needs none\)"):
        bpy.ops.stillwater.bake()


def start(extension):
    return extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0], fresh=True)


def until(extension, condition, seconds=30):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        extension.bake.job.tick()
        time.sleep(0.005)


def test_a_killed_worker_is_told_and_the_next_bake_goes_on(extension, painted):
    bpy.context.scene.frame_end = 200
    bpy.context.scene.stillwater.pictures[0].output.scale = 16  # slow enough to be killed between two frames
    tree = start(extension)
    until(extension, lambda: len(list(painted.glob("frame_*.exr"))) > 2)
    worker = extension.bake.job._jobs[tree.session_uid][0]
    os.kill(worker._process.pid, signal.SIGKILL)
    until(extension, lambda: not extension.bake.job.running(tree))
    assert tree.stillwater.state == "failed" and "The worker was ended by SIGKILL" in tree.stillwater.message
    made = len(list(painted.glob("frame_*.exr")))
    assert 2 < made < 196
    bpy.context.scene.frame_end = 5 + made  # not all 196 of them
    bpy.ops.stillwater.bake()
    assert tree.stillwater.state == "done" and tree.stillwater.message == f"Baked 1 frame, {made} were right already"
    assert not [path for path in painted.iterdir() if not path.name.startswith("frame_")]


def test_a_cancelled_bake_goes_on_where_it_stopped(extension, painted):
    bpy.context.scene.frame_end = 200
    bpy.context.scene.stillwater.pictures[0].output.scale = 16
    tree = start(extension)
    until(extension, lambda: len(list(painted.glob("frame_*.exr"))) > 1)
    bpy.ops.stillwater.cancel()
    until(extension, lambda: not extension.bake.job.running(tree))
    made = len(list(painted.glob("frame_*.exr")))
    assert tree.stillwater.state == "cancelled" and tree.stillwater.there == f"5-{4 + made}"
    bpy.context.scene.frame_end = 5 + made
    bpy.ops.stillwater.bake()
    assert tree.stillwater.message.startswith("Baked 1 frame, ")


def test_a_missing_picture_is_a_sentence(painted):
    bpy.context.scene.stillwater.pictures[0].picture = "//none.png"
    with pytest.raises(RuntimeError, match=r"none.png: there is no such picture"):
        bpy.ops.stillwater.bake()


@pytest.fixture
def small_disk(painted):
    """The picture's folder on a disk of its own that is nearly full."""
    if os.geteuid() != 0:
        pytest.skip("a disk of its own is mounted by root only")
    if shutil.which("mount") is None:
        pytest.skip("there is no program named mount here")
    place = painted.parent
    place.mkdir(parents=True, exist_ok=True)
    command = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(place)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        pytest.skip(f"no disk can be mounted here: {done.stderr.strip()}")
    yield place
    subprocess.run(["umount", str(place)], check=True)


def test_a_full_disk_is_a_sentence_and_no_harm(small_disk, painted):
    picture = bpy.context.scene.stillwater.pictures[0]
    picture.output.scale = 16
    with pytest.raises(RuntimeError, match="the disk is full|No space left on device"):
        bpy.ops.stillwater.bake()
    assert picture.tree.stillwater.state == "failed"
    subprocess.run(["mount", "-o", "remount,size=64m", str(small_disk)], check=True)
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    assert picture.tree.stillwater.state == "done"


def test_a_folder_that_can_only_be_read_is_a_sentence(small_disk, painted):
    subprocess.run(["mount", "-o", "remount,ro", str(small_disk)], check=True)
    with pytest.raises(RuntimeError, match="Read-only file system; save the file where a folder can be made beside it"):
        bpy.ops.stillwater.bake()
    assert not bpy.context.scene.stillwater.pictures[0].tree.stillwater.there
