"""A bake is freed, collected for a farm, moved with its file; an exported recipe renders the same without Blender."""

import json
import shutil
import subprocess
import zipfile
from pathlib import Path
from types import SimpleNamespace

import bpy
import pytest
from panels import Recorder


def files(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.glob("frame_*.exr"))}


@pytest.fixture
def command(extension):
    """`python -m stillwater ...` with the engine that Blender has."""

    def run(*arguments):
        line = [*extension.engine.worker_command(), *map(str, arguments)]
        return subprocess.run(line, capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL)

    return run


@pytest.fixture
def baked(painted):
    bpy.ops.stillwater.bake()
    return painted


def test_free_deletes_frames_and_cache_and_nothing_else(extension, baked):
    (baked / "notes.txt").write_text("mine")
    (baked / "frame_0099.exr").write_text("somebody else's")
    assert bpy.ops.stillwater.free_bake() == {"FINISHED"}
    assert sorted(path.name for path in baked.iterdir()) == ["frame_0099.exr", "notes.txt"]
    assert not (baked.parent / ".stillwater-cache").exists() and (baked.parent / "recipe.json").exists()
    tree = bpy.context.scene.stillwater.pictures[0].tree
    assert (tree.stillwater.state, tree.stillwater.there, tree.stillwater.message) == ("none", "", "")
    assert tree.nodes["Frames"].image is None
    found = extension.bake.outdated.of(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    assert found.lines == ["Not baked yet"]
    assert bpy.ops.stillwater.bake() == {"FINISHED"}


def test_the_menu_offers_what_there_is(painted):
    menu = Recorder()
    bpy.types.STILLWATER_MT_bake.draw(SimpleNamespace(layout=menu), bpy.context)
    names = ["check_frames", "refresh", "export_recipe", "collect", "free_bake"]
    assert menu.operators == [f"stillwater.{name}" for name in names]


def test_nothing_is_freed_while_it_is_baked(extension, painted):
    bpy.context.scene.frame_end = 100
    extension.bake.job.start(bpy.context.scene, bpy.context.scene.stillwater.pictures[0])
    with pytest.raises(RuntimeError, match="lake: is being baked; cancel it first"):
        bpy.ops.stillwater.free_bake()
    extension.bake.job.end_all()


def test_an_exported_recipe_renders_to_the_same_bytes_without_blender(baked, command, tmp_path):
    elsewhere = tmp_path / "elsewhere" / "picture.json"
    elsewhere.parent.mkdir()
    assert bpy.ops.stillwater.export_recipe(filepath=str(elsewhere)) == {"FINISHED"}
    assert not Path(json.loads(elsewhere.read_text())["picture"]).is_absolute()
    done = command("render", elsewhere)
    assert done.returncode == 0, done.stderr
    assert files(elsewhere.parent / "frames") == files(baked) and len(files(baked)) == 4


def test_keys_and_drivers_are_in_an_exported_recipe(painted, tmp_path):
    picture = bpy.context.scene.stillwater.pictures[0]
    picture.wind.driver_add("speed").driver.expression = "frame"
    bpy.ops.stillwater.export_recipe(filepath=str(tmp_path / "a.json"))
    speed = json.loads((tmp_path / "a.json").read_text())["wind"]["speed"]
    assert speed == {"first": 1, "values": list(range(1, 10))}


@pytest.mark.parametrize("operator", ["export_recipe", "collect"])
def test_what_can_t_be_written_is_a_sentence(painted, tmp_path, operator):
    act = getattr(bpy.ops.stillwater, operator)
    with pytest.raises(RuntimeError, match="No file is named to write to"):
        act()
    (tmp_path / "file").write_text("")
    with pytest.raises(RuntimeError, match="file: |Not a directory|File exists"):
        act(filepath=str(tmp_path / "file" / "a.zip"))
    bpy.context.scene.stillwater.pictures[0].layers[0].matte.form = "none"
    with pytest.raises(RuntimeError, match=r"layers\[0\].matte: missing"):
        act(filepath=str(tmp_path / "b.zip"))
    assert not (tmp_path / "b.zip").exists()


@pytest.mark.parametrize("name", ["lake for the farm", "lake.zip"])
def test_collected_it_renders_elsewhere_to_the_same_bytes(baked, command, tmp_path, name):
    assert bpy.ops.stillwater.collect(filepath=str(tmp_path / name), frames=False) == {"FINISHED"}
    wanted = files(baked)
    there = tmp_path / "another machine"
    if name.endswith(".zip"):
        zipfile.ZipFile(tmp_path / name).extractall(there)
        assert [path.name for path in there.iterdir()] == ["lake"]
        there = there / "lake"
    else:
        shutil.move(tmp_path / name, there)
    shutil.rmtree(tmp_path / "lake")
    assert sorted(path.name for path in there.iterdir()) == ["files", "frames", "recipe.json"]
    assert sorted(path.name for path in (there / "files").iterdir()) == ["matte.png", "picture.exr"]
    done = command("render", there / "recipe.json")
    assert done.returncode == 0, done.stderr
    assert files(there / "frames") == wanted


def test_frames_that_are_baked_are_taken_along_and_kept(baked, command, tmp_path):
    (baked / "frame_0006.exr").unlink()
    bpy.ops.stillwater.collect(filepath=str(tmp_path / "farm"))
    assert list(files(tmp_path / "farm" / "frames")) == ["frame_0005.exr", "frame_0007.exr", "frame_0008.exr"]
    told = command("render", tmp_path / "farm" / "recipe.json", "--progress", "json").stdout.splitlines()
    last = json.loads(told[-1])
    assert (last["rendered"], last["kept"]) == (1, 3)


def test_a_folder_that_holds_something_is_left_alone(baked, tmp_path):
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("mine")
    with pytest.raises(RuntimeError, match="full: the folder is not empty; name a new one"):
        bpy.ops.stillwater.collect(filepath=str(tmp_path / "full"))
    assert [path.name for path in (tmp_path / "full").iterdir()] == ["mine.txt"]


def test_a_bake_moves_with_its_file(extension, baked, tmp_path):
    bpy.ops.wm.save_mainfile()
    (tmp_path / "moved").mkdir()
    for name in ("file.blend", "stillwater", "lake"):
        shutil.move(tmp_path / name, tmp_path / "moved" / name)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "moved" / "file.blend"))
    picture = bpy.context.scene.stillwater.pictures[0]
    assert extension.bake.outdated.look(bpy.context.scene, picture).lines == ["All 4 frames are ready"]
    bpy.ops.stillwater.bake()
    assert picture.tree.stillwater.message == "Baked 0 frames, 4 were right already"
