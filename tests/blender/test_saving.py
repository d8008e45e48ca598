"""A .blend that is saved, moved, opened again or appended: its pictures and frames go on."""

import importlib
import os
import shutil
from pathlib import Path

import bpy
import numpy as np
import pytest
from pictures import HEIGHT, WIDTH, paint, rendered
from pixels import PACKAGE, read_frame, write_frame

paths = importlib.import_module(f"{PACKAGE}.properties.paths")
FRAME_SIZE = 16, 8


@pytest.fixture
def picture(scene, tmp_path):
    """A picture in a file that is not saved, with a matte beside it."""
    (tmp_path / "art").mkdir()
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "art" / "lake.png")))
    picture = scene.stillwater.active()
    picture.layers[0].matte.form, picture.layers[0].matte.file = "file", str(paint(tmp_path / "art" / "matte.png"))
    return picture


@pytest.fixture
def baked(extension, scene, picture):
    """The picture with frames 5 to 8 in its folder, as a bake leaves them."""
    folder = extension.bake.places.frames_of(picture)
    for number in range(5, 9):
        write_frame(folder / f"frame_{number:04d}.exr", number)
    (folder.parent / "recipe.json").write_text("{}")
    tree = picture.tree
    tree.stillwater.folder = extension.bake.places.locate_in(folder)(".")
    tree.stillwater.first, tree.stillwater.last = 5, 8
    extension.compositor.tree.show(tree)
    scene.render.resolution_x, scene.render.resolution_y = FRAME_SIZE
    return folder


def active():
    return bpy.context.scene.stillwater.active()


def shows_its_frame(tmp_path, number=6) -> None:
    """The scene's render is the frame that lies in the tree's folder."""
    scene = bpy.context.scene
    folder = Path(bpy.path.abspath(active().tree.stillwater.folder))
    scene.frame_set(number)
    shown = rendered(scene, tmp_path / "shown.exr")
    np.testing.assert_array_equal(shown, read_frame(folder / f"frame_{number:04d}.exr")["Image"][..., :3])


def works(folder: Path) -> None:
    """Picture, matte and image are found below `folder`, by relative paths."""
    picture = active()
    for path in (picture.picture, picture.layers[0].matte.file, picture.image.filepath):
        assert path.startswith("//") and Path(bpy.path.abspath(path)).resolve().is_relative_to(folder.resolve()), path
        assert Path(bpy.path.abspath(path)).exists()
    picture.image.reload()
    assert tuple(picture.image.size) == (WIDTH, HEIGHT) and not picture.missing


def test_the_first_save_makes_paths_relative_and_takes_the_frames_along(baked, tmp_path):
    assert os.environ["BLENDER_USER_RESOURCES"] in str(baked)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    assert not baked.exists() and (tmp_path / "stillwater" / "lake" / "recipe.json").exists()
    assert active().tree.stillwater.folder == "//stillwater/lake/frames"
    works(tmp_path)
    shows_its_frame(tmp_path)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "file.blend"))
    works(tmp_path)
    shows_its_frame(tmp_path)


def test_everything_moves_together(baked, tmp_path):
    (tmp_path / "project").mkdir()
    shutil.move(tmp_path / "art", tmp_path / "project" / "art")
    active().layers[0].matte.file = str(tmp_path / "project" / "art" / "matte.png")
    bpy.ops.stillwater.replace_picture(filepath=str(tmp_path / "project" / "art" / "lake.png"))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "project" / "file.blend"))
    (tmp_path / "project").rename(tmp_path / "moved")
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "moved" / "file.blend"))
    works(tmp_path / "moved")
    shows_its_frame(tmp_path)


def test_saved_elsewhere_it_finds_everything(baked, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    (tmp_path / "other" / "deep").mkdir(parents=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "other" / "deep" / "file.blend"))
    for _ in range(2):
        works(tmp_path)
        assert active().layers[0].matte.file == "//../../art/matte.png"
        shows_its_frame(tmp_path)
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "other" / "deep" / "file.blend"))


