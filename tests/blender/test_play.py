"""Live pictures: each frame on the plane is the bake's, whatever changes, is undone, saved or goes wrong."""

import json
import os
import shutil
import signal

import bpy
import numpy as np
import pytest
import stage
from panels import draw, registered
from pixels import read_frame

AS_SEEN = 2.3e-4  # scene-linear: 1/40 of a level of 256 on the screen (display_to_screen)


@pytest.fixture
def live(extension, scene, tmp_path, monkeypatch):
    """A picture that is shown live, as where somebody looks."""
    monkeypatch.setattr(extension.play.show, "seen", True)
    picture = stage.set_up(scene, tmp_path)
    yield picture
    extension.play.server.end()


def plane_pixels(picture):
    return stage.pixels_of(picture.plane.data)


def baked(tmp_path, frame):
    return read_frame(tmp_path / "stillwater" / "lake" / "frames" / f"frame_{frame:04d}.exr")["Image"]


def shows_original(picture):
    return picture.plane.data == picture.image


def panel_texts():
    return draw(next(cls for cls in registered("view_3d") if cls.bl_label == "Live")).texts


def test_every_frame_on_the_plane_is_the_bake_s(extension, scene, live, tmp_path):
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    scene.frame_set(5)
    stage.wait(extension)
    for frame in (7, 5, 8, 6):
        scene.frame_set(frame)
        np.testing.assert_allclose(plane_pixels(live), baked(tmp_path, frame), atol=AS_SEEN)
    assert panel_texts() == ["16 x 8 px"]


def test_until_it_is_prepared_the_picture_stands_and_the_panel_says_so(extension, scene, live):
    scene.frame_set(6)
    assert shows_original(live) and panel_texts() == ["Preparing 0%"]
    stage.wait(extension)
    scene.frame_set(6)
    assert not shows_original(live)


@pytest.fixture
def shown(extension, scene, live):
    """The picture, at frame 6, prepared."""
    scene.frame_set(6)
    stage.wait(extension)
    scene.frame_set(6)
    assert not shows_original(live)
    return live


def test_what_was_prepared_is_shown_at_once(extension, scene, live):
    scene.frame_set(6)
    assert shows_original(live)
    stage.wait(extension)
    assert not shows_original(live)


def test_a_number_changes_what_is_seen_without_preparing(extension, scene, shown, monkeypatch):
    monkeypatch.setattr(extension.play.server, "prepare", lambda *_: pytest.fail("prepared"))
    before = plane_pixels(shown)
    shown.wind.speed = 8
    scene.update_tag()
    bpy.context.view_layer.update()
    after = plane_pixels(shown)
    assert np.abs(after - before).max() > 0.01
    shown.wind.speed = 20
    scene.frame_set(6)
    np.testing.assert_array_equal(plane_pixels(shown), before)


def test_keys_count_by_their_integral_as_in_a_bake(extension, scene, shown, tmp_path):
    shown.layers[0].motion.type = "drift"
    shown.layers[0].motion.drift.use_velocity = True
    for frame, speed in ((5, 0.0), (7, 3.0)):
        shown.layers[0].motion.drift.velocity = (speed, 0)
        scene.keyframe_insert("stillwater.pictures[0].layers[0].motion.drift.velocity", frame=frame)
    assert bpy.ops.stillwater.bake() == {"FINISHED"}
    scene.frame_set(7)
    stage.wait(extension)  # what drifts is made endless
    for frame in (8, 6):
        scene.frame_set(frame)
        np.testing.assert_allclose(plane_pixels(shown), baked(tmp_path, frame), atol=AS_SEEN)


def test_a_driver_is_followed(extension, scene, shown):
    before = plane_pixels(shown)
    driver = scene.driver_add("stillwater.pictures[0].layers[0].opacity").driver
    driver.expression = "0.25 if frame == 7 else 1.0"
    scene.frame_set(7)
    assert abs(shown.layers[0].opacity - 0.25) < 1e-6
    solo = plane_pixels(shown)
    shown.layers[0].driver_remove("opacity")
    shown.layers[0].opacity = 1
    scene.frame_set(7)
    assert np.abs(plane_pixels(shown) - solo).max() > 1e-3
    scene.frame_set(6)
    np.testing.assert_array_equal(plane_pixels(shown), before)


