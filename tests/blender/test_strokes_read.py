"""Strokes land where the artist sees them: through layers, objects, bones, parents and cameras."""

import importlib
from math import radians

import bpy
import numpy as np
import pytest
from bpy_extras.object_utils import world_to_camera_view
from drawings import SIZE, add_camera, draw, lay_out, on_plane, store
from mathutils import Euler, Matrix, Vector
from pixels import PACKAGE

gp_layers = importlib.import_module(f"{PACKAGE}.strokes.gp_layers")
read = importlib.import_module(f"{PACKAGE}.strokes.read")
roles = importlib.import_module(f"{PACKAGE}.strokes.roles")
plane_of = importlib.import_module(f"{PACKAGE}.properties.plane")

HORIZON = roles.by_key("horizon")
PIXELS = [(100, 700), (640, 400), (1200.5, 33.25)]
TURNED = Matrix.LocRotScale((0.4, -0.3, 0.2), Euler((0.3, -0.2, 0.5)), (1.5, 1.2, 0.8))


@pytest.fixture
def part(scene, picture):
    """The grease-pencil layer of the picture's horizon, in the object's own space."""
    lay_out(scene, picture)
    made = gp_layers.ensure(picture, "", HORIZON)
    made.parent = None
    made.translation, made.rotation, made.scale = (0, 0, 0), (0, 0, 0), (1, 1, 1)
    return made


def lands(scene, picture, pixels=PIXELS, within=0.01):
    scene.view_layers[0].update()
    found = read.strokes(scene, picture, "", HORIZON)
    np.testing.assert_allclose(found[-1].points, pixels, atol=within, rtol=0)
    return found[-1]


def local(to_world, places) -> np.ndarray:
    """Places of the world in another space."""
    return np.array([to_world.inverted() @ Vector(place) for place in places])


@pytest.mark.parametrize("kind", [None, "ORTHO", "PERSP"])
def test_a_stroke_on_the_plane_is_where_it_was_drawn(scene, picture, part, kind):
    if kind:
        add_camera(scene, picture, kind)
    draw(part, on_plane(*PIXELS))
    stroke = lands(scene, picture)
    np.testing.assert_allclose(stroke.widths, 2 * 0.05 * 160, rtol=1e-5)


@pytest.mark.parametrize("kind", [None, "ORTHO", "PERSP"])
def test_an_object_may_be_moved_turned_and_scaled_under_parents(scene, picture, part, kind):
    if kind:
        camera = add_camera(scene, picture, kind)
        camera.matrix_world = Matrix.Translation((2, 1, 9)) @ Euler((-0.3, 0.25, 0.7)).to_matrix().to_4x4()
    parent = bpy.data.objects.new("Parent", None)
    scene.collection.objects.link(parent)
    parent.matrix_world = TURNED
    picture.strokes.parent = parent
    picture.strokes.location, picture.strokes.rotation_euler, picture.strokes.scale = (1, 2, 3), (1, 0.2, 2), (2, 3, 1)
    scene.view_layers[0].update()
    draw(part, local(picture.strokes.matrix_world, on_plane(*PIXELS)))
    lands(scene, picture)


def test_the_plane_may_stand_anywhere(scene, picture, part):
    picture.plane.matrix_world = Matrix.Translation((3, -2, 1)) @ Euler((radians(90), 0, 0.4)).to_matrix().to_4x4()
    scene.view_layers[0].update()
    to_world = plane_of.pixels_to_world(picture)
    draw(part, [(to_world @ Vector((x, y, 0, 1))).xyz for x, y in PIXELS])
    lands(scene, picture)


def test_a_grease_pencil_layer_has_a_place_of_its_own(scene, picture, part):
    picture.strokes.matrix_world = TURNED
    part.translation, part.rotation, part.scale = (1, -1, 0.5), (0.2, 0.1, 1), (2, 0.5, 1)
    scene.view_layers[0].update()
    draw(part, local(TURNED @ Matrix.LocRotScale((1, -1, 0.5), Euler((0.2, 0.1, 1)), (2, 0.5, 1)), on_plane(*PIXELS)))
    lands(scene, picture)


