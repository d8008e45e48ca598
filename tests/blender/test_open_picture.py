"""One step from a file on disk to a picture that can be drawn on, and whose render is the picture."""

import importlib
from types import SimpleNamespace

import bpy
import menus
import numpy as np
import pytest
from mathutils import Vector
from pictures import HEIGHT, WIDTH, look_at, paint, rendered
from pixels import PACKAGE

pixels_to_world = importlib.import_module(f"{PACKAGE}.properties.plane").pixels_to_world


@pytest.fixture
def scene(scene):
    """The scene as Blender makes it."""
    scene.view_settings.view_transform = "AgX"
    return scene


@pytest.fixture
def path(tmp_path):
    return str(paint(tmp_path / "lake.png"))


@pytest.fixture
def opened(scene, path):
    assert bpy.ops.stillwater.open_picture("EXEC_DEFAULT", True, filepath=path) == {"FINISHED"}
    return bpy.context.scene.stillwater.active()


def test_everything_is_there(scene, opened):
    assert (opened.name, tuple(opened.picture_size), [layer.name for layer in opened.layers]) == (
        "lake", (WIDTH, HEIGHT), ["Background"]
    )  # fmt: skip
    assert {item.type for item in opened.collection.objects} == {"EMPTY", "CAMERA", "GREASEPENCIL"}
    assert opened.collection.name == "Stillwater lake" and opened.collection.name in scene.collection.children
    assert scene.camera == opened.camera and opened.plane.data == opened.image
    assert (scene.render.resolution_x, scene.render.resolution_y) == (WIDTH, HEIGHT)
    assert scene.view_settings.view_transform == "Standard"
    assert bpy.context.view_layer.objects.active == opened.strokes and bpy.context.selected_objects == [opened.strokes]
    assert opened.strokes.parent == opened.plane and opened.strokes.hide_render
    views = [area.spaces.active.region_3d for area in bpy.context.screen.areas if area.type == "VIEW_3D"]
    assert views and {view.view_perspective for view in views} == {"CAMERA"}


@pytest.mark.parametrize("size", [(WIDTH, HEIGHT), (HEIGHT, WIDTH), (20, 20), (5, 30), (97, 31)])
def test_the_camera_fits_the_plane_exactly(scene, tmp_path, size):
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "a.png", size)))
    picture = scene.stillwater.active()
    pixels = pixels_to_world(picture)
    for pixel, corner in [((0, 0), (0, 1)), (size, (1, 0)), ((size[0] / 2, size[1] / 2), (0.5, 0.5))]:
        assert look_at(scene, pixels @ Vector((*pixel, 0, 1))) == pytest.approx(corner, abs=1e-5)


@pytest.mark.parametrize("name", ["a.png", "a.tif", "a.exr", "a.jpg"])
def test_the_render_is_the_picture(scene, tmp_path, name):
    """Before there is any bake: the node gives the picture at rest."""
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / name)))
    image = scene.stillwater.active().image
    shown = np.array(image.pixels[:]).reshape(HEIGHT, WIDTH, 4)[::-1, :, :3]
    got = rendered(scene, tmp_path / "render.exr")
    if image.colorspace_settings.name == "sRGB":
        shown = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
    assert np.abs(got - shown).max() < 1e-4


def test_an_8_bit_picture_comes_back_to_the_byte(scene, opened, path, tmp_path):
    scene.render.dither_intensity = 0
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = str(tmp_path / "out.png")
    bpy.ops.render.render(write_still=True)
    again, before = (bpy.data.images.load(name) for name in (scene.render.filepath, path))
    assert np.array_equal(np.array(again.pixels[:]), np.array(before.pixels[:]))