def test_off_or_still_it_shows_the_original(extension, scene, shown):
    scene.stillwater_live.on = False
    assert shows_original(shown)
    scene.frame_set(7)
    assert shows_original(shown)
    scene.stillwater_live.on = True
    assert not shows_original(shown)
    scene.stillwater_live.view = "original"
    assert shows_original(shown)
    scene.stillwater_live.view = "picture"
    shown.layers[0].motion.type = "still"
    scene.frame_set(6)
    assert shows_original(shown) and panel_texts()[0].startswith("Nothing moves")


def test_the_active_layer_is_shown_alone_and_as_its_matte(scene, shown):
    shown.active_layer = 1
    scene.stillwater_live.view = "layer"
    behind = plane_pixels(shown)
    shown.active_layer = 0
    scene.frame_set(6)
    assert np.abs(plane_pixels(shown) - behind).max() > 0.01
    scene.stillwater_live.view = "matte"
    grey = plane_pixels(shown)
    assert np.ptp(grey[..., :3], axis=-1).max() == 0 and (grey[..., 3] == 1).all()
    assert abs(grey[4, 5, 0] - 1) < AS_SEEN and grey[4, 15, 0] == 0


def test_another_matte_is_prepared_and_the_last_result_stands_meanwhile(extension, scene, shown, tmp_path):
    before = plane_pixels(shown)
    shown.layers[0].feather = 2
    scene.frame_set(6)
    np.testing.assert_array_equal(plane_pixels(shown), before)
    assert panel_texts()[0].startswith("Preparing")
    stage.wait(extension)
    scene.frame_set(6)
    assert np.abs(plane_pixels(shown) - before).max() > 1e-3


def test_a_wrong_recipe_is_a_sentence_with_the_layer_s_name(extension, scene, shown):
    shown.layers[0].matte.form = "none"
    scene.frame_set(7)
    assert shows_original(shown)
    assert "tree, matte: missing (only the last layer needs none)" in " ".join(panel_texts())
    shown.layers[0].matte.form = "file"
    scene.frame_set(7)
    assert not shows_original(shown)


def test_a_missing_file_is_a_sentence_and_is_found_again(extension, scene, shown, tmp_path):
    matte = tmp_path / "lake" / "matte.png"
    matte.rename(tmp_path / "away.png")
    scene.stillwater_live.on = False
    scene.stillwater_live.on = True
    assert shows_original(shown) and "there is no such file" in " ".join(panel_texts())
    (tmp_path / "away.png").rename(matte)
    scene.stillwater_live.on = False
    scene.stillwater_live.on = True
    assert not shows_original(shown)


def test_a_killed_server_is_a_sentence_and_the_next_one_is_started(extension, scene, live):
    scene.frame_set(6)
    os.kill(extension.play.server._worker._process.pid, signal.SIGKILL)
    extension.play.server._worker._process.wait(10)
    stage.wait(extension)
    assert shows_original(live) and "was ended by SIGKILL" in " ".join(panel_texts())
    scene.frame_set(7)  # not asked again by itself
    assert extension.play.server._worker is None
    scene.stillwater_live.on = False
    scene.stillwater_live.on = True
    stage.wait(extension)
    scene.frame_set(7)
    assert not shows_original(live)


def test_what_nobody_expected_is_a_sentence_too(extension, scene, shown, monkeypatch):
    monkeypatch.setattr(extension.play.recipes, "now", lambda *_: 1 / 0)
    scene.frame_set(7)
    assert shows_original(shown) and "ZeroDivisionError" in " ".join(panel_texts())


def test_a_saved_file_holds_the_original(extension, scene, shown, tmp_path):
    bpy.ops.wm.save_mainfile()
    assert not shows_original(shown)
    shutil.copy(tmp_path / "file.blend", tmp_path / "copy.blend")
    with bpy.data.libraries.load(str(tmp_path / "copy.blend")) as (inside, _):
        assert not [name for name in inside.images if name.startswith("Stillwater Live")]
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "file.blend"))
    scene = bpy.context.scene
    scene.frame_set(6)
    stage.wait(extension)
    scene.frame_set(6)
    assert not shows_original(scene.stillwater.pictures[0])


