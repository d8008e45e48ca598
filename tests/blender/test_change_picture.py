"""Another file for a picture, or the same one changed on disk; at another size what lies over it goes with it."""

import importlib

import bpy
import numpy as np
import pytest
from mathutils import Vector
from pictures import HEIGHT, WIDTH, look_at, paint, rendered
from pixels import PACKAGE

pixels_to_world = importlib.import_module(f"{PACKAGE}.properties.plane").pixels_to_world


@pytest.fixture
def path(tmp_path):
    return paint(tmp_path / "lake.png")


@pytest.fixture
def picture(scene, path):
    bpy.ops.stillwater.open_picture(filepath=str(path))
    return scene.stillwater.active()


def shown(picture) -> np.ndarray:
    """The picture as its image has it, 8 bit, rows from the top."""
    width, height = picture.image.size
    return (np.array(picture.image.pixels[:]).reshape(height, width, 4)[::-1, :, :3] * 255).round()


def on_disk(path) -> np.ndarray:
    image = bpy.data.images.load(str(path))
    pixels = (np.array(image.pixels[:]).reshape(image.size[1], image.size[0], 4)[::-1, :, :3] * 255).round()
    bpy.data.images.remove(image)
    return pixels


def test_a_picture_that_changed_on_disk_is_read_again(scene, picture, path, tmp_path):
    before = rendered(scene, tmp_path / "before.exr")
    image, tree = picture.image, picture.tree
    paint(path, seed=2)
    assert bpy.ops.stillwater.reload_picture("EXEC_DEFAULT", True) == {"FINISHED"}
    assert np.array_equal(shown(picture), on_disk(path))
    assert np.abs(rendered(scene, tmp_path / "after.exr") - before).max() > 0.1
    assert (picture.image, picture.tree, picture.plane.data) == (image, tree, image)


@pytest.mark.parametrize("name", ["other.png", "other.exr", "other.tif"])
def test_another_file_takes_its_place(scene, picture, tmp_path, name):
    kept = picture.id, picture.plane, picture.camera, picture.strokes, picture.tree
    other = paint(tmp_path / "further" / name, seed=3)
    before = rendered(scene, tmp_path / "before.exr")
    bpy.ops.stillwater.replace_picture("EXEC_DEFAULT", True, filepath=str(other))
    assert (picture.id, picture.plane, picture.camera, picture.strokes, picture.tree) == kept
    assert picture.picture == str(other) and picture.image.filepath == str(other)
    assert picture.image.colorspace_settings.name == ("Linear Rec.709" if name.endswith("exr") else "sRGB")
    assert np.abs(rendered(scene, tmp_path / "after.exr") - before).max() > 0.1


def test_a_picture_of_no_file_gets_one(extension, scene, path):
    extension.properties.arrange.add_picture(scene, "Lake")
    with pytest.raises(RuntimeError, match="This picture has no file yet"):
        bpy.ops.stillwater.reload_picture()
    bpy.ops.stillwater.replace_picture(filepath=str(path))
    assert tuple(scene.stillwater.active().picture_size) == (WIDTH, HEIGHT)


def test_undo_brings_the_former_file_back(scene, picture, path, tmp_path):
    bpy.ops.ed.undo_push(message="before")
    other = paint(tmp_path / "other.png", (20, 40), seed=3)
    bpy.ops.stillwater.replace_picture("EXEC_DEFAULT", True, filepath=str(other))
    bpy.ops.ed.undo()
    picture = bpy.context.scene.stillwater.active()
    assert picture.picture == str(path) and tuple(picture.picture_size) == (WIDTH, HEIGHT)
    assert tuple(picture.image.size) == (WIDTH, HEIGHT) and np.array_equal(shown(picture), on_disk(path))
    assert bpy.context.scene.render.resolution_x == WIDTH
    bpy.ops.ed.redo()
    assert tuple(bpy.context.scene.stillwater.active().image.size) == (20, 40)


