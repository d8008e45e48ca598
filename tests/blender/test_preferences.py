"""What a person prefers reaches the worker; a Python that can't run it is explained."""

import json
import os
import shutil
import subprocess
import sys
from types import SimpleNamespace

import bpy
import pytest
import stage
from panels import Recorder
from pictures import paint
from pixels import PACKAGE


@pytest.fixture
def chosen(extension):
    """The preferences, put back afterwards."""
    chosen = extension.preferences.of(bpy.context)
    names = ("cache_folder", "cache_limit", "threads", "preview_size", "python", "stale_render")
    before = {name: getattr(chosen, name) for name in names}
    yield chosen
    for name, value in before.items():
        setattr(chosen, name, value)


def test_they_are_blender_s_preferences_of_the_extension(chosen):
    assert chosen == bpy.context.preferences.addons[PACKAGE].preferences
    assert (chosen.threads, chosen.preview_size, chosen.python, chosen.stale_render) == (0, 960, "", "WARN")


def test_they_reach_the_worker_s_command(chosen, tmp_path):
    assert chosen.worker_options() == ["--cache-limit", "4"]
    chosen.threads, chosen.cache_limit, chosen.cache_folder = 3, 2.5, str(tmp_path / "cache")
    wanted = ["--cache-limit", "2.5", "--cache", str(tmp_path / "cache"), "--threads", "3"]
    assert chosen.worker_options() == wanted


def test_a_bake_keeps_its_layers_in_the_cache_folder(chosen, scene, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "lake.png")))
    chosen.cache_folder, chosen.threads = str(tmp_path / "cache"), 1
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    assert list((tmp_path / "cache").glob("*/meta.json"))
    assert not (tmp_path / "stillwater" / "lake" / ".stillwater-cache").exists()


def test_live_pictures_have_the_cache_of_the_bake(extension, chosen, scene, tmp_path, monkeypatch):
    """Cut once, found by both; freed from both."""
    picture = stage.set_up(scene, tmp_path)
    cache = tmp_path / "cache"
    chosen.cache_folder = str(cache)
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    cut = {path: path.stat().st_mtime_ns for path in cache.glob("*/*.npy")}
    monkeypatch.setattr(extension.play.show, "seen", True)
    scene.frame_set(5)
    stage.wait(extension)
    scene.frame_set(6)
    assert picture.plane.data != picture.image
    after = {path: path.stat().st_mtime_ns for path in cache.glob("*/*.npy")}
    assert cut and len(after) > len(cut) and cut.items() <= after.items()
    assert not list((tmp_path / "stillwater").rglob(".stillwater-cache"))
    assert bpy.ops.stillwater.free_bake() == {"FINISHED"}
    assert not list(cache.glob("*/meta.json")) and not list((tmp_path / "stillwater").rglob(".stillwater-cache"))
    extension.play.server.end()


def test_another_cache_folder_counts_at_once_for_live_pictures(extension, chosen, scene, tmp_path, monkeypatch):
    monkeypatch.setattr(extension.play.show, "seen", True)
    picture = stage.set_up(scene, tmp_path)
    for name, size in (("first", 100), ("second", 200)):
        chosen.cache_folder, chosen.preview_size = str(tmp_path / name), size
        scene.frame_set(scene.frame_current + 1)
        stage.wait(extension)
        scene.frame_set(scene.frame_current + 1)
        assert picture.plane.data != picture.image and list((tmp_path / name).glob("*/meta.json"))
    extension.play.server.end()


@pytest.fixture
def wrong(tmp_path):
    """A program for each way in which a Python may be the wrong one."""
    others = {
        "silent": "exit 0",
        "broken": "echo 'ModuleNotFoundError: No module named stillwater' >&2; exit 1",
        "other": "echo 9.9.9",
    }
    for name, does in others.items():
        (tmp_path / name).write_text(f"#!/bin/sh\n{does}\n")
        (tmp_path / name).chmod(0o755)
    (tmp_path / "text").write_text("no program")
    return tmp_path


@pytest.mark.parametrize(
    "name, words",
    [
        ("none", "can't be started (No such file or directory)"),
        ("text", "can't be started (Permission denied)"),
        ("silent", "can't load the engine, which is built for Python 3."),
        ("broken", "(ModuleNotFoundError: No module named stillwater)"),
        ("other", "(9.9.9)"),
    ],
)
def test_a_wrong_python_is_explained_in_a_sentence(chosen, wrong, name, words):
    if name == "text" and os.access(wrong / "text", os.X_OK):
        pytest.skip("this disk knows no programs from texts")
    chosen.python = str(wrong / name)
    assert chosen.python_problem.startswith(f"{wrong / name}: ") and words in chosen.python_problem
    with pytest.raises(RuntimeError, match=f"{name}: "):
        bpy.ops.stillwater.try_python()


def test_a_python_that_gives_no_answer_is_not_waited_for(extension, chosen, wrong, monkeypatch):
    monkeypatch.setattr(extension.engine, "TRIAL", 0.5)
    (wrong / "silent").write_text("#!/bin/sh\nexec sleep 30\n")
    assert "gave no answer within 0.5 s" in extension.engine.python_problem(str(wrong / "silent"))


def test_the_right_one_is_found_by_itself_and_taken_where_it_is_given(extension, chosen):
    assert bpy.ops.stillwater.try_python() == {"FINISHED"}
    assert extension.engine.worker_command("")[0] == sys.executable
    chosen.python = shutil.which(sys.executable)
    assert chosen.python_problem == "" and bpy.ops.stillwater.try_python() == {"FINISHED"}
    command = [*extension.engine.worker_command(chosen.python), "schema"]
    assert json.loads(subprocess.run(command, capture_output=True, timeout=60).stdout)["title"]


def test_a_bake_with_a_wrong_python_says_so(chosen, scene, wrong, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "lake.png")))
    chosen.python = str(wrong / "broken")
    with pytest.raises(RuntimeError, match="ended with code 1: ModuleNotFoundError: No module named stillwater"):
        bpy.ops.stillwater.bake()


def test_they_are_drawn(chosen, wrong):
    chosen.python = str(wrong / "none")
    shown = {name: getattr(chosen, name) for name in type(chosen).__annotations__}
    layout = Recorder()
    type(chosen).draw(SimpleNamespace(layout=layout, **shown), bpy.context)
    assert set(type(chosen).__annotations__) - {"python_problem"} == set(layout.properties)
    assert layout.operators == ["stillwater.clear_unsaved", "stillwater.try_python"]
    assert "can't be started" in " ".join(layout.texts)