def test_at_rest_blender_has_no_changed_image_to_ask_about(extension, scene, shown):
    image, before = shown.plane.data, plane_pixels(shown)
    assert image.is_dirty and bpy.app.timers.is_registered(extension.play.plane.rest)
    assert extension.play.plane.rest() is None
    assert not image.is_dirty and shown.plane.data == image
    np.testing.assert_array_equal(plane_pixels(shown), before)


def test_undo_and_redo_leave_the_right_frame(extension, scene, shown):
    bpy.ops.ed.undo_push(message="before")
    before = plane_pixels(shown)
    shown.wind.speed = 5
    bpy.ops.ed.undo_push(message="slower")
    bpy.context.scene.frame_set(6)
    slower = plane_pixels(bpy.context.scene.stillwater.pictures[0])
    for step, wanted in ((bpy.ops.ed.undo, before), (bpy.ops.ed.redo, slower), (bpy.ops.ed.undo, before)):
        step()
        picture = bpy.context.scene.stillwater.pictures[0]
        assert not shows_original(picture)
        np.testing.assert_array_equal(plane_pixels(picture), wanted)


def test_undo_forgets_an_image_that_came_after_the_last_step(extension, scene, live):
    """Blender frees it, and keeps the plane, which is the same in both steps."""
    for speed in (9, 8, 7, 6):
        live.wind.speed = speed
        bpy.ops.ed.undo_push(message="slower")
    scene.frame_set(6)
    stage.wait(extension)
    assert not shows_original(live)
    for step in (bpy.ops.ed.undo, bpy.ops.ed.redo, bpy.ops.ed.undo):
        step()
        assert bpy.context.scene.stillwater.pictures[0].plane.data in list(bpy.data.images)


def test_an_image_that_was_removed_is_made_again(extension, scene, shown):
    before = plane_pixels(shown)
    bpy.data.images.remove(shown.plane.data)
    scene.frame_set(6)
    np.testing.assert_array_equal(plane_pixels(shown), before)


def test_a_removed_picture_leaves_no_image(extension, scene, shown):
    bpy.ops.stillwater.remove_picture("EXEC_DEFAULT", True)
    scene.update_tag()
    bpy.context.view_layer.update()
    assert not [image for image in bpy.data.images if extension.play.plane.is_live(image)]


def test_nothing_is_shown_in_a_render(extension, scene, shown, tmp_path):
    scene.frame_set(5)
    taken = plane_pixels(shown)
    scene.render.filepath = str(tmp_path / "rendered_")
    scene.render.use_compositing = False
    scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    scene.frame_set(5)
    bpy.ops.render.render(animation=True)
    np.testing.assert_array_equal(plane_pixels(shown), taken)


def test_frames_are_no_slower_for_what_did_not_change(extension, scene, shown, monkeypatch):
    """While Blender plays, the recipe is looked at only where something changed."""
    looked = []
    now = extension.play.recipes.now
    monkeypatch.setattr(extension.play.recipes, "now", lambda *given: looked.append(1) or now(*given))
    monkeypatch.setattr(extension.play.handlers, "_playing", lambda: True)
    for frame in (5, 6, 7):
        scene.frame_set(frame)
    assert not looked
    shown.wind.speed = 3
    scene.update_tag()
    bpy.context.view_layer.update()
    assert not looked  # the next frame shows it: nothing is queued
    scene.frame_set(8)
    scene.frame_set(5)
    assert len(looked) == 1


def test_the_request_is_what_serve_reads(extension, scene, shown, monkeypatch):
    told = []
    monkeypatch.setattr(extension.bake.worker.Worker, "tell", lambda self, request: told.append(request))
    shown.layers[0].feather = 1
    for frame in (6, 7):
        scene.frame_set(frame)
    (request,) = told  # asked once
    assert request["do"] == "prepare" and request["longest"] == 960
    with open(request["recipe"]) as file:
        assert json.load(file)["layers"][0]["name"] == "tree"
