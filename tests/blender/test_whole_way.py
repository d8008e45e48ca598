"""The whole way: the installed engine bakes a small recipe, and the node gives what its frames hold."""

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
    with pytest.raises(RuntimeError, match=r"layers\[0\].matte: missing \(only the last layer needs none\)"):
        bpy.ops.stillwater.bake()