def shown(holder) -> np.ndarray:
    """Where Blender itself has the points of an object, in the world: it makes a mesh of them."""
    bpy.context.view_layer.objects.active = holder
    holder.select_set(True)
    bpy.ops.object.convert(target="MESH", keep_original=True)
    mesh = bpy.context.object
    return np.array([mesh.matrix_world @ vertex.co for vertex in mesh.data.vertices])


@pytest.mark.parametrize("bone", ["", "Branch"], ids=["object", "bone"])
def test_a_grease_pencil_layer_follows_its_parent(scene, picture, part, bone):
    """As Blender does: an object, or a bone in its pose."""
    add_camera(scene, picture)
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    made = rig.data.edit_bones.new("Branch")
    made.head, made.tail = (0.5, 0.2, 0), (1, 1.5, 0.3)
    bpy.ops.object.mode_set(mode="OBJECT")
    rig.location, picture.strokes.location = (1, 0, 0), (0.3, 0.2, 0.1)
    scene.view_layers[0].update()
    draw(part, on_plane(*PIXELS))
    part.parent = rig
    part.parent_bone = bone
    rig.rotation_euler, rig.pose.bones["Branch"].rotation_quaternion = (0.1, 0, 0.4), (0.9, 0.3, 0.2, 0.1)
    scene.view_layers[0].update()
    world = shown(picture.strokes)
    straight_on = [((x + 4) * 160, (2.5 - y) * 160) for x, y, _ in world]  # the camera looks along z
    assert np.abs(np.array(straight_on) - PIXELS).max() > 20
    lands(scene, picture, straight_on)


CAMERAS = {
    "tilted": {"type": "PERSP", "lens": 35},
    "shifted": {"type": "PERSP", "lens": 50, "shift_x": 0.2, "shift_y": -0.3},
    "sensor fit": {"type": "PERSP", "sensor_fit": "VERTICAL", "sensor_height": 20},
    "parallel": {"type": "ORTHO", "ortho_scale": 5, "shift_x": 0.1},
}


@pytest.mark.parametrize("settings", CAMERAS.values(), ids=CAMERAS)
def test_before_the_plane_it_lands_where_the_camera_sees_it(scene, picture, part, settings):
    """A pixel's place on the plane and the stroke's are one point of the camera's frame, as Blender computes it."""
    camera = add_camera(scene, picture)
    for name, value in settings.items():
        setattr(camera.data, name, value)
    camera.matrix_world = Matrix.Translation((3, -4, 8)) @ Euler((0.5, 0.3, 0.2)).to_matrix().to_4x4()
    scene.render.pixel_aspect_x = 1.5
    places = [(1, 2, 3), (-2, 0.5, 1), (0, -1, -2)]
    draw(part, places)
    scene.view_layers[0].update()
    stroke = read.strokes(scene, picture, "", HORIZON)[0]
    to_world = plane_of.pixels_to_world(picture)
    for place, (x, y) in zip(places, stroke.points, strict=True):
        seen = world_to_camera_view(scene, camera, Vector(place))
        found = world_to_camera_view(scene, camera, (to_world @ Vector((x, y, 0, 1))).xyz)
        difference = (seen - found).xy
        assert abs(difference.x) * SIZE[0] < 0.01 and abs(difference.y) * SIZE[1] < 0.01


def test_without_a_camera_it_is_seen_straight_on(scene, picture, part):
    picture.plane.matrix_world = TURNED
    scene.view_layers[0].update()
    to_world = plane_of.pixels_to_world(picture)
    upright = TURNED.col[0].xyz.cross(TURNED.col[1].xyz).normalized()
    draw(part, [(to_world @ Vector((x, y, 0, 1))).xyz + 2 * upright for x, y in PIXELS])
    lands(scene, picture)