def test_one_undo_takes_it_all_away_and_redo_brings_it_back(scene, path):
    bpy.ops.ed.undo_push(message="before")
    kinds = ("objects", "cameras", "collections", "images", "node_groups")
    before = {kind: set(getattr(bpy.data, kind).keys()) for kind in kinds}
    bpy.ops.stillwater.open_picture("EXEC_DEFAULT", True, filepath=path)
    bpy.ops.ed.undo()
    assert len(bpy.context.scene.stillwater.pictures) == 0
    assert {kind: set(getattr(bpy.data, kind).keys()) for kind in kinds} == before
    assert bpy.context.scene.camera is None and bpy.context.scene.view_settings.view_transform == "AgX"
    bpy.ops.ed.redo()
    picture = bpy.context.scene.stillwater.active()
    assert picture.plane.data == picture.image and tuple(picture.image.size) == (WIDTH, HEIGHT)


def test_several_pictures_lie_side_by_side_and_each_keeps_its_own(scene, tmp_path):
    for name, size in (("a", (40, 30)), ("b", (30, 60)), ("a", (20, 20))):
        bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / str(size[0]) / f"{name}.png", size)))
    pictures = list(scene.stillwater.pictures)
    assert [picture.name for picture in pictures] == ["a", "b", "a.001"]
    for kind in ("plane", "camera", "strokes", "collection", "tree", "image", "id"):
        assert len({getattr(picture, kind) for picture in pictures}) == 3
    sides = [pixels_to_world(picture) for picture in pictures]
    edges = [[(side @ Vector((x * p.picture_size[0], 0, 0, 1))).x for x in (0, 1)] for side, p in zip(sides, pictures)]
    assert edges[0][1] < edges[1][0] and edges[1][1] < edges[2][0]
    assert scene.camera == pictures[2].camera and scene.render.resolution_x == 20
    bpy.ops.stillwater.show_picture(index=1)
    assert scene.camera == pictures[1].camera and scene.render.resolution_y == 60
    assert rendered(scene, tmp_path / "b.exr").shape[:2] == (60, 30)


@pytest.mark.parametrize("y, far", [(0, True), (-4, True), (6, False), (-30, False)])
def test_nothing_of_the_artist_s_stands_before_it(scene, path, y, far):
    """In Blender's own start file the cube would."""
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    mesh = bpy.data.meshes.new("Cube")
    mesh.from_pydata(corners, [], [(0, 1, 3, 2), (4, 5, 7, 6)])
    cube = bpy.data.objects.new("Cube", mesh)
    cube.location.y = y
    scene.collection.objects.link(cube)
    bpy.context.view_layer.update()
    bpy.ops.stillwater.open_picture(filepath=path)
    plane = scene.stillwater.active().plane
    assert (plane.location.y > 0) == far
    seen = plane.location.y - 10, plane.location.y  # from the camera to the plane
    assert y + 1 < seen[0] or y - 1 > seen[1]


def test_two_scenes(scene, path, tmp_path):
    bpy.ops.stillwater.open_picture(filepath=path)
    bpy.ops.scene.new(type="NEW")
    second = bpy.context.scene
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "other.png", (30, 20))))
    assert second != scene and len(second.stillwater.pictures) == len(scene.stillwater.pictures) == 1
    assert second.camera.name in second.objects and scene.camera.name in scene.objects
    assert second.stillwater.active().plane.location.x == 0
    assert rendered(second, tmp_path / "2.exr").shape[:2] == (20, 30)
    assert rendered(scene, tmp_path / "1.exr").shape[:2] == (HEIGHT, WIDTH)


def test_files_dropped_together_are_opened_together(scene, tmp_path):
    for name in ("a.png", "b.png"):
        paint(tmp_path / name)
    (tmp_path / "c.png").write_text("no picture")
    files = [{"name": name} for name in ("a.png", "b.png", "c.png")]
    assert bpy.ops.stillwater.drop_picture(directory=str(tmp_path), files=files) == {"FINISHED"}
    assert [picture.name for picture in scene.stillwater.pictures] == ["a", "b"]
    assert {image.name for image in bpy.data.images} <= {"a.png", "b.png", "Render Result", "Viewer Node"}