@pytest.mark.parametrize("size", [(2 * WIDTH, 2 * HEIGHT), (WIDTH // 2, HEIGHT), (HEIGHT, WIDTH), (WIDTH, 3 * HEIGHT)])
def test_strokes_and_places_stay_over_the_same_part_of_the_picture(scene, picture, path, size):
    layer = picture.layers[0]
    layer.motion.sway.armature_root, layer.motion.sway.armature_tip = (12, 24), (12, 8)
    layer.motion.bob.waterline.add().place = (6, 16)
    picture.view.horizon_start = (0, 8)
    layer.feather = 2
    picture.strokes.rotation_euler.z, picture.strokes.location = 0.4, (0.3, -0.2, 0)
    bpy.context.view_layer.update()
    in_strokes = picture.strokes.matrix_world.inverted() @ pixels_to_world(picture) @ Vector((12, 24, 0, 1))

    paint(path, size)
    bpy.ops.stillwater.reload_picture()
    wide, high = size[0] / WIDTH, size[1] / HEIGHT
    assert tuple(picture.picture_size) == size == (scene.render.resolution_x, scene.render.resolution_y)
    assert tuple(layer.motion.sway.armature_root) == pytest.approx((12 * wide, 24 * high))
    assert tuple(layer.motion.bob.waterline[0].place) == pytest.approx((6 * wide, 16 * high))
    assert tuple(picture.view.horizon_start) == pytest.approx((0, 8 * high))
    assert layer.feather == pytest.approx(2 * (wide * high) ** 0.5)
    assert not layer.motion.drift.is_property_set("wind")
    in_pixels = pixels_to_world(picture).inverted() @ picture.strokes.matrix_world @ in_strokes
    assert tuple(in_pixels.xyz) == pytest.approx((12 * wide, 24 * high, 0), abs=1e-4)
    for pixel, corner in (((0, 0), (0, 1)), (size, (1, 0))):
        assert look_at(scene, pixels_to_world(picture) @ Vector((*pixel, 0, 1))) == pytest.approx(corner, abs=1e-5)


def test_keyed_speeds_go_with_the_size(scene, picture, path):
    drift = picture.layers[0].motion.drift
    for frame, speed in ((1, (1, 2)), (10, (3, 4))):
        drift.velocity = speed
        drift.keyframe_insert("velocity", frame=frame)
    paint(path, (2 * WIDTH, 3 * HEIGHT))
    bpy.ops.stillwater.reload_picture()
    scene.frame_set(10)
    assert tuple(drift.velocity) == pytest.approx((6, 12))
    scene.frame_set(1)
    assert tuple(drift.velocity) == pytest.approx((2, 6))


def test_a_render_size_of_the_artist_s_own_stays(scene, picture, path):
    scene.render.resolution_x = 1000
    paint(path, (20, 20))
    bpy.ops.stillwater.reload_picture()
    assert scene.render.resolution_x == 1000 and tuple(picture.picture_size) == (20, 20)


def test_a_missing_file_is_a_sentence_and_is_found_again(scene, picture, path, tmp_path):
    path.rename(tmp_path / "moved.png")
    with pytest.raises(RuntimeError, match="lake.png: there is no such picture"):
        bpy.ops.stillwater.reload_picture()
    assert tuple(picture.picture_size) == (WIDTH, HEIGHT) and picture.image is not None
    bpy.ops.stillwater.replace_picture(filepath=str(tmp_path / "moved.png"))
    assert not picture.missing and np.array_equal(shown(picture), on_disk(tmp_path / "moved.png"))


def test_a_file_that_is_missing_when_the_blend_is_opened_is_said(extension, scene, picture, path, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    path.rename(tmp_path / "moved.png")
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "file.blend"))
    picture = bpy.context.scene.stillwater.active()
    assert picture.missing
    (tmp_path / "moved.png").rename(path)
    bpy.ops.stillwater.reload_picture()
    assert not picture.missing and np.array_equal(shown(picture), on_disk(path))


def test_blender_s_own_search_for_missing_files_counts(scene, picture, path, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    (tmp_path / "deep").mkdir()
    path.rename(tmp_path / "deep" / "lake.png")
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.file.find_missing_files(directory=str(tmp_path / "deep"))
    bpy.ops.stillwater.reload_picture()
    picture = bpy.context.scene.stillwater.active()
    assert picture.picture == "//deep/lake.png" and not picture.missing


def test_a_path_set_by_a_script_is_followed(scene, picture, tmp_path):
    other = paint(tmp_path / "other.png", (20, 10), seed=5)
    picture.picture = str(other)
    assert picture.image.filepath == str(other)
    bpy.ops.stillwater.reload_picture()
    assert tuple(picture.picture_size) == (20, 10) and np.array_equal(shown(picture), on_disk(other))


def test_the_recipe_is_of_the_new_size(extension, scene, picture, path, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    paint(path, (20, 10))
    with pytest.raises(RuntimeError, match="lake: its file has 20 x 10 pixels now, not 48 x 32: use Reload Picture"):
        bpy.ops.stillwater.bake()
    bpy.ops.stillwater.reload_picture()
    assert bpy.ops.stillwater.bake() == {"FINISHED"}


def test_a_colour_space_chosen_on_the_image_counts(extension, picture):
    picture.image.colorspace_settings.name = "Linear Rec.709"
    extension.properties.image.take_over(picture)
    assert picture.colour_space == "linear"
    picture.image.colorspace_settings.name = "sRGB"
    extension.properties.image.take_over(picture)
    assert picture.colour_space == "srgb"


def test_a_colour_space_that_the_engine_has_not_is_said(extension, scene, picture, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    picture.image.colorspace_settings.name = "ACEScg"
    with pytest.raises(RuntimeError, match="lake: its image is in ACEScg, which can't be animated; choose a Color"):
        bpy.ops.stillwater.bake()
    picture.colour_space = "linear"
    assert picture.image.colorspace_settings.name == "Linear Rec.709" and bpy.ops.stillwater.bake() == {"FINISHED"}


def test_an_image_that_was_removed_is_read_again(scene, picture):
    bpy.data.images.remove(picture.image)
    bpy.ops.stillwater.show_picture("EXEC_DEFAULT", True)
    assert tuple(picture.image.size) == (WIDTH, HEIGHT) and picture.plane.data == picture.image


def test_a_reload_of_a_picture_in_another_colour_space_keeps_it(scene, picture, path):
    picture.colour_space = "linear"
    paint(path, seed=9)
    bpy.ops.stillwater.reload_picture()
    assert picture.image.colorspace_settings.name == "Linear Rec.709" and picture.colour_space == "linear"


def test_the_render_is_as_large_as_the_frames(scene, picture):
    picture.output.scale = 0.5
    assert (scene.render.resolution_x, scene.render.resolution_y) == (WIDTH // 2, HEIGHT // 2)
    picture.output.scale = 2
    assert (scene.render.resolution_x, scene.render.resolution_y) == (WIDTH * 2, HEIGHT * 2)
    scene.render.resolution_x = 1000  # the artist's own
    picture.output.scale = 1
    assert scene.render.resolution_x == 1000