def test_nearer_to_the_camera_it_is_wider(scene, picture, part):
    add_camera(scene, picture, "PERSP")  # 10 before the plane
    picture.strokes.scale = (2, 2, 2)
    draw(part, [(0, 0, 0), (0, 0, 2.5)], radius=[0.05, 0.05])
    part.radius_offset = 0.01
    part.scale = (1, 1, 1)
    scene.view_layers[0].update()
    widths = read.strokes(scene, picture, "", HORIZON)[0].widths
    np.testing.assert_allclose(widths, [2 * 0.06 * 2 * 160, 2 * 2 * 0.06 * 2 * 160], rtol=1e-5)


def test_pressure_is_read_along_the_curve(scene, picture, part):
    drawing = draw(part, on_plane((100, 100), (300, 100)), kind="BEZIER", radius=[0.01, 0.05])
    store(drawing, 0, "resolution", np.array(4))
    widths = read.strokes(scene, picture, "", HORIZON)[0].widths
    np.testing.assert_allclose(widths / 320, [0.01, 0.02, 0.03, 0.04, 0.05], rtol=1e-5)


def test_what_is_hidden_does_not_count(scene, picture, part):
    draw(part, on_plane(*PIXELS))
    group = picture.strokes.data.layer_groups.new("Group")
    picture.strokes.data.layers.move_to_layer_group(part, group)
    holder = picture.strokes

    def shows():
        return len(read.strokes(scene, picture, "", HORIZON)), read.is_drawn(scene, picture, "", HORIZON)

    for hide in (
        lambda hidden: setattr(part, "hide", hidden),
        lambda hidden: setattr(group, "hide", hidden),
        lambda hidden: setattr(holder, "hide_viewport", hidden),
        holder.hide_set,
    ):
        assert shows() == (1, True)
        hide(True)
        assert shows() == (0, False)
        hide(False)
    holder.hide_render = True  # strokes are not for renders
    assert shows() == (1, True)


def test_one_drawing_holds_for_a_role_without_keys(scene, picture, part, monkeypatch):
    scene.frame_start = 10
    for frame in (20, 1, 12):
        draw(part, on_plane((frame, 0), (frame, 50)), frame=frame)
    for now in (1, 15, 99):
        scene.frame_set(now)
        assert [stroke.frame for stroke in read.strokes(scene, picture, "", HORIZON)] == [1]
    part.frames.remove(1)
    assert [stroke.frame for stroke in read.strokes(scene, picture, "", HORIZON)] == [12]


def test_every_key_of_a_keyed_role_is_read(scene, picture, part, monkeypatch):
    import dataclasses

    for frame in (20, 1, 12):
        draw(part, on_plane((frame, 0), (frame, 50)), frame=frame)
    keyed = dataclasses.replace(HORIZON, keyed=True)
    monkeypatch.setattr(roles, "ROLES", (keyed,))
    assert [stroke.frame for stroke in read.strokes(scene, picture, "", keyed)] == [1, 12, 20]


def test_a_stroke_behind_the_camera_is_told(scene, picture, part):
    add_camera(scene, picture, "PERSP")
    draw(part, [(0, 0, 0), (0, 0, 12)])
    with pytest.raises(ValueError, match="Horizon: a stroke lies behind the camera; move it, or delete it"):
        read.strokes(scene, picture, "", HORIZON)


def test_a_camera_that_looks_along_the_plane_is_told(scene, picture, part):
    camera = add_camera(scene, picture)
    camera.rotation_euler = (radians(90), 0, 0)
    draw(part, on_plane(*PIXELS))
    scene.view_layers[0].update()
    with pytest.raises(ValueError, match="Lake: the camera looks along the picture's plane; turn one of them"):
        read.strokes(scene, picture, "", HORIZON)


def test_without_a_plane_it_is_told(scene, picture, part):
    draw(part, on_plane(*PIXELS))
    picture.plane = None
    with pytest.raises(ValueError, match="Lake: has no plane in the scene; make it anew with Set Up in Scene"):
        read.strokes(scene, picture, "", HORIZON)


def test_a_picture_without_strokes_has_none(scene, picture):
    assert read.strokes(scene, picture, "", HORIZON) == []
    picture.strokes = bpy.data.objects.new("Not a grease pencil", None)
    assert read.strokes(scene, picture, "", HORIZON) == [] and not read.is_drawn(scene, picture, "", HORIZON)
