"""A grease-pencil layer knows whose strokes it holds, whatever happens to its name and place."""

import importlib

import bpy
import pytest
from drawings import draw, lay_out, on_plane
from pixels import PACKAGE

gp_layers = importlib.import_module(f"{PACKAGE}.strokes.gp_layers")
read = importlib.import_module(f"{PACKAGE}.strokes.read")
roles = importlib.import_module(f"{PACKAGE}.strokes.roles")

SWAY, HORIZON = roles.by_key("sway_line"), roles.by_key("horizon")
LINE = on_plane((100, 700), (120, 300))


@pytest.fixture
def oak(scene, picture):
    """A layer that sways, with its sway line; the picture has a horizon besides."""
    lay_out(scene, picture)
    oak = picture.layers[0]
    oak.name, oak.motion.type = "Oak", "sway"
    for identifier, role in ((oak.id, SWAY), ("", HORIZON)):
        draw(gp_layers.ensure(picture, identifier, role), LINE)
    return oak


def kept(picture) -> list[str]:
    return [part.name for part in picture.strokes.data.layers]


def test_it_is_named_after_layer_and_role(picture, oak):
    assert kept(picture) == ["Oak · Sway Line", "Horizon"]
    assert gp_layers.ensure(picture, oak.id, SWAY).name == "Oak · Sway Line" and len(kept(picture)) == 2
    assert gp_layers.of(picture, "0123456789ab", SWAY) == [] == gp_layers.of(picture, oak.id, HORIZON)


@pytest.mark.parametrize("identifier", ["", "000000000001", "ffffffffffff", "0123456789ab"])
@pytest.mark.parametrize("number", [1, 127])
def test_any_id_and_role_can_be_kept(identifier, number, monkeypatch):
    import dataclasses

    role = dataclasses.replace(SWAY, number=number)
    monkeypatch.setattr(roles, "ROLES", (role,))
    packed = gp_layers._packed(identifier, role)
    assert all(0 <= part < 2**31 for part in packed) and gp_layers._unpacked(*packed) == (identifier, role)


def test_a_role_of_a_later_version_is_left_alone(picture, oak):
    picture.strokes.data.attributes[gp_layers.ATTRIBUTE].data[0].value[0] |= 100 << gp_layers.HALF
    assert gp_layers.of(picture, oak.id, SWAY) == [] and len(gp_layers.of(picture, "", HORIZON)) == 1


def test_it_survives_what_an_artist_does(scene, picture, oak, tmp_path):
    """Renamed, moved, grouped, among others, duplicated, saved."""
    layers = picture.strokes.data.layers
    part = gp_layers.of(picture, oak.id, SWAY)[0]
    layers.new("Sketch")
    part.name = "what I drew"
    layers.move(part, "UP")
    layers.move_to_layer_group(part, picture.strokes.data.layer_groups.new("Group"))
    identifier = oak.id
    assert [part.name for part in gp_layers.of(picture, identifier, SWAY)] == ["what I drew"]
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "file.blend"))
    scene = bpy.context.scene
    picture = scene.stillwater.pictures[0]
    part = gp_layers.of(picture, identifier, SWAY)[0]
    assert part.name == "what I drew" and [p.name for p in gp_layers.of(picture, "", HORIZON)] == ["Horizon"]
    assert len(read.strokes(scene, picture, identifier, SWAY)) == 1
    picture.strokes.data.layers.active = part
    bpy.context.view_layer.objects.active = picture.strokes
    bpy.ops.grease_pencil.layer_duplicate()
    assert len(read.strokes(scene, picture, identifier, SWAY)) == 2


def test_it_survives_undo(scene, picture, oak):
    bpy.ops.ed.undo_push(message="Before")
    identifier = oak.id
    gp_layers.remove(picture, identifier)
    bpy.ops.ed.undo_push(message="Removed")
    bpy.ops.ed.undo()
    picture = bpy.context.scene.stillwater.pictures[0]
    assert [part.name for part in gp_layers.of(picture, identifier, SWAY)] == ["Oak · Sway Line"]
    bpy.ops.ed.redo()
    assert gp_layers.of(bpy.context.scene.stillwater.pictures[0], identifier, SWAY) == []