@pytest.mark.parametrize("saved", [True, False])
def test_a_copy_saved_elsewhere_finds_everything_and_so_does_the_file(baked, tmp_path, saved):
    if saved:
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    (tmp_path / "other").mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "other" / "copy.blend"), copy=True)
    picture = active()
    assert Path(bpy.path.abspath(picture.layers[0].matte.file)).exists()
    assert picture.picture.startswith("//") == saved
    picture.image.reload()
    assert tuple(picture.image.size) == (WIDTH, HEIGHT)
    shows_its_frame(tmp_path)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "other" / "copy.blend"))
    works(tmp_path)
    shows_its_frame(tmp_path)


@pytest.mark.parametrize("saved", [True, False])
def test_a_save_that_fails_changes_nothing(baked, tmp_path, saved):
    if saved:
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    before = [getattr(owner, name) for owner, name in paths.each(active())]
    (tmp_path / "locked.blend").mkdir()
    with pytest.raises(RuntimeError):
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "locked.blend"))
    assert [getattr(owner, name) for owner, name in paths.each(active())] == before
    active().image.reload()
    assert tuple(active().image.size) == (WIDTH, HEIGHT)
    shows_its_frame(tmp_path)


def test_frames_that_can_t_be_moved_stay_and_are_shown(extension, baked, tmp_path, monkeypatch):
    def refuse(source, target):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(extension.bake.folders, "move", refuse)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    state = active().tree.stillwater
    assert "No space left on device" in state.message and state.message.startswith("The frames stay in ")
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "file.blend"))
    assert Path(bpy.path.abspath(active().tree.stillwater.folder)).resolve() == baked.resolve()
    shows_its_frame(tmp_path)


def test_steps_from_before_the_first_save_show_the_frames_where_they_are_now(baked, tmp_path):
    bpy.ops.ed.undo_push(message="Baked")
    active().wind.speed = 11
    bpy.ops.ed.undo_push(message="Wind")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    assert not baked.exists()
    for step in (bpy.ops.ed.undo, bpy.ops.ed.redo):
        step()
        state = active().tree.stillwater
        assert state.folder.startswith("//stillwater") and state.there == "5-8"
        shows_its_frame(tmp_path)


def test_steps_from_before_it_was_saved_elsewhere_find_everything(baked, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    for speed in (11, 12):
        active().wind.speed = speed
        bpy.ops.ed.undo_push(message="Wind")
    (tmp_path / "other" / "deep").mkdir(parents=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "other" / "deep" / "file.blend"))
    for step, speed in ((bpy.ops.ed.undo, 11), (bpy.ops.ed.redo, 12), (bpy.ops.ed.undo, 11)):
        step()
        works(tmp_path)
        assert active().wind.speed == speed
        assert active().layers[0].matte.file == "//../../art/matte.png"
        assert active().tree.stillwater.folder == "//../../stillwater/lake/frames"
        shows_its_frame(tmp_path)


def test_blender_s_startup_file_takes_nothing_along(baked, tmp_path):
    before = [getattr(owner, name) for owner, name in paths.each(active())]
    bpy.ops.wm.save_homefile()
    assert [getattr(owner, name) for owner, name in paths.each(active())] == before and baked.exists()
    shows_its_frame(tmp_path)
    (Path(os.environ["BLENDER_USER_RESOURCES"]) / "config" / "startup.blend").unlink()


def test_a_packed_picture_says_what_to_do(baked, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    active().image.pack()
    assert bpy.ops.stillwater.bake.poll()
    (tmp_path / "art" / "lake.png").unlink()
    with pytest.raises(RuntimeError, match="lake: its picture is packed into the .blend; unpack it"):
        bpy.ops.stillwater.bake()


def test_frames_of_files_never_saved_can_be_deleted(extension, baked):
    assert not any(folder == baked.parent for folder in extension.bake.places.leftovers())
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert baked.parent in extension.bake.places.leftovers()
    assert bpy.ops.stillwater.clear_unsaved() == {"FINISHED"}
    assert not baked.exists() and not bpy.ops.stillwater.clear_unsaved.poll()


def test_an_absolute_path_stays_so_in_a_saved_file(scene, picture, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    picture.layers[0].matte.file = "/shared/matte.png"
    (tmp_path / "other").mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "other" / "file.blend"))
    assert active().layers[0].matte.file == "/shared/matte.png"