def test_a_drop_onto_the_viewport_is_taken(scene):
    handler = bpy.types.STILLWATER_FH_picture
    assert handler.bl_import_operator == "stillwater.drop_picture" and ".png" in handler.bl_file_extensions
    for kind, taken in (("VIEW_3D", True), ("NODE_EDITOR", False)):
        assert handler.poll_drop(SimpleNamespace(area=SimpleNamespace(type=kind))) == taken


@pytest.mark.parametrize(
    "name, words",
    [("none.png", "there is no such picture"), ("text.png", "can't read it as a picture")],
)
def test_what_is_no_picture_is_a_sentence_and_changes_nothing(scene, tmp_path, name, words):
    (tmp_path / "text.png").write_text("Once upon a time")
    bpy.ops.ed.undo_push(message="before")
    with pytest.raises(RuntimeError, match=words):
        bpy.ops.stillwater.open_picture(filepath=str(tmp_path / name))
    assert not bpy.data.images and not bpy.data.objects and not scene.stillwater.pictures
    assert not scene.stillwater.former.kept and scene.view_settings.view_transform == "AgX"


def test_a_picture_that_is_too_large_is_refused(scene, tmp_path, monkeypatch, extension):
    monkeypatch.setattr(extension.properties.image, "LARGEST_SIDE", 40)
    with pytest.raises(RuntimeError, match="lake.png: 48 x 32 pixels; at most 40 a side can be animated"):
        bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "lake.png")))
    assert not scene.stillwater.pictures


def test_no_file_chosen_is_a_sentence(scene):
    with pytest.raises(RuntimeError, match="No picture was chosen"):
        bpy.ops.stillwater.open_picture()


def test_options_leave_the_scene_as_it_is(scene, path):
    scene.render.resolution_x, scene.render.fps = 640, 25
    bpy.ops.stillwater.open_picture(filepath=path, use_render=False, use_standard=False)
    assert scene.camera is None and scene.render.resolution_x == 640 and scene.render.fps == 25
    assert scene.view_settings.view_transform == "AgX"
    bpy.ops.stillwater.open_picture(filepath=path, frame_rate="29.97")
    assert scene.render.fps / scene.render.fps_base == pytest.approx(29.97, abs=1e-3)


def test_the_former_view_is_remembered(scene, path):
    scene.view_settings.exposure, scene.view_settings.look = 0.5, "AgX - Punchy"
    assert not bpy.ops.stillwater.former_view.poll()
    bpy.ops.stillwater.open_picture(filepath=path)
    assert not bpy.ops.stillwater.standard_view.poll()
    bpy.ops.stillwater.former_view("EXEC_DEFAULT", True)
    view = scene.view_settings
    assert (view.view_transform, view.look, view.exposure) == ("AgX", "AgX - Punchy", 0.5)
    assert not bpy.ops.stillwater.former_view.poll()
    bpy.ops.stillwater.standard_view("EXEC_DEFAULT", True)
    assert (view.view_transform, view.look, view.exposure) == ("Standard", "None", 0)


def test_an_artist_s_compositor_stays_at_the_output(extension, scene, path):
    top = extension.versions.compositor_tree(scene, create=True)
    blur = top.nodes.new("CompositorNodeBlur")
    top.links.new(blur.outputs[0], extension.versions.output_socket(top))
    bpy.ops.stillwater.open_picture(filepath=path)
    assert extension.versions.output_socket(top).links[0].from_node == blur
    assert len(extension.compositor.tree.nodes_of(scene, scene.stillwater.active().id)) == 1


def test_the_backdrop_shows_the_picture_that_is_shown(extension, scene, opened, tmp_path):
    top = extension.versions.compositor_tree(scene)
    viewer = next(node for node in top.nodes if node.bl_idname == "CompositorNodeViewer")
    assert viewer.inputs["Image"].links[0].from_node.node_tree == opened.tree
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "pond.png")))
    assert viewer.inputs["Image"].links[0].from_node.node_tree == scene.stillwater.active().tree
    assert len([node for node in top.nodes if node.bl_idname == "CompositorNodeViewer"]) == 1