def test_names_follow_a_layer_s_name(extension, picture, oak):
    gp_layers.of(picture, oak.id, SWAY)[0].name = "what I drew"
    oak.name = "Old Oak"
    assert kept(picture) == ["Old Oak · Sway Line", "Horizon"]
    extension.properties.arrange.add_layer(picture, "Old Oak").motion.type = "sway"
    draw(gp_layers.ensure(picture, picture.layers[1].id, SWAY), LINE)
    assert kept(picture)[-1] == "Old Oak.001 · Sway Line"
    extension.properties.arrange.move_layer(picture, 1, 0)
    picture.layers[0].name = "é" * 100
    assert kept(picture) == ["Old Oak · Sway Line", "Horizon", "é" * 100 + " · Sway Line"]


def test_several_of_one_role_stay_told_apart(picture, oak):
    picture.strokes.data.layers.active = gp_layers.of(picture, oak.id, SWAY)[0]
    bpy.context.view_layer.objects.active = picture.strokes
    bpy.ops.grease_pencil.layer_duplicate()
    oak.name = "Elm"
    names = ["Elm · Sway Line", "Elm · Sway Line.001"]
    assert sorted(part.name for part in gp_layers.of(picture, oak.id, SWAY)) == names
    oak.name = "Elm"  # and again: numbered ones are right as they are
    assert sorted(part.name for part in gp_layers.of(picture, oak.id, SWAY)) == names


def test_a_copied_layer_has_strokes_of_its_own(scene, extension, picture, oak):
    copy = extension.properties.arrange.add_layer(picture, "Copy")
    oak, copy = picture.layers
    picture.strokes.data.layers.active = picture.strokes.data.layers["Horizon"]
    extension.strokes.copy_roles(picture, oak.id, copy.id)
    assert picture.strokes.data.layers.active.name == "Horizon"
    assert sorted(kept(picture)) == ["Copy · Sway Line", "Horizon", "Oak · Sway Line"]
    made = gp_layers.of(picture, copy.id, SWAY)[0]
    assert made.parent == picture.plane
    made.frames[0].drawing.attributes["position"].data[0].vector = (0, 0, 0)
    ours, theirs = (read.strokes(scene, picture, layer.id, SWAY)[0].points for layer in (oak, copy))
    assert tuple(ours[0].round(3)) == (100, 700) and tuple(theirs[0].round(3)) == (640, 400)


def test_a_removed_layer_takes_its_strokes_along(scene, extension, picture, oak):
    extension.strokes.remove_roles(picture, "0123456789ab")
    assert len(kept(picture)) == 2
    bpy.ops.stillwater.remove_layer()
    assert kept(picture) == ["Horizon"]


def test_a_picture_without_strokes_is_fine(extension, picture):
    extension.strokes.copy_roles(picture, picture.layers[0].id, "0123456789ab")
    extension.strokes.remove_roles(picture, picture.layers[0].id)
    picture.layers[0].name = "Elm"
    assert extension.strokes.replaced(bpy.context.scene, picture) == set()


def test_its_space_is_the_plane_s_and_follows_it(scene, picture, oak):
    """Wherever the grease-pencil object is: what is drawn in the layer's x and y lies on the picture."""
    picture.strokes.location = (5, 5, 5)
    picture.plane.matrix_world = picture.plane.matrix_world.Translation((1, 2, 3))
    picture.plane.rotation_euler, picture.plane.scale = (1, 0.5, 0.2), (2, 2, 2)
    scene.view_layers[0].update()
    gp_layers.remove(picture, oak.id)
    part = gp_layers.ensure(picture, oak.id, SWAY)
    for _ in range(2):
        difference = read.layer_to_world(picture.strokes, part) - picture.plane.matrix_world
        assert max(abs(number) for row in difference for number in row) < 1e-5
        picture.plane.rotation_euler, picture.plane.location = (0.3, 2, 1), (-1, 0, 0)
        scene.view_layers[0].update()


def test_a_role_without_keys_has_one_that_holds(picture, oak):
    part = gp_layers.ensure(picture, oak.id, SWAY)
    frames = lambda: [key.frame_number for key in part.frames]  # noqa: E731
    gp_layers.ensure_key(part, SWAY, 5)
    assert frames() == [1]
    gp_layers.ensure_key(part, SWAY, -3)  # Blender would not draw before the first key
    assert frames() == [-3] and len(part.frames[0].drawing.strokes) == 1


def test_a_role_has_one_material_in_its_colour(picture, oak):
    gp = picture.strokes.data
    slots = [gp_layers.material(gp, role) for role in (SWAY, HORIZON, SWAY)]
    assert slots == [0, 1, 0] and [made.name for made in gp.materials] == ["Stillwater Sway Line", "Stillwater Horizon"]
    assert tuple(gp.materials[0].grease_pencil.color)[:3] == pytest.approx(SWAY.colour)