@pytest.fixture
def appended(baked, tmp_path):
    """The scene, appended to a file in another folder, or to one that is not saved; `append` may be called again."""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))

    def append():
        with bpy.data.libraries.load(str(tmp_path / "file.blend")) as (_, wanted):
            wanted.scenes = ["Scene"]
        bpy.context.window.scene = wanted.scenes[0]
        return wanted.scenes[0]

    return append


@pytest.mark.parametrize("saved", [True, False])
def test_an_appended_scene_finds_everything(appended, tmp_path, saved):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    if saved:
        (tmp_path / "elsewhere").mkdir()
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "elsewhere" / "other.blend"))
    appended()
    picture = active()
    assert Path(bpy.path.abspath(picture.layers[0].matte.file)).exists()
    assert Path(bpy.path.abspath(picture.picture)).exists() and picture.picture.startswith("//") == saved
    assert tuple(picture.image.size) == (WIDTH, HEIGHT)
    shows_its_frame(tmp_path)
    bpy.ops.stillwater.reload_picture("EXEC_DEFAULT", True)
    assert not picture.missing


def test_scenes_appended_twice_are_pictures_of_their_own(extension, appended, tmp_path):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "other.blend"))
    scenes = [appended(), appended()]
    pictures = [scene.stillwater.active() for scene in scenes]
    assert [picture.name for picture in pictures] == ["lake", "lake.001"]
    assert len({picture.id for picture in pictures}) == len({picture.tree for picture in pictures}) == 2
    assert [picture.tree.stillwater.picture for picture in pictures] == [picture.id for picture in pictures]
    assert [extension.compositor.tree.claim(scene, scene.stillwater.active()) for scene in scenes] == [
        picture.tree for picture in pictures
    ]
    assert len({extension.bake.places.folder_of(picture) for picture in pictures}) == 2
    for scene in scenes:
        bpy.context.window.scene = scene
        shows_its_frame(tmp_path)


def test_a_node_tree_appended_alone_finds_its_frames(extension, appended, tmp_path):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    (tmp_path / "elsewhere").mkdir()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "elsewhere" / "other.blend"))
    with bpy.data.libraries.load(str(tmp_path / "file.blend")) as (there, wanted):
        wanted.node_groups = [name for name in there.node_groups if name.startswith("Stillwater")]
    tree = wanted.node_groups[0]
    assert tree.stillwater.folder == "//../stillwater/lake/frames"
    assert extension.compositor.tree.show(tree) == [5, 6, 7, 8]


def test_a_linked_scene_shows_its_frames(appended, tmp_path):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(tmp_path / "file.blend"), link=True) as (_, wanted):
        wanted.scenes = ["Scene"]
    bpy.context.window.scene = wanted.scenes[0]
    wanted.scenes[0].frame_set(6)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "linking.blend"))
    shown = wanted.scenes[0].stillwater.active()
    assert shown.picture == "//art/lake.png"
    np.testing.assert_array_equal(
        rendered(bpy.context.scene, tmp_path / "shown.exr"),
        read_frame(tmp_path / "stillwater" / "lake" / "frames" / "frame_0006.exr")["Image"][..., :3],
    )


def test_a_renamed_picture_keeps_its_folder(extension, baked, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    before = extension.bake.places.folder_of(active())
    active().name = "Pond"
    assert extension.bake.places.folder_of(active()) == before


def test_two_files_in_one_folder_keep_their_frames_apart(extension, baked, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "one.blend"))
    before = extension.bake.places.folder_of(active())
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.stillwater.open_picture(filepath=str(tmp_path / "art" / "lake.png"))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "two.blend"))
    assert extension.bake.places.folder_of(active()).name == "lake.001" != before.name


@pytest.mark.parametrize(
    "path, old, new, wanted",
    [
        ("//art/a.png", "/here", "/there", "//../here/art/a.png"),
        ("//art/a.png", "/here", "/here/art", "//a.png"),
        ("//a.png", "/here", "", "/here/a.png"),
        ("/here/a.png", "", "/here", "//a.png"),
        ("/here/a.png", "/here", "/there", "/here/a.png"),
        ("/here/a.png", "/here", "", "/here/a.png"),
        ("", "/here", "/there", ""),
        ("//a.png", "", "/here", "//a.png"),
    ],
)
def test_the_same_place_seen_from_another_folder(path, old, new, wanted):
    assert paths.rebased(path, old, new) == wanted
