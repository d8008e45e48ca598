"""Files of every version are opened and brought up to the present one; one of each is kept in files/."""

import shutil
from pathlib import Path

import bpy
import pytest
from panels import draw, registered

FILES = sorted(Path(__file__).with_name("files").glob("version_*.blend"))


@pytest.fixture
def kept(tmp_path):
    """Copies of the kept files, and the picture beside them."""
    shutil.copytree(Path(__file__).with_name("files"), tmp_path / "files")
    return tmp_path / "files"


def version_of(path: Path) -> int:
    return int(path.stem.removeprefix("version_"))


def holds_what_it_held(scene) -> None:
    """What files/make.py wrote is all there."""
    picture = scene.stillwater.active()
    assert (picture.name, [layer.name for layer in picture.layers]) == ("Lake", ["tree", "lake", "sky"])
    tree, lake, _ = picture.layers
    assert (tree.matte.form, tree.motion.type, lake.matte.value) == ("file", "sway", 3)
    assert Path(bpy.path.abspath(tree.matte.file)).samefile(bpy.path.abspath(picture.picture))
    assert tuple(tree.motion.sway.armature_root) == (4, 7) and lake.motion.ripple.tile == 80
    assert tuple(picture.view.horizon_end) == (16, 3) and len(picture.id) == 12
    bpy.context.view_layer.update()  # Blender evaluates a scene that was just appended from its second change on
    for frame, speed in ((1, 3), (24, 9)):
        scene.frame_set(frame)
        assert picture.wind.speed == pytest.approx(speed)


def is_up_to_date(extension, scene) -> None:
    assert scene.stillwater.version == extension.properties.migrate.VERSION
    picture = scene.stillwater.active()
    assert tuple(picture.picture_size) == (16, 8) == tuple(picture.image.size) and not picture.missing
    bpy.ops.stillwater.show_picture("EXEC_DEFAULT", True)
    assert scene.camera == picture.camera and picture.plane.data == picture.image


def test_a_file_of_every_version_is_kept(extension):
    assert [version_of(path) for path in FILES] == list(range(extension.properties.migrate.VERSION + 1))
    assert set(extension.properties.migrate.STEPS) == set(range(extension.properties.migrate.VERSION))


@pytest.mark.parametrize("name", [path.name for path in FILES])
def test_a_file_that_is_opened_is_upgraded(extension, kept, name):
    bpy.ops.wm.open_mainfile(filepath=str(kept / name))
    holds_what_it_held(bpy.context.scene)
    is_up_to_date(extension, bpy.context.scene)
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=str(kept / name))
    holds_what_it_held(bpy.context.scene)


@pytest.mark.parametrize("name", [path.name for path in FILES])
def test_a_scene_that_is_appended_is_upgraded(extension, kept, tmp_path, name):
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "other.blend"))
    with bpy.data.libraries.load(str(kept / name)) as (_, wanted):
        wanted.scenes = ["Scene"]
    bpy.context.window.scene = wanted.scenes[0]
    assert wanted.scenes[0].stillwater.active().picture == "//files/lake.png"
    holds_what_it_held(wanted.scenes[0])
    is_up_to_date(extension, wanted.scenes[0])


@pytest.mark.parametrize("name", [path.name for path in FILES])
def test_a_missing_picture_is_said_and_can_be_found(extension, kept, tmp_path, name):
    (kept / "lake.png").rename(tmp_path / "found.png")
    bpy.ops.wm.open_mainfile(filepath=str(kept / name))
    assert bpy.context.scene.stillwater.active().missing
    bpy.ops.stillwater.replace_picture(filepath=str(tmp_path / "found.png"))
    is_up_to_date(extension, bpy.context.scene)


def test_a_newer_file_is_left_as_it_is_and_said(extension, kept, tmp_path):
    bpy.ops.wm.open_mainfile(filepath=str(kept / FILES[-1].name))
    bpy.context.scene.stillwater.version = 1000
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=str(kept / FILES[-1].name))
    assert bpy.context.scene.stillwater.version == 1000
    assert "A newer Stillwater made this scene" in " ".join(draw(registered("view_3d")[0]).texts)


def test_a_scene_without_pictures_is_not_touched(extension, scene):
    assert scene.stillwater.version == 0
    extension.properties.migrate.upgrade(scene)
    assert scene.stillwater.version == 0
    extension.properties.arrange.add_picture(scene, "Lake")
    assert scene.stillwater.version == extension.properties.migrate.VERSION