def test_a_plain_3d_compositor_gives_way(extension, scene, path):
    top = extension.versions.compositor_tree(scene, create=True)
    layers = top.nodes.new("CompositorNodeRLayers")
    top.links.new(layers.outputs["Image"], extension.versions.output_socket(top))
    bpy.ops.stillwater.open_picture(filepath=path)
    shown = extension.versions.output_socket(top).links[0].from_node
    assert shown.node_tree == scene.stillwater.active().tree


@pytest.mark.parametrize("space, name", [("auto", "sRGB"), ("linear", "Linear Rec.709"), ("srgb", "sRGB")])
def test_the_image_has_the_picture_s_colour_space(opened, space, name):
    opened.colour_space = space
    assert opened.image.colorspace_settings.name == name


def test_an_exr_is_linear_by_itself(scene, tmp_path):
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "a.exr")))
    picture = scene.stillwater.active()
    assert picture.image.colorspace_settings.name == "Linear Rec.709"
    picture.colour_space = "srgb"
    assert picture.image.colorspace_settings.name == "sRGB"


def test_what_was_deleted_is_made_again(scene, opened, tmp_path):
    for item in list(opened.collection.objects):
        item.hide_select = False
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    bpy.data.cameras.remove(opened.camera.data)
    bpy.ops.stillwater.show_picture("EXEC_DEFAULT", True)
    opened = scene.stillwater.active()
    assert {item.type for item in opened.collection.objects} == {"EMPTY", "CAMERA", "GREASEPENCIL"}
    assert scene.camera == opened.camera and opened.camera.name in scene.objects


def test_a_picture_of_numbers_alone_is_set_up_when_shown(scene, extension, path):
    picture = extension.properties.arrange.add_picture(scene, "Lake")
    picture.picture = path
    bpy.ops.stillwater.show_picture()
    assert scene.camera == picture.camera and tuple(picture.picture_size) == (WIDTH, HEIGHT)


def test_a_linked_scene_says_why_it_can_t_be_changed(scene, path, tmp_path):
    bpy.ops.stillwater.open_picture(filepath=path)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "there.blend"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(tmp_path / "there.blend"), link=True) as (_, wanted):
        wanted.scenes = ["Scene"]
    linked = wanted.scenes[0]
    bpy.context.window.scene = linked
    for verb in ("open", "show", "replace", "reload", "remove"):
        name = f"{verb}_picture"
        with pytest.raises(RuntimeError, match=r"(?s)poll.*linked"):
            getattr(bpy.ops.stillwater, name)()


def test_it_is_found_in_menus(scene):
    for menu, names in {
        "TOPBAR_MT_file_import": {"stillwater.open_picture", "stillwater.load_recipe"},
        "VIEW3D_MT_image_add": {"stillwater.open_picture"},
    }.items():
        assert names <= set(menus.operators(menu))
    ours = menus.operators("STILLWATER_MT_picture")
    assert {"stillwater.show_picture", "stillwater.replace_picture", "stillwater.remove_picture"} <= set(ours)
    assert "STILLWATER_MT_picture" in menus.submenus("VIEW3D_MT_object")


def test_a_right_click_on_a_picture_s_object_offers_what_can_be_done_with_it(scene, opened, tmp_path):
    menu = "VIEW3D_MT_object_context_menu"
    assert menus.submenus(menu) == ["STILLWATER_MT_picture"]
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "pond.png")))
    assert menus.submenus(menu) == ["STILLWATER_MT_picture"]
    bpy.context.view_layer.objects.active = scene.stillwater.pictures[0].camera
    assert menus.submenus(menu) == [] and menus.operators(menu) == ["stillwater.show_picture"]
    bpy.context.view_layer.objects.active = None
    assert menus.submenus(menu) == menus.operators(menu) == []
